// SPDX-License-Identifier: GPL-3.0-or-later
// Displacements of the two facing floors that hit each other hardest, with the gap between them
// shaded and the impacts marked; without impacts, of the roofs. Below it the ground acceleration.
//
// The right floor is drawn where the left one sees it: x_left - delta = x_right + gap.
#include <assert.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "plot/figure.h"
#include "plot/script.h"

enum { BINS = 1200, MARKS_MAX = 600, SERIES_MAX = 3 };

static const char gap_colour[] = "#e4e4e4";

struct view {
    const struct result_file *file;
    const struct report *r;
    int contact;                           // -1: no impact, the roofs are shown
    int building[2];                       // -1: none
    int floor[2];                          // from 0
    double *time, *left, *right, *ground;  // (n_row); right is NULL if there is none
    double *memory;                        // owned: the four above
};

static int hardest_contact(const struct report *r) {
    int at = -1;
    for (int i = 0; i < r->n_contact; i++) {
        const struct link_peak *p = &r->contact[i].peak;
        if (p->impacts > 0 && (at < 0 || p->force > r->contact[at].peak.force)) {
            at = i;
        }
    }
    return at;
}

static int building_index(const struct report *r, const char *name, int floor) {
    for (int i = 0; i < r->n_building && floor > 0; i++) {
        if (strcmp(r->building[i].name, name) == 0 && floor <= r->building[i].n_floor) {
            return i;
        }
    }
    return -1;
}

static void choose_floors(struct view *v) {
    const struct report *r = v->r;
    v->contact = hardest_contact(r);
    if (v->contact < 0) {
        for (int side = 0; side < 2; side++) {
            v->building[side] = side < r->n_building ? side : -1;
            v->floor[side] = side < r->n_building ? r->building[side].n_floor - 1 : 0;
        }
        return;
    }
    const struct report_link *c = &r->contact[v->contact];
    v->building[0] = building_index(r, c->left, c->left_floor);
    v->building[1] = building_index(r, c->right, c->right_floor);
    v->floor[0] = c->left_floor - 1;
    v->floor[1] = c->right_floor - 1;
}

// Displacement of one side; a wall stands still.
static int side_history(const struct view *v, int side, double *out, struct error *e) {
    if (v->building[side] < 0) {
        for (long i = 0; i < v->r->n_row; i++) {
            out[i] = 0;
        }
        return STATUS_OK;
    }
    return result_floor_history(v->file, FIELD_DISPLACEMENT, v->building[side], v->floor[side], out,
                                e);
}

// The right side relative to the left one: by the penetration where the file has it, which holds
// for different grounds too; otherwise by the displacements.
static int right_history(struct view *v, struct error *e) {
    const size_t n = (size_t)v->r->n_row;
    if (v->contact < 0 || !(v->r->fields & FIELD_PENETRATION)) {
        int status = side_history(v, 1, v->right, e);
        for (size_t i = 0; v->contact >= 0 && i < n; i++) {
            v->right[i] += v->r->contact[v->contact].gap;
        }
        return status;
    }
    int status = result_contact_history(v->file, FIELD_PENETRATION, v->contact, v->right, e);
    for (size_t i = 0; i < n; i++) {
        v->right[i] = v->left[i] - v->right[i];
    }
    return status;
}

static int read_histories(struct view *v, struct error *e) {
    const size_t n = (size_t)v->r->n_row;
    v->memory = calloc(4 * n, sizeof *v->memory);
    if (!v->memory) {
        return error_no_memory(e);
    }
    v->time = v->memory;
    v->left = v->memory + n;
    v->right = v->memory + 2 * n;
    v->ground = v->memory + 3 * n;
    int status = result_time(v->file, v->time, e);
    if (status == STATUS_OK) {
        status = side_history(v, 0, v->left, e);
    }
    if (status == STATUS_OK) {
        status = right_history(v, e);
    }
    if (status == STATUS_OK) {
        const int on = v->building[0] >= 0 ? v->building[0] : v->building[1];
        status = result_ground(v->file, on, v->ground, e);
    }
    if (status == STATUS_OK && v->contact < 0 && v->building[1] < 0) {
        v->right = NULL;
    }
    return status;
}

static int write_data(const struct view *v, FILE *to, struct error *e) {
    assert(v->time && v->left && v->ground);
    const size_t n = (size_t)v->r->n_row;
    const double *series[SERIES_MAX] = {v->left, v->ground, v->right};
    const int n_series = v->right ? 3 : 2;
    size_t *row = malloc(((size_t)(2 * n_series * BINS) + 2) * sizeof *row);
    if (!row) {
        return error_no_memory(e);
    }
    const size_t n_row = script_thin(series, n_series, n, BINS, row);
    fprintf(to, "$rows << EOD\n# time left right ground\n");
    for (size_t i = 0; i < n_row; i++) {
        const size_t k = row[i];
        fprintf(to, "%.9g %.9g %.9g %.9g\n", v->time[k], v->left[k],
                v->right ? v->right[k] : (double)NAN, v->ground[k]);
    }
    fprintf(to, "EOD\n");
    free(row);
    return STATUS_OK;
}

// The left displacement at time t, between rows by a straight line.
static double left_at(const struct view *v, double t) {
    size_t low = 0, high = (size_t)v->r->n_row - 1;
    while (high - low > 1) {
        const size_t middle = low + (high - low) / 2;
        *(v->time[middle] <= t ? &low : &high) = middle;
    }
    const double span = v->time[high] - v->time[low];
    const double part = span > 0 ? (t - v->time[low]) / span : 0;
    return v->left[low] + part * (v->left[high] - v->left[low]);
}

