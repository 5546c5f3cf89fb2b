// SPDX-License-Identifier: GPL-3.0-or-later
// Displacements of the two facing floors that hit each other hardest, with the gap between them
// shaded and the impacts marked; without impacts, of the roofs of the first two buildings. Below
// them the ground acceleration. Two runs are laid over each other floor by floor.
//
// The right floor is drawn where the left one sees it: x_left - delta = x_right + gap.
#include <math.h>
#include <string.h>

#include "plot/figure.h"
#include "plot/panel.h"
#include "plot/script.h"

enum { BINS = 200, MARKS_MAX = 400 };

// Columns of the data.
enum { TIME, LEFT, RIGHT, GROUND_LEFT, GROUND_RIGHT, N_COLUMN };

static const char gap_colour[] = "#dddddd";
static const char dark[] = "#404040";

struct view {
    const struct runs *s;
    struct facing at;
    struct data data[RUNS_MAX];
};

static int check(const struct subject *p, struct error *e) {
    return runs_need(p->runs, FIELD_DISPLACEMENT, "floor displacements", e);
}

// Moves the right side by the gap, so that both curves meet at an impact. The penetration is used
// if the file has it, because it also holds for different grounds; otherwise the displacements.
static void shift_right(struct view *v, struct canvas *c) {
    const struct report *r = v->s->r[0];
    const int contact = v->at.contact[0];
    struct data *d = &v->data[0];
    double *right = d->column[RIGHT];
    const bool exact = r->fields & FIELD_PENETRATION;
    if (exact) {
        const struct history h = {HISTORY_CONTACT, FIELD_PENETRATION, contact, 0};
        c->status = result_history(v->s->file[0], &h, right, c->e);
    }
    for (size_t i = 0; i < d->n_row; i++) {
        right[i] = exact ? d->column[LEFT][i] - right[i] : right[i] + r->contact[contact].gap;
    }
}

// The displacements of both sides and the grounds below them; those of a wall are zero.
static void read_run(struct view *v, int run, struct canvas *c) {
    struct data *d = &v->data[run];
    struct history h[N_COLUMN] = {{.kind = HISTORY_TIME}};
    for (int side = 0; side < 2; side++) {
        h[LEFT + side] = (struct history){HISTORY_FLOOR, FIELD_DISPLACEMENT, v->at.building[side],
                                          v->at.floor[side]};
        h[GROUND_LEFT + side] = (struct history){HISTORY_GROUND, 0, v->at.building[side], 0};
    }
    bool good = runs_read(v->s, run, h, N_COLUMN, d, c);
    for (int side = 0; side < 2 && good; side++) {
        if (v->at.building[side] >= 0 && !isnan(v->at.level[side])) {
            good = runs_move_to_level(v->s, run, v->at.building[side], v->at.floor[side],
                                      v->at.weight[side], d->column[LEFT + side], d->n_row, c);
        }
    }
    if (good && v->s->n == 1 && v->at.contact[0] >= 0) {
        shift_right(v, c);
    }
}

// The hardest impact of each of MARKS_MAX parts of the duration, on the curve of a side.
static void write_marks(const struct view *v, int run, int side, struct canvas *c) {
    const struct report *r = v->s->r[run];
    long hardest[MARKS_MAX];
    runs_hardest_of_parts(r, v->at.contact[run], MARKS_MAX, hardest);
    canvas_block(c, "time displacement force", "marks%d%d", run, side);
    fputs("NaN NaN NaN\n", c->data);
    for (int b = 0; b < MARKS_MAX; b++) {
        if (hardest[b] >= 0) {
            const struct impact *i = &r->impact[hardest[b]];
            fprintf(c->data, "%.7g %.7g %.7g\n", i->t_start,
                    data_at(&v->data[run], LEFT + side, i->t_start), i->peak_force);
        }
    }
    canvas_end(c);
}

static const char *side_name(const struct view *v, int side) {
    const int building = v->at.building[side];
    return building < 0 ? "wall" : v->s->r[0]->building[building].name;
}

// Behind the name.
static void write_floor_name(const struct view *v, int side, char *text, size_t size) {
    text[0] = '\0';
    if (v->at.building[side] >= 0 && isnan(v->at.level[side])) {
        snprintf(text, size, ", floor %d", v->at.floor[side] + 1);
    } else if (v->at.building[side] >= 0) {
        snprintf(text, size, ", level %.4g %s", v->at.level[side], v->s->r[0]->units.length_name);
    }
}

// The impacts of the contact in each run.
struct hits {
    char force[RUNS_MAX][32];  // the largest
    long impacts[RUNS_MAX];
    bool rigid;  // in any run: there is no force
};

