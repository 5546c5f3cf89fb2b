// SPDX-License-Identifier: GPL-3.0-or-later
// Largest values within a step.
//
// A quantity has an extremum inside a step where its rate changes sign. Displacements, velocities,
// drifts and all that is linear in displacements (forces of members, shears of linear buildings)
// have it on their interpolation. Of an acceleration, the interpolation gives the place only: the
// right-hand side is evaluated there and beside it, and a parabola put through the three. Forces
// and shears of parts that yield, and of hinges, are known at the ends of steps only. Most steps
// are far from any peak, and cost a few comparisons.
#include <math.h>

#include "core/number.h"
#include "model/forces.h"
#include "model/struck_column.h"
#include "solve/dormand_prince/dp.h"

// A peak of an acceleration is the top of a parabola through three that are this far apart in the
// step. It is found after so many tries, or left as it is.
static const double BESIDE = 0.02;
enum { TRIES = 3 };

// The interpolated acceleration may be too low by these factors: in general, and against the ends
// of the step.
static const double BEYOND = 1.1, NEARLY = 0.999;

// Place of the third stage.
static const double INNER = 0.3;

static void dp_raise(struct dp *p, enum peak q, int i, double value, double time) {
    if (fabs(value) > p->results->peak[q][i]) {
        p->results->peak[q][i] = fabs(value);
        p->results->peak_time[q][i] = time;
        p->grown |= q == PEAK_DISPLACEMENT || q == PEAK_VELOCITY;
    }
}

// Takes a value of a quantity into its peak. `what` and `i` are those of dp_motion.
typedef void dp_note(struct dp *p, int what, int i, double value, double time);

// A value of floor i: `q` is of enum peak. With a drift goes the shear of its storey, if that is
// all there is.
static void dp_note_floor(struct dp *p, int q, int i, double value, double time) {
    dp_raise(p, (enum peak)q, i, value, time);
    if (q == PEAK_DRIFT && p->model->building[p->system.building[i]].n_part == 0) {
        dp_raise(p, PEAK_SHEAR, i, dp_rates_shear(p, i, value), time);
    }
}

static void dp_note_member(struct dp *p, int what, int i, double value, double time) {
    (void)what;
    peaks_member(p->results, i, value, time);
}

// The deformation or the shear of storey i with a foundation: PEAK_DRIFT or PEAK_SHEAR.
static void dp_note_storey(struct dp *p, int q, int i, double value, double time) {
    peaks_storey(p->results, (enum peak)q, i, value, time);
}

static void dp_note_column(struct dp *p, int force, int i, double value, double time) {
    peaks_column(&p->results->column[i][force], value, time);
}

// Notes a quantity where it turns within the step.
static void dp_note_turns(struct dp *p, dp_note *note, int what, int i, const struct motion *m) {
    const struct motion_pieces s = hermite_cut(m);
    for (int j = 1; j < s.n; j++) {
        note(p, what, i, s.d[j], p->now.time + s.x[j] * p->h);
    }
}

// Notes a quantity that is linear in the displacements: at the end of the step, and where it turns.
static void dp_follow(struct dp *p, dp_value *value, dp_note *note, int what, int i) {
    const struct motion m = dp_motion(p, value, what, i);
    if (m.v[0] * m.v[1] < 0.0 && !dp_step_is_instant(p)) {
        dp_note_turns(p, note, what, i, &m);
    }
    note(p, what, i, m.d[1], p->next.time);
}

// Could a quantity that has these rates at both ends and this value at the second go beyond the
// peak between them?
static bool dp_may_exceed(const struct dp *p, double peak, double rate0, double value,
                          double rate1) {
    return rate0 * rate1 < 0.0 && fabs(value) + p->h * fabs(rate1) > peak;
}

// The displacement or drift of floor i where it turns.
static void dp_floor_turns(struct dp *p, int q, int i, const struct motion *m) {
    if (dp_may_exceed(p, p->results->peak[q][i], m->v[0], m->d[1], m->v[1])) {
        dp_note_turns(p, dp_note_floor, q, i, m);
    }
}

