// SPDX-License-Identifier: GPL-3.0-or-later
// Floor response spectra: pseudo-acceleration, from the total accelerations in the rows of output,
// of the floors that hit hardest, of the roofs of their buildings, and of the ground. What happens
// between rows is not in it: a stiff impact needs rows as dense as its steps.
#include <math.h>

#include "core/arena.h"
#include "jostle/spectrum.h"
#include "plot/figure.h"
#include "plot/panel.h"
#include "plot/script.h"

enum { PERIODS = 100, SERIES_MAX = 6 };

static const double damping_ratio = 0.05;
static const double first_period = 0.02, last_period = 5;  // [s]
static const char *const ground_colour[] = {"#808080", "#b8b8b8"};

// A floor, or a ground.
struct owner {
    int building, floor;  // from 0; floor -1: the ground
};

struct view {
    const struct runs *s;
    struct owner series[SERIES_MAX];
    int n;
    int n_ground;  // of them, the last ones
    double dt;     // of the first run's rows
    struct span acceleration;
};

static int check(const struct subject *p, struct error *e) {
    return runs_need(p->runs, FIELD_ACCELERATION, "floor accelerations", e);
}

static void add(struct view *v, int building, int floor) {
    for (int i = 0; i < v->n; i++) {
        if (v->series[i].building == building && v->series[i].floor == floor) {
            return;
        }
    }
    v->series[v->n++] = (struct owner){building, floor};
}

static void choose(struct view *v, struct canvas *c) {
    const struct report *r = v->s->r[0];
    struct facing at;
    runs_facing(v->s, &at);
    const int *building = at.building;
    for (int i = 0; i < 4; i++) {  // the floors of both sides, then their roofs
        const int side = i % 2;
        if (building[side] >= 0) {
            add(v, building[side],
                i < 2 ? at.floor[side] : r->building[building[side]].n_floor - 1);
        }
    }
    if (v->n == 0) {
        canvas_fail(
            c, STATUS_INPUT,
            "spectrum cannot be drawn: the hardest contact of %s is at none of its buildings",
            r->file);
    }
    // Adds the ground below each of the two buildings: once if both grounds are the same, and only
    // if it moves.
    bool moves[2] = {false, false}, differ = false;
    for (int run = 0; run < v->s->n; run++) {
        const struct history h[] = {{HISTORY_GROUND, 0, building[0], 0},
                                    {HISTORY_GROUND, 0, building[1], 0}};
        struct data d;
        runs_read(v->s, run, h, 2, &d, c);
        for (size_t i = 0; i < d.n_row; i++) {
            moves[0] |= d.column[0][i] != 0;
            moves[1] |= d.column[1][i] != 0;
            differ |= d.column[0][i] != d.column[1][i];
        }
        data_free(&d);
    }
    const int n = v->n;
    for (int side = 0; side < 2; side++) {
        if (moves[side] && (side == 0 || differ)) {
            add(v, building[side], -1);
        }
    }
    v->n_ground = v->n - n;
}

// How many rows follow each other at even distances; the last row may stand nearer.
static size_t even_rows(const struct runs *s, int run, const struct data *d, struct canvas *c) {
    const double *time = d->column[0];
    const double dt = d->n_row > 1 ? time[1] - time[0] : 0;
    size_t i = 1;
    while (i < d->n_row && fabs(time[i] - time[0] - (double)i * dt) < 1e-6 * dt) {
        i++;
    }
    if (i < 2 || i + 1 < d->n_row) {
        canvas_fail(c, STATUS_INPUT,
                    "spectrum cannot be drawn: the rows of %s are not evenly spaced; see output "
                    "-interval",
                    s->r[run]->file);
    }
    return i;
}

