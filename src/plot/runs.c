// SPDX-License-Identifier: GPL-3.0-or-later
// Two runs beside each other.
#include "plot/runs.h"

#include <assert.h>
#include <math.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include "core/arena.h"
#include "core/text.h"
#include "plot/script.h"

// The file's name, without its folder and ending where that tells the two apart.
static void name_run(struct runs *s, int run, bool whole) {
    const char *path = s->r[run]->file;
    char text[1024];
    size_t n;
    const char *stem = text_stem(path, &n);
    snprintf(text, sizeof text, "%.*s", (int)n, stem);
    script_shorten(whole ? path : text, 16, s->name[run], sizeof s->name[run]);
}

// The error that says in what two runs differ.
__attribute__((format(printf, 3, 4))) static int differ(const struct runs *s, struct error *e,
                                                        const char *format, ...) {
    char what[256];
    va_list list;
    va_start(list, format);
    vsnprintf(what, sizeof what, format, list);
    va_end(list);
    return error_set(e, STATUS_INPUT, "%s and %s cannot be compared: %s", s->r[0]->file,
                     s->r[1]->file, what);
}

static int match_buildings(const struct runs *s, struct error *e) {
    const struct report *a = s->r[0], *b = s->r[1];
    if (a->n_building != b->n_building) {
        return differ(s, e, "number of buildings is %d in one, %d in the other", a->n_building,
                      b->n_building);
    }
    for (int i = 0; i < a->n_building; i++) {
        const struct report_building *p = &a->building[i], *q = &b->building[i];
        if (strcmp(p->name, q->name) != 0) {
            return differ(s, e, "a building is '%.40s' in one, '%.40s' in the other", p->name,
                          q->name);
        }
        if (p->n_floor != q->n_floor) {
            return differ(s, e, "number of floors of '%.40s' is %d in one, %d in the other",
                          p->name, p->n_floor, q->n_floor);
        }
    }
    return STATUS_OK;
}

static int match(const struct runs *s, struct error *e) {
    const struct unit_system *a = &s->r[0]->units, *b = &s->r[1]->units;
    return a->force == b->force && a->length == b->length && a->time == b->time
               ? match_buildings(s, e)
               : differ(s, e, "units are '%s %s %s' in one, '%s %s %s' in the other", a->force_name,
                        a->length_name, a->time_name, b->force_name, b->length_name, b->time_name);
}

int runs_init(struct runs *s, const struct result_file *first, const struct result_file *second,
              struct error *e) {
    *s = (struct runs){.n = second ? 2 : 1, .file = {first, second}};
    for (int k = 0; k < s->n; k++) {
        s->r[k] = result_report(s->file[k]);
        name_run(s, k, false);
    }
    const struct report *r = s->r[0];
    s->title = r->title[0] ? r->title : r->deck_file;
    if (s->n == 1) {
        if (r->run > 0) {
            s->title = arena_format(r->arena, "run %ld: %s", r->run, s->title);
        }
        if (s->title && r->collapse.happened) {
            s->title = arena_format(r->arena, "%s (collapsed at %.4g %s)", s->title,
                                    r->collapse.time, r->units.time_name);
        }
        return s->title ? STATUS_OK : error_no_memory(e);
    }
    if (strcmp(s->name[0], s->name[1]) == 0) {
        name_run(s, 0, true);
        name_run(s, 1, true);
    }
    return match(s, e);
}

bool runs_read(const struct runs *s, int run, const struct history *h, int n, struct data *d,
               struct canvas *c) {
    assert(run >= 0 && run < s->n && n > 0);
    *d = (struct data){.n_row = 0};
    if (c->status == STATUS_OK) {
        c->status = result_check_memory(s->file[run], n, c->e);
    }
    if (c->status == STATUS_OK) {
        c->status = data_create(d, s->r[run]->n_row, n, c->e);
    }
    for (int i = 0; i < n && c->status == STATUS_OK; i++) {
        c->status =
            h[i].index < 0 ? STATUS_OK : result_history(s->file[run], &h[i], d->column[i], c->e);
    }
    d->n_row = c->status == STATUS_OK ? d->n_row : 0;
    return c->status == STATUS_OK;
}