static void write_title(const struct view *v, struct canvas *c) {
    const struct report *r = v->s->r[0];
    const char *title = v->s->title;
    char length[64], unit[64], name[64], gap[32];
    if (v->at.contact[0] < 0) {
        canvas_head(c, title, "displacement of the roofs; %s",
                    r->n_contact > 0 ? "no contact closed" : "there are no contacts");
        return;
    }
    const struct report_link *link = &r->contact[v->at.contact[0]];
    struct hits h = {.force = {"0", "0"}};
    for (int k = 0; k < v->s->n; k++) {
        if (v->at.contact[k] >= 0) {
            const struct link_peak *p = &v->s->r[k]->contact[v->at.contact[k]].peak;
            script_number(p->force, h.force[k], sizeof h.force[k]);
            h.rigid |= isnan(p->force);
            h.impacts[k] = p->impacts;
        }
    }
    const char *impacts = h.impacts[0] == 1 ? "impact" : "impacts";
    script_unit(&r->units, dimension_length, length, sizeof length);
    script_unit(&r->units, dimension_force, unit, sizeof unit);
    script_shorten(link->name, 12, name, sizeof name);
    script_number(link->gap, gap, sizeof gap);
    if (v->s->n > 1 && h.rigid) {
        canvas_head(c, title, "contact %s: %ld and %ld impacts", name, h.impacts[0], h.impacts[1]);
    } else if (v->s->n > 1) {
        canvas_head(c, title, "contact %s: largest force %s and %s %s", name, h.force[0],
                    h.force[1], unit);
    } else if (h.rigid) {
        canvas_head(c, title, "contact %s: gap %s %s, %ld %s of rigid bodies", name, gap, length,
                    h.impacts[0], impacts);
    } else {
        canvas_head(c, title, "contact %s: gap %s %s, %ld %s, largest force %s %s", name, gap,
                    length, h.impacts[0], impacts, h.force[0], unit);
    }
}

static struct axis displacement_axis(const char *name, struct span span) {
    return (struct axis){
        .name = name, .dimension = dimension_length, .span = span_with_room(span, NAN)};
}

// Both floors with the gap between them.
static void draw_facing(const struct view *v, struct canvas *c, struct area a, bool at_foot) {
    struct span span = span_none;
    const bool hit = v->at.contact[0] >= 0, two = hit || v->at.building[1] >= 0;
    data_span(&v->data[0], LEFT, &span);
    if (two) {
        data_span(&v->data[0], RIGHT, &span);
    }
    panel_open(c, &(struct panel){.area = a,
                                  .x = runs_time_axis(v->s, at_foot),
                                  .y = displacement_axis("displacement", span)});
    if (hit) {
        panel_series(c, (struct style){STYLE_AREA_BELOW, .colour = gap_colour},
                     "$rows0 using 1:2:3");
    }
    if (two) {
        panel_series(c, panel_line(script_colour[1], 0), "$rows0 using 1:3");
    }
    panel_series(c, panel_line(script_colour[0], 0), "$rows0 using 1:2");
    if (hit) {
        panel_series(c, panel_points("#000000", POINT_DISC, 0.8), "$marks00 using 1:2");
    }
    panel_close(c);
}

// One floor in both runs.
static void draw_floor(const struct view *v, struct canvas *c, struct area a, int side) {
    struct span span = span_none;
    char floor[48];
    for (int k = 0; k < v->s->n; k++) {
        data_span(&v->data[k], LEFT + side, &span);
    }
    write_floor_name(v, side, floor, sizeof floor);
    panel_open(c, &(struct panel){.area = a,
                                  .x = runs_time_axis(v->s, false),
                                  .y = displacement_axis("displ.", span),
                                  .caption = side_name(v, side),
                                  .tail = floor});
    for (int k = 0; k < v->s->n; k++) {
        panel_series(c, panel_line(script_colour[k], 0), "$rows%d using 1:%d", k, LEFT + side + 1);
    }
    for (int k = 0; k < v->s->n && v->at.contact[0] >= 0; k++) {
        panel_series(c, panel_points(script_colour[k], k > 0 ? POINT_RING : POINT_DISC, 0.9),
                     "$marks%d%d using 1:2", k, side);
    }
    panel_close(c);
}

static bool same(const struct data *p, int i, const struct data *q, int j) {
    return p->n_row == q->n_row &&
           memcmp(p->column[i], q->column[j], p->n_row * sizeof(double)) == 0;
}