// The velocity turns where the relative acceleration is zero.
static void dp_velocity_turns(struct dp *p, int i, const struct motion *m) {
    if (dp_may_exceed(p, p->results->peak[PEAK_VELOCITY][i], m->a[0], m->v[1], m->a[1])) {
        const struct polynomial v = hermite_velocity(m), u = hermite_path(m);
        const struct polynomial slope = {{v.c[1], 2.0 * v.c[2], 3.0 * v.c[3]}};
        const double x = hermite_root(slope, 0.0, 1.0);
        dp_raise(p, PEAK_VELOCITY, i, hermite_slope(&u, x) / p->h, p->now.time + x * p->h);
    }
}

static double dp_total(const struct dp_rates *r, const struct building *g, int i) {
    return r->a[i] + r->ground.a[g->ground];
}

// Where the interpolated total acceleration has its largest value inside; < 0: at an end, or far
// below the peak so far.
static double dp_acceleration_place(const struct dp *p, const struct building *g, int i) {
    const struct motion m = dp_motion(p, dp_displacement, 0, i);
    struct polynomial u = hermite_path(&m);
    double square = p->h * p->h;
    double ground0 = p->now.ground_a[g->ground];
    double rise = p->next.ground_a[g->ground] - ground0;
    double bend = (ground0 + INNER * rise - p->stage[2].ground.a[g->ground]) /
                  (INNER * (1.0 - INNER));  // the ground's parabola, of a sine
    struct polynomial a = {{2.0 * u.c[2] / square + ground0, 6.0 * u.c[3] / square + rise - bend,
                            12.0 * u.c[4] / square + bend, 20.0 * u.c[5] / square, 0.0, 0.0}};
    double ends =
        fmax(fabs(dp_total(&p->stage[0], g, i)), fabs(dp_total(&p->stage[DP_LAST], g, i)));
    double best = fmax(NEARLY * ends, p->results->peak[PEAK_ACCELERATION][i] / BEYOND);
    double place = -1.0;
    double x[2];
    int n = hermite_extrema(&a, x);
    for (int j = 0; j < n; j++) {
        double size = fabs(hermite_value(&a, x[j]));
        if (size > best) {
            best = size;
            place = x[j];
        }
    }
    return place;
}

// The total acceleration of floor i at place x of the step.
static double dp_acceleration(struct dp *p, double x, int i) {
    int building = p->system.building[i];
    dp_rates_within(p, x, building);
    return dp_total(&p->stage[1], &p->model->building[building], i);
}

// The acceleration at the top of the parabola through that at place x and those beside it, if the
// top is as near as they are, else at x; again from the top, if it is not.
static void dp_acceleration_turns(struct dp *p, const struct building *g, int i) {
    double x = dp_acceleration_place(p, g, i);
    for (int n = 0; n < TRIES && x > 0.0 && x < 1.0; n++) {
        double beside = fmin(BESIDE, fmin(x, 1.0 - x));
        double low = dp_acceleration(p, x - beside, i);
        double high = dp_acceleration(p, x + beside, i);
        double middle = dp_acceleration(p, x, i);
        double bend = low - 2.0 * middle + high;
        double slope = (high - low) / 2.0;
        double shift = fabs(bend) > fabs(slope) ? -slope / bend : 0.0;
        dp_raise(p, PEAK_ACCELERATION, i, middle + shift * slope / 2.0,
                 p->now.time + (x + shift * beside) * p->h);
        double top = bend * middle < 0.0 ? x - slope / bend * beside : x;
        if (fabs(top - x) < BESIDE) {
            return;
        }
        x = top;
    }
}

// Could the acceleration of a floor have a peak within the step, by those at the stages?
static bool dp_may_bend(const struct dp *p, const struct dp_candidates *c, int i) {
    if (p->model->n_ground == 1) {
        return c->bends[i - c->first] < 0;
    }
    const struct building *g = &p->model->building[p->system.building[i]];
    double most =
        number_max(fabs(dp_total(&p->stage[2], g, i)), fabs(dp_total(&p->stage[3], g, i)));
    return BEYOND * most > p->results->peak[PEAK_ACCELERATION][i];
}

static void dp_floor_within(struct dp *p, const struct dp_candidates *c, int i) {
    const struct motion own = dp_motion(p, dp_displacement, 0, i);
    const struct motion drift = dp_motion(p, dp_drift, 0, i);
    dp_floor_turns(p, PEAK_DISPLACEMENT, i, &own);
    dp_velocity_turns(p, i, &own);
    dp_floor_turns(p, PEAK_DRIFT, i, &drift);
    if (dp_may_bend(p, c, i)) {
        dp_acceleration_turns(p, &p->model->building[p->system.building[i]], i);
    }
}