bool runs_have(const struct runs *s, unsigned fields) {
    for (int k = 0; k < s->n; k++) {
        if ((s->r[k]->fields & fields) != fields) {
            return false;
        }
    }
    return true;
}

int runs_lack(const struct runs *s, const char *what, struct error *e) {
    return error_set(e, STATUS_INPUT, "%s%s%s has no %s", s->r[0]->file, s->n > 1 ? " or " : "",
                     s->n > 1 ? s->r[1]->file : "", what);
}

int runs_need(const struct runs *s, unsigned fields, const char *what, struct error *e) {
    char text[96];
    snprintf(text, sizeof text, "%s; see output -fields", what);
    return runs_have(s, fields) ? STATUS_OK : runs_lack(s, text, e);
}

int runs_lack_contacts(const struct runs *s, struct error *e) {
    return runs_lack(s, s->n > 1 ? "contacts; name the run that has them first" : "contacts", e);
}

// How hard something is hit. Rigid impacts have no force, which is NAN then.
struct blow {
    double force, impulse;
};

// Any force is harder than none; without forces the impulses count.
static bool harder(struct blow a, struct blow b) {
    if (isnan(a.force) != isnan(b.force)) {
        return isnan(b.force);
    }
    return isnan(a.force) ? a.impulse > b.impulse : a.force > b.force;
}

static struct blow contact_blow(const struct report *r, int i) {
    return (struct blow){r->contact[i].peak.force, r->contact[i].peak.impulse};
}

static struct blow impact_blow(const struct report *r, long i) {
    return (struct blow){r->impact[i].peak_force, r->impact[i].impulse};
}

static int hardest(const struct report *r) {
    int at = -1;
    for (int i = 0; i < r->n_contact; i++) {
        if (r->contact[i].peak.impacts > 0 &&
            (at < 0 || harder(contact_blow(r, i), contact_blow(r, at)))) {
            at = i;
        }
    }
    return at;
}

static bool same_level(double a, double b) {
    return a == b || (isnan(a) && isnan(b));
}

static int find_contact(const struct report *r, const struct report_link *like) {
    for (int i = 0; i < r->n_contact; i++) {
        const struct report_link *c = &r->contact[i];
        if (strcmp(c->left, like->left) == 0 && strcmp(c->right, like->right) == 0 &&
            c->left_floor == like->left_floor && c->right_floor == like->right_floor &&
            same_level(c->left_level, like->left_level) &&
            same_level(c->right_level, like->right_level)) {
            return i;
        }
    }
    return -1;
}

int runs_same_contact(const struct runs *s, int run, int i) {
    assert(run >= 0 && run < s->n);
    return run == 0 || i < 0 ? i : find_contact(s->r[run], &s->r[0]->contact[i]);
}

void runs_hardest_contact(const struct runs *s, int *contact) {
    contact[0] = hardest(s->r[0]);
    contact[1] = s->n == 1 ? -1 : runs_same_contact(s, 1, contact[0]);
    if (s->n == 2 && contact[0] < 0) {
        contact[1] = hardest(s->r[1]);
        contact[0] = contact[1] < 0 ? -1 : find_contact(s->r[0], &s->r[1]->contact[contact[1]]);
    }
}

long runs_hardest_impact(const struct report *r, int contact) {
    long at = -1;
    for (long i = 0; contact >= 0 && i < r->n_impact; i++) {
        if (r->impact[i].contact == contact &&
            (at < 0 || harder(impact_blow(r, i), impact_blow(r, at)))) {
            at = i;
        }
    }
    return at;
}