static void write_spectrum(struct view *v, int run, int series, const struct signal *ground,
                           struct canvas *c) {
    const double second = 1 / v->s->r[run]->units.time;
    canvas_block(c, "period, pseudo-acceleration", "spectrum%d%d", run, series);
    for (int i = 0; i < PERIODS; i++) {
        const double period =
            second * first_period * pow(last_period / first_period, i / (PERIODS - 1.0));
        const double value = spectrum_at(ground, period, damping_ratio).value[SPECTRUM_PSA];
        fprintf(c->data, "%.7g %.7g\n", period, value);
        span_add(&v->acceleration, value);
        if (v->s->tell) {
            const long before = (long)(run * v->n + series) * PERIODS;
            v->s->tell(v->s->context, before + i + 1, (long)v->s->n * v->n * PERIODS);
        }
    }
    canvas_end(c);
}

static void write_series(struct view *v, int run, int series, struct canvas *c) {
    const struct owner *p = &v->series[series];
    const struct history h[] = {
        {.kind = HISTORY_TIME},
        {p->floor < 0 ? HISTORY_GROUND : HISTORY_FLOOR, FIELD_ACCELERATION, p->building, p->floor}};
    struct data d;
    struct signal ground;
    runs_read(v->s, run, h, 2, &d, c);
    const size_t n = even_rows(v->s, run, &d, c);
    struct arena *a = arena_create();
    if (!a) {
        c->status = error_no_memory(c->e);
    }
    if (c->status == STATUS_OK) {
        const double dt = d.column[0][1] - d.column[0][0];
        v->dt = run == 0 ? dt : v->dt;
        c->status = signal_init_samples(&ground, a, d.column[1], n, dt, 1, 0, c->e);
    }
    if (c->status == STATUS_OK) {
        write_spectrum(v, run, series, &ground, c);
    }
    arena_free(a);
    data_free(&d);
}

static const char *colour(const struct view *v, int series) {
    const int ground = series - (v->n - v->n_ground);
    return ground < 0 ? script_colour[series] : ground_colour[ground];
}

static void write_head(const struct view *v, struct canvas *c) {
    const struct report *r = v->s->r[0];
    struct legend l = {0};
    char text[160];
    canvas_head(c, v->s->title, "floor response spectra, %g %% damping, of rows every %.4g %s",
                100 * damping_ratio, v->dt, r->units.time_name);
    for (int i = 0; i < v->n; i++) {
        const struct owner *p = &v->series[i];
        const char *name = r->building[p->building].name;
        snprintf(text, sizeof text, ", floor %d", p->floor + 1);
        if (p->floor < 0) {
            name = v->n_ground > 1 ? name : "";
            snprintf(text, sizeof text, "%sground", name[0] ? ", " : "");
        }
        legend_add(&l, panel_line(colour(v, i), 0), name, text);
    }
    runs_legend(v->s, "#000000", &l);
    legend_write(&l, c);
}

static void draw_panel(const struct view *v, struct canvas *c) {
    const double second = 1 / v->s->r[0]->units.time;
    panel_open(c, &(struct panel){.area = canvas_inset(c->area, 5.8, 0.9, 3.2, 0.7),
                                  .x = {.name = "period",
                                        .dimension = dimension_time,
                                        .span = {second * first_period, second * last_period},
                                        .kind = AXIS_LOGARITHMIC},
                                  .y = {.name = "pseudo-acceleration",
                                        .dimension = dimension_acceleration,
                                        .span = span_with_room(v->acceleration, 0)}});
    for (int k = 0; k < v->n * v->s->n; k++) {
        const int run = k / v->n, i = k % v->n;
        struct style line = panel_line(colour(v, i), 0);
        line.dash = run > 0 ? "(10,6)" : "solid";
        panel_series(c, line, "$spectrum%d%d using 1:2", run, i);
    }
    panel_close(c);
}

static void draw(const struct subject *subject, struct canvas *c) {
    const struct runs *s = subject->runs;
    struct view v = {.s = s, .acceleration = span_none};
    choose(&v, c);
    for (int k = 0; k < s->n * v.n; k++) {
        write_series(&v, k / v.n, k % v.n, c);
    }
    write_head(&v, c);
    draw_panel(&v, c);
}

const struct figure figure_spectrum = {
    .name = "spectrum",
    .doc = "response spectra of the floors with the largest contact force and of the roofs",
    .check = check,
    .draw = draw,
};