// The hardest impact of each of MARKS_MAX parts of the duration.
static int write_marks(const struct view *v, FILE *to, struct error *e) {
    const struct report *r = v->r;
    long *hardest = malloc(MARKS_MAX * sizeof *hardest);
    if (!hardest) {
        return error_no_memory(e);
    }
    for (int b = 0; b < MARKS_MAX; b++) {
        hardest[b] = -1;
    }
    for (long i = 0; i < r->n_impact; i++) {
        const double part = r->impact[i].t_start / r->duration * MARKS_MAX;
        const int b = part >= 0 && part < MARKS_MAX ? (int)part : MARKS_MAX - 1;
        if (r->impact[i].contact == v->contact &&
            (hardest[b] < 0 || r->impact[i].peak_force > r->impact[hardest[b]].peak_force)) {
            hardest[b] = i;
        }
    }
    fprintf(to, "$impacts << EOD\n# time displacement force\n");
    for (int b = 0; b < MARKS_MAX; b++) {
        if (hardest[b] >= 0) {
            const struct impact *i = &r->impact[hardest[b]];
            fprintf(to, "%.9g %.9g %.9g\n", i->t_start, left_at(v, i->t_start), i->peak_force);
        }
    }
    fprintf(to, "EOD\n");
    free(hardest);
    return STATUS_OK;
}

static void write_titles(const struct view *v, FILE *to) {
    const struct report *r = v->r;
    char text[512], length[64], force[64];
    snprintf(text, sizeof text, "displacement of the roofs; %s",
             r->n_contact > 0 ? "no contact closed" : "there are no contacts");
    if (v->contact >= 0) {
        const struct report_link *c = &r->contact[v->contact];
        script_unit(&r->units, dimension_length, length, sizeof length);
        script_unit(&r->units, dimension_force, force, sizeof force);
        snprintf(text, sizeof text,
                 "contact %s: gap %.4g %s, %ld %s, largest force %.4g %s at %.4g %s", c->name,
                 c->gap, length, c->peak.impacts, c->peak.impacts == 1 ? "impact" : "impacts",
                 c->peak.force, force, c->peak.force_time, r->units.time_name);
    }
    script_head(to, r->title[0] ? r->title : r->deck_file, text);
}

static void write_side(const struct view *v, int side, FILE *to) {
    char name[128], text[192];
    const char *more = side == 1 && v->contact >= 0 ? " + gap" : "";
    if (v->building[side] < 0) {
        snprintf(text, sizeof text, "wall%s", more);
    } else {
        script_cut(v->r->building[v->building[side]].name, 24, name, sizeof name);
        snprintf(text, sizeof text, "%s, floor %d%s", name, v->floor[side] + 1, more);
    }
    script_legend(to, 2 * side, 2, SCRIPT_LINE, script_colour[side], text);
}

static void write_axis_label(FILE *to, const struct view *v, double y, const char *name,
                             const struct dimension *dimension) {
    fprintf(to, "set label ");
    script_axis(to, name, &v->r->units, *dimension);
    fprintf(to, " at screen 0.02,%.4f center rotate by 90\n", y);
}

static void write_displacements(const struct view *v, FILE *to) {
    write_side(v, 0, to);
    if (v->right) {
        write_side(v, 1, to);
    }
    if (v->contact >= 0) {
        script_legend(to, 4, 2, SCRIPT_AREA, gap_colour, "gap");
        script_legend(to, 6, 2, SCRIPT_POINT, "#000000", "impacts");
    }
    write_axis_label(to, v, 0.6125, "displacement", &dimension_length);
    fprintf(to,
            "set multiplot\n"
            "set lmargin at screen 0.095\nset rmargin at screen 0.975\n"
            "set tmargin at screen 0.825\nset bmargin at screen 0.40\n"
            "set xrange [0:%.9g]\nset offsets 0, 0, graph 0.04, graph 0.04\n"
            "set format x ''\nplot \\\n",
            v->r->duration);
    if (v->contact >= 0) {
        fprintf(to, "  $rows using 1:2:3 with filledcurves fc rgb '%s', \\\n", gap_colour);
    }
    fprintf(to, "  $rows using 1:2 with lines lc rgb '%s'", script_colour[0]);
    if (v->right) {
        fprintf(to, ", \\\n  $rows using 1:3 with lines lc rgb '%s'", script_colour[1]);
    }
    if (v->contact >= 0) {
        fprintf(to, ", \\\n  $impacts using 1:2 with points pt 7 ps 0.7 lc rgb '#000000'");
    }
    fprintf(to, "\n");
    script_head_end(to);
}

static void write_ground(const struct view *v, FILE *to) {
    write_axis_label(to, v, 0.2325, "ground accel.", &dimension_acceleration);
    fprintf(to, "set tmargin at screen 0.36\nset bmargin at screen 0.105\n"
                "set format x '%%h'\nset xlabel ");
    script_axis(to, "time", &v->r->units, dimension_time);
    fprintf(to, "\nplot $rows using 1:4 with lines lc rgb '#404040' lw 0.7\nunset multiplot\n");
}

static int draw(const struct result_file *file, FILE *to, struct error *e) {
    struct view v = {.file = file, .r = result_report(file)};
    choose_floors(&v);
    int status = read_histories(&v, e);
    if (status == STATUS_OK) {
        status = write_data(&v, to, e);
    }
    if (status == STATUS_OK && v.contact >= 0) {
        status = write_marks(&v, to, e);
    }
    if (status == STATUS_OK) {
        write_titles(&v, to);
        write_displacements(&v, to);
        write_ground(&v, to);
    }
    free(v.memory);
    return status;
}

const struct figure figure_histories = {
    .name = "histories",
    .doc = "displacements of the floors that hit hardest, and the ground acceleration",
    .draw = draw,
};