void runs_hardest_of_parts(const struct report *r, int contact, int parts, long *hardest) {
    assert(parts > 0 && hardest);
    for (int k = 0; k < parts; k++) {
        hardest[k] = -1;
    }
    for (long i = 0; i < r->n_impact; i++) {
        if (r->impact[i].contact != contact) {
            continue;
        }
        const double part = r->impact[i].t_start / r->duration * parts;
        const int k = part >= 0 && part < parts ? (int)part : parts - 1;
        if (hardest[k] < 0 || harder(impact_blow(r, i), impact_blow(r, hardest[k]))) {
            hardest[k] = i;
        }
    }
}

int runs_building(const struct report *r, const char *name) {
    for (int i = 0; i < r->n_building; i++) {
        if (strcmp(r->building[i].name, name) == 0) {
            return i;
        }
    }
    return -1;
}

void runs_facing(const struct runs *s, struct facing *f) {
    const struct report *r = s->r[0];
    runs_hardest_contact(s, f->contact);
    const struct report_link *c = f->contact[0] >= 0 ? &r->contact[f->contact[0]] : NULL;
    for (int side = 0; side < 2; side++) {
        const bool left = side == 0;
        f->building[side] = c                      ? runs_building(r, left ? c->left : c->right)
                            : side < r->n_building ? side
                                                   : -1;
        f->floor[side] = c                        ? (left ? c->left_floor : c->right_floor) - 1
                         : f->building[side] >= 0 ? r->building[side].n_floor - 1
                                                  : 0;
        f->level[side] = c ? (left ? c->left_level : c->right_level) : (double)NAN;
        f->weight[side] = c ? (left ? c->left_weight : c->right_weight) : 1;
    }
}

bool runs_has_heights(const struct report_building *b) {
    int n = 0;
    while (n < b->n_floor && b->height[n] > 0) {
        n++;
    }
    return n == b->n_floor;
}

double runs_level(const struct report_building *b, int floors, bool heights) {
    double level = 0;
    for (int i = 0; i < floors; i++) {
        level += heights ? b->height[i] : 1;
    }
    return level;
}

// The longest duration.
static double runs_duration(const struct runs *s) {
    return s->n == 1 ? s->r[0]->duration : fmax(s->r[0]->duration, s->r[1]->duration);
}

struct axis runs_time_axis(const struct runs *s, bool at_foot) {
    return (struct axis){.name = at_foot ? "time" : NULL,
                         .dimension = dimension_time,
                         .span = {0, runs_duration(s)},
                         .kind = at_foot ? AXIS_FULL : AXIS_WITHOUT_NUMBERS};
}

struct axis runs_height_axis(bool first, bool heights, double top) {
    const char *name = heights ? "height" : "floor";
    return (struct axis){.name = first ? name : NULL,
                         .unit = heights ? NULL : "",
                         .dimension = dimension_length,
                         .span = {0, 1.02 * top},
                         .kind = first ? AXIS_FULL : AXIS_WITHOUT_NUMBERS,
                         .step = heights ? 0 : 1};
}

void runs_legend(const struct runs *s, const char *colour, struct legend *l) {
    for (int k = 0; k < s->n && s->n > 1; k++) {
        struct style mark = panel_line(colour ? colour : script_colour[k], 0);
        mark.dash = colour && k > 0 ? "(10,6)" : NULL;
        legend_add(l, mark, s->name[k], "");
    }
}

bool runs_move_to_level(const struct runs *s, int run, int building, int floor, double weight,
                        double *u, size_t n, struct canvas *c) {
    assert(run >= 0 && run < s->n && building >= 0);
    double *below = calloc(n + 1, sizeof *below);
    if (!below) {
        c->status = error_no_memory(c->e);
        return false;
    }
    if (floor > 0) {
        const struct history h = {HISTORY_FLOOR, FIELD_DISPLACEMENT, building, floor - 1};
        c->status = result_history(s->file[run], &h, below, c->e);
    }
    for (size_t i = 0; c->status == STATUS_OK && i < n; i++) {
        u[i] = weight * u[i] + (1 - weight) * below[i];
    }
    free(below);
    return c->status == STATUS_OK;
}