// Values at one instant. The shear of an elastic storey is largest with its drift.
static void dp_floor_at(struct dp *p, const struct state *s, int i) {
    const struct building *g = &p->model->building[p->system.building[i]];
    dp_raise(p, PEAK_DISPLACEMENT, i, s->u[i], s->time);
    dp_raise(p, PEAK_VELOCITY, i, s->v[i], s->time);
    dp_raise(p, PEAK_ACCELERATION, i, s->a[i] + s->ground_a[g->ground], s->time);
    if (!g->elastic || fabs(s->drift[i]) > p->results->peak[PEAK_DRIFT][i]) {
        dp_note_floor(p, PEAK_DRIFT, i, s->drift[i], s->time);
    }
}

// The shear of the storey below floor i, or its rate by velocities, in a linear building with
// parts: a row of the stiffness on drifts. On a foundation the row of the slab is taken off
// (foundation.c).
static double dp_linear_shear(const struct dp *p, int what, int i, const double *x) {
    const struct building *g = &p->model->building[p->system.building[i]];
    const int n = g->n_dof, row = i - g->first;
    double sum = 0.0;
    (void)what;
    for (int j = 0; j < n; j++) {
        const double own =
            g->fixed ? -g->part_stiffness[g->n_floor * n + j] : (j == row ? g->spring[row] : 0.0);
        sum += (g->part_stiffness[row * n + j] + own) * dp_drift(p, 0, g->first + j, x);
    }
    return sum;
}

// The storey shears of a building with parts, and the deformations on a foundation. Shears of parts
// that yield are known at the end of the step only.
static void dp_part_shears(struct dp *p, const struct building *g) {
    struct state *now = &p->now, *next = &p->next;
    dp_note *const note = g->fixed ? dp_note_storey : dp_note_floor;
    const double *shear = p->system.force;
    if (!g->elastic) {
        dp_rates_parts(p, g, dp_step_is_instant(p) ? now->storey_history : p->system.part_history,
                       next->u, next->v, next->storey_history);
    }
    for (int i = g->first; i < g->first + (g->fixed ? g->n_floor : g->n_dof); i++) {
        if (g->fixed) {
            dp_follow(p, dp_deformation, note, PEAK_DRIFT, i);
        }
        if (g->elastic) {
            dp_follow(p, dp_linear_shear, note, PEAK_SHEAR, i);
        } else {
            const double other =
                g->fixed ? -shear[g->first + g->n_floor] : dp_rates_shear(p, i, next->drift[i]);
            note(p, PEAK_SHEAR, i, shear[i] + other, next->time);
        }
    }
}

// The force of the spring of column i, which has a law, at the end of the step.
static double dp_column_spring(const struct dp *p, int i) {
    const int k = struck_column_spring(p->model, i);
    return dp_rates_response(p, k, p->next.delta[k], 0.0).force;
}

// The number of the column with this struck point, which is a body behind the buildings.
static int dp_column_at(const struct dp *p, int point) {
    return p->system.building[point] - p->model->n_building;
}

// The displacement of a struck point at displacements x, in the forces of members. That of a column
// with a law is right at the end of the step only.
static double dp_struck(const struct dp *p, int point, const double *x) {
    const struct model *m = p->model;
    const int i = dp_column_at(p, point);
    const struct struck_column *c = &m->column[i];
    return c->yields ? struck_column_elastic(c, x[point], p->next.delta[struck_column_spring(m, i)],
                                             dp_column_spring(p, i))
                     : x[point];
}