// The grounds under both sides, or of both runs; one where they are the same.
static void draw_ground(const struct view *v, struct canvas *c, struct area a) {
    const int other = v->s->n - 1;
    const int first = v->at.building[0] >= 0 ? GROUND_LEFT : GROUND_RIGHT;
    const int second = v->s->n > 1 || v->at.building[1] < 0 ? first : GROUND_RIGHT;
    const bool one = same(&v->data[0], first, &v->data[other], second);
    struct span span = span_none;
    data_span(&v->data[0], first, &span);
    data_span(&v->data[other], second, &span);
    span_add(&span, 0);
    panel_open(c, &(struct panel){.area = a,
                                  .x = runs_time_axis(v->s, true),
                                  .y = {.name = v->s->n > 1 ? "ground" : "ground acc.",
                                        .dimension = dimension_acceleration,
                                        .span = span_with_room(span, NAN)}});
    struct style line = panel_line(one ? dark : script_colour[0], 0.7);
    panel_series(c, line, "$rows0 using 1:%d", first + 1);
    if (!one) {
        line.colour = script_colour[1];
        panel_series(c, line, "$rows%d using 1:%d", other, second + 1);
    }
    panel_close(c);
}

static void write_legend(const struct view *v, struct canvas *c) {
    struct legend l = {0};
    const bool hit = v->at.contact[0] >= 0;
    // The displacements of both sides; that of the right side includes the gap.
    for (int side = 0; side < 2 && v->s->n == 1; side++) {
        char floor[48], tail[64];
        write_floor_name(v, side, floor, sizeof floor);
        snprintf(tail, sizeof tail, "%s%s", floor, side == 1 && hit ? " + gap" : "");
        if (hit || v->at.building[side] >= 0) {
            legend_add(&l, panel_line(script_colour[side], 0), side_name(v, side), tail);
        }
    }
    if (v->s->n == 1 && hit) {
        legend_add(&l, panel_area(gap_colour), "gap", "");
    }
    runs_legend(v->s, NULL, &l);
    if (hit) {
        legend_add(&l, panel_points("#000000", POINT_DISC, 0.8), "impacts", "");
    }
    legend_write(&l, c);
}

static void write_data(const struct view *v, int run, struct canvas *c) {
    data_write(&v->data[run], BINS, c, "time left right ground_left ground_right", "rows%d", run);
    for (int side = 0; side < (v->s->n > 1 ? 2 : 1); side++) {
        write_marks(v, run, side, c);
    }
}

static void draw_panels(const struct view *v, struct canvas *c) {
    int shown[2], n = 0;
    for (int side = 0; side < 2; side++) {
        if (v->at.building[side] >= 0) {
            shown[n++] = side;
        }
    }
    if (v->s->n == 1) {
        struct span span = {0, 0};
        data_span(&v->data[0], GROUND_LEFT, &span);
        data_span(&v->data[0], GROUND_RIGHT, &span);
        const bool ground = span.low < span.high;  // the ground below these floors moves
        draw_facing(v, c,
                    canvas_inset(canvas_part(c, 0, 1, ground ? 0.38 : 0, 1), 7, 0.5,
                                 ground ? 0.5 : 3.2, 0.7),
                    !ground);
        if (ground) {
            draw_ground(v, c, canvas_inset(canvas_part(c, 0, 1, 0, 0.38), 7, 0.5, 3.2, 0.5));
        }
        return;
    }
    for (int i = 0; i < n; i++) {
        const double height = 0.68 / n, top = 1 - i * height;
        draw_floor(v, c, canvas_inset(canvas_part(c, 0, 1, top - height, top), 7, 0.5, 0, 1.8),
                   shown[i]);
    }
    draw_ground(v, c, canvas_inset(canvas_part(c, 0, 1, 0, 0.32), 7, 0.5, 3.2, 0.5));
}

static void draw(const struct subject *subject, struct canvas *c) {
    const struct runs *s = subject->runs;
    struct view v = {.s = s};
    runs_facing(s, &v.at);
    for (int k = 0; k < s->n; k++) {
        read_run(&v, k, c);
    }
    if (c->status == STATUS_OK) {
        for (int k = 0; k < s->n; k++) {
            write_data(&v, k, c);
        }
        write_title(&v, c);
        write_legend(&v, c);
        draw_panels(&v, c);
    }
    for (int k = 0; k < s->n; k++) {
        data_free(&v.data[k]);
    }
}

const struct figure figure_histories = {
    .name = "histories",
    .doc =
        "displacements of the floors with the largest contact force, and the ground acceleration",
    .check = check,
    .draw = draw,
};