// The forces that follow from the drifts of a building. They are linear in the displacements, but
// with hinges, whose history at the end of the step dp_part_shears has found, and with columns that
// yield.
static void dp_members(struct dp *p, const struct building *g) {
    const struct state *now = &p->now, *next = &p->next;
    const double *const x[DP_FORCES] = {next->u, now->u, now->v, next->v, now->a, next->a};
    double *drift = p->system.drift, *const *f = p->force;
    bool linear = g->n_hinge == 0;
    for (int i = 0; i < g->n_struck; i++) {
        linear &= !p->model->column[dp_column_at(p, g->struck[i])].yields;
    }
    for (int k = 0; k < (linear ? DP_FORCES : 1); k++) {
        for (int i = g->first; i < g->first + g->n_dof; i++) {
            drift[i] = dp_drift(p, 0, i, x[k]);
        }
        for (int i = 0; i < g->n_struck; i++) {
            drift[g->struck[i]] = dp_struck(p, g->struck[i], x[k]);
        }
        forces_at(g, drift + g->first, next->storey_history, drift, f[k]);
    }
    for (int i = 0; i < g->n_force; i++) {
        const int j = g->force + i;
        dp_note_member(p, 0, j, f[0][i], next->time);
        if (!linear || f[2][i] * f[3][i] >= 0.0 || dp_step_is_instant(p)) {
            continue;
        }
        const struct motion m = {
            .d = {f[1][i], f[0][i]}, .v = {f[2][i], f[3][i]}, .a = {f[4][i], f[5][i]}, .h = p->h};
        const double way = p->h * fabs(m.v[1]);
        if (m.d[1] + way > p->results->force_max[j] || m.d[1] - way < p->results->force_min[j]) {
            dp_note_turns(p, dp_note_member, 0, j, &m);
        }
    }
}

static double dp_column_force(const struct dp *p, int force, int i, const double *x) {
    return struck_column_force(&p->model->column[i], (enum column_force)force, x, 0.0);
}

// The forces in struck columns: of those that yield at the end of the step only.
static void dp_columns(struct dp *p) {
    const struct model *m = p->model;
    for (int i = 0; i < m->n_column; i++) {
        const struct struck_column *c = &m->column[i];
        const double spring = c->yields ? dp_column_spring(p, i) : 0.0;
        for (int q = 0; q < COLUMN_FORCE_COUNT; q++) {
            if (c->yields) {
                const double force =
                    struck_column_force(c, (enum column_force)q, p->next.u, spring);
                dp_note_column(p, q, i, force, p->next.time);
            } else {
                dp_follow(p, dp_column_force, dp_note_column, q, i);
            }
        }
    }
}

// Makes the scales of errors again, if motions have grown.
static void dp_rescale(struct dp *p) {
    if (p->grown) {
        p->grown = false;
        scale_update(&p->scales, p->model, p->results);
    }
}

// Where there are several grounds, or storeys with a history, no bound is known.
void dp_peaks_step(struct dp *p) {
    const struct model *m = p->model;
    bool always = m->n_ground != 1 || !m->elastic;
    struct dp_candidates c;
    for (c.first = 0; c.first < m->n_dof; c.first += DP_CANDIDATES) {
        c.n = m->n_dof - c.first < DP_CANDIDATES ? m->n_dof - c.first : DP_CANDIDATES;
        bool found = p->floors->candidates(p, &c);
        for (int i = 0; (found || always) && i < c.n; i++) {
            if ((always || c.hit[i] < 0) && !dp_step_is_instant(p)) {
                dp_floor_within(p, &c, c.first + i);
            }
            if (always || c.hit[i] < 0) {
                dp_floor_at(p, &p->next, c.first + i);
            }
        }
    }
    for (int k = 0; m->chain.parts && k < m->n_body; k++) {
        if (m->building[k].n_part > 0) {
            dp_part_shears(p, &m->building[k]);
        }
    }
    for (int k = 0; m->n_force > 0 && k < m->n_building; k++) {
        if (m->building[k].n_force > 0) {
            dp_members(p, &m->building[k]);
        }
    }
    dp_columns(p);
    dp_rescale(p);
}

void dp_peaks_jump(struct dp *p) {
    if (!p->jumped) {
        return;
    }
    p->jumped = false;
    for (int i = 0; i < p->model->n_dof; i++) {
        dp_floor_at(p, &p->now, i);
    }
    dp_rescale(p);
    for (int i = 0; i < p->now.n_live; i++) {
        int k = p->now.live[i];
        struct impact_share share = {.force = p->stage[0].link[i].response.force};
        peaks_force(p->results, k, peaks_size(p->model, k, share.force), p->now.time);
        impacts_add(p->impacts, k, &share);
    }
}
