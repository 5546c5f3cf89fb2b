// SPDX-License-Identifier: GPL-3.0-or-later
// Largest values within a step.
//
// A quantity has an extremum inside a step where its rate changes sign; displacements, velocities
// and drifts have it on their interpolation. Of an acceleration, the interpolation gives the place
// only: the right-hand side is evaluated there and beside it, and a parabola put through the three.
// Most steps are far from any peak, and cost a few comparisons.
#include <math.h>

#include "core/number.h"
#include "core/root.h"
#include "solve/account/peaks.h"
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

// No peak is looked for in a step that is shorter than this share of the largest displacement over
// the largest velocity, as between two events: rounding of displacements changes the interpolated
// velocities by more than a peak could.
static const double INSTANT = 1e-8;

// Place of the largest force of a link, in the step: the force errs by the square.
static const double PLACED = 1e-4;

static bool dp_is_instant(const struct dp *p) {
    return p->h * p->scales.most_v < INSTANT * p->scales.most_u;
}

static void dp_raise(struct dp *p, enum peak q, int i, double value, double time) {
    if (fabs(value) > p->results->peak[q][i]) {
        p->results->peak[q][i] = fabs(value);
        p->results->peak_time[q][i] = time;
        p->grown |= q == PEAK_DISPLACEMENT || q == PEAK_VELOCITY;
    }
}

// A value of floor i. With a drift goes the shear of its storey, if that is all there is.
static void dp_note(struct dp *p, enum peak q, int i, double value, double time) {
    dp_raise(p, q, i, value, time);
    if (q == PEAK_DRIFT && p->model->building[p->system.building[i]].n_part == 0) {
        dp_raise(p, PEAK_SHEAR, i, dp_system_shear(p, i, value), time);
    }
}

// Could a quantity that has these rates at both ends and this value at the second go beyond the
// peak between them?
static bool dp_may_exceed(const struct dp *p, double peak, double rate0, double value,
                          double rate1) {
    return rate0 * rate1 < 0.0 && fabs(value) + p->h * fabs(rate1) > peak;
}

// The displacement, drift or shear of floor i where it turns.
static void dp_note_turns(struct dp *p, enum peak q, int i, const struct motion *m) {
    if (dp_may_exceed(p, p->results->peak[q][i], m->v[0], m->d[1], m->v[1])) {
        const struct motion_pieces s = dp_motion_cut(m);
        for (int j = 1; j < s.n; j++) {
            dp_note(p, q, i, s.d[j], p->now.time + s.x[j] * p->h);
        }
    }
}

// The velocity turns where the relative acceleration is zero.
static void dp_note_velocity(struct dp *p, int i, const struct motion *m) {
    if (dp_may_exceed(p, p->results->peak[PEAK_VELOCITY][i], m->a[0], m->v[1], m->a[1])) {
        const struct polynomial v = dp_motion_velocity(m), u = dp_motion_path(m);
        const struct polynomial slope = {{v.c[1], 2.0 * v.c[2], 3.0 * v.c[3]}};
        const double x = dp_motion_root(slope, 0.0, 1.0);
        dp_note(p, PEAK_VELOCITY, i, dp_motion_slope(&u, x) / p->h, p->now.time + x * p->h);
    }
}

static double dp_total(const struct dp_rates *r, const struct building *g, int i) {
    return r->a[i] + r->ground.a[g->ground];
}

// Where the interpolated total acceleration has its largest value inside; < 0: at an end, or far
// below the peak so far.
static double dp_acceleration_place(const struct dp *p, const struct building *g, int i) {
    struct motion m = dp_motion_floor(p, i, -1);
    struct polynomial u = dp_motion_path(&m);
    double square = p->h * p->h;
    double ground0 = p->now.ground_a[g->ground];
    double rise = p->next.ground_a[g->ground] - ground0;
    double bend = (ground0 + INNER * rise - p->stage[2]->ground.a[g->ground]) /
                  (INNER * (1.0 - INNER));  // the ground's parabola, of a sine
    struct polynomial a = {{2.0 * u.c[2] / square + ground0, 6.0 * u.c[3] / square + rise - bend,
                            12.0 * u.c[4] / square + bend, 20.0 * u.c[5] / square, 0.0, 0.0}};
    double ends =
        fmax(fabs(dp_total(p->stage[0], g, i)), fabs(dp_total(p->stage[DP_STAGES - 1], g, i)));
    double best = fmax(NEARLY * ends, p->results->peak[PEAK_ACCELERATION][i] / BEYOND);
    double place = -1.0;
    double x[2];
    int n = dp_motion_extrema(&a, x);
    for (int j = 0; j < n; j++) {
        double size = fabs(dp_motion_value(&a, x[j]));
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
    return dp_total(p->stage[1], &p->model->building[building], i);
}

// The acceleration at the top of the parabola through that at place x and those beside it, if the
// top is as near as they are, else at x; again from the top, if it is not.
static void dp_note_acceleration(struct dp *p, const struct building *g, int i) {
    double x = dp_acceleration_place(p, g, i);
    for (int n = 0; n < TRIES && x > 0.0 && x < 1.0; n++) {
        double beside = fmin(BESIDE, fmin(x, 1.0 - x));
        double low = dp_acceleration(p, x - beside, i);
        double high = dp_acceleration(p, x + beside, i);
        double middle = dp_acceleration(p, x, i);
        double bend = low - 2.0 * middle + high;
        double slope = (high - low) / 2.0;
        double shift = fabs(bend) > fabs(slope) ? -slope / bend : 0.0;
        dp_note(p, PEAK_ACCELERATION, i, middle + shift * slope / 2.0,
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
    double most = number_max(fabs(dp_total(p->stage[2], g, i)), fabs(dp_total(p->stage[3], g, i)));
    return BEYOND * most > p->results->peak[PEAK_ACCELERATION][i];
}

static void dp_floor_within(struct dp *p, const struct dp_candidates *c, int i) {
    const struct motion own = dp_motion_floor(p, i, -1);
    const struct motion drift = dp_motion_floor(p, i, p->system.below[i]);
    dp_note_turns(p, PEAK_DISPLACEMENT, i, &own);
    dp_note_velocity(p, i, &own);
    dp_note_turns(p, PEAK_DRIFT, i, &drift);
    if (dp_may_bend(p, c, i)) {
        dp_note_acceleration(p, &p->model->building[p->system.building[i]], i);
    }
}

// Values at one instant. The shear of an elastic storey is largest with its drift.
static void dp_floor_at(struct dp *p, const struct state *s, int i) {
    const struct building *g = &p->model->building[p->system.building[i]];
    dp_note(p, PEAK_DISPLACEMENT, i, s->u[i], s->time);
    dp_note(p, PEAK_VELOCITY, i, s->v[i], s->time);
    dp_note(p, PEAK_ACCELERATION, i, s->a[i] + s->ground_a[g->ground], s->time);
    if (!g->elastic || fabs(s->drift[i]) > p->results->peak[PEAK_DRIFT][i]) {
        dp_note(p, PEAK_DRIFT, i, s->drift[i], s->time);
    }
}

// The sum of row i of the stiffness on drifts of building `g`, with x displacements: the shear of
// the storey below floor i where all is linear, or its rate where x are velocities.
static double dp_linear_shear(const struct dp *p, const struct building *g, const double *x,
                              int i) {
    const int n = g->n_dof, row = i - g->first;
    double sum = 0.0;
    for (int j = 0; j < n; j++) {
        const double drift = x[g->first + j] - x[p->system.below[g->first + j]];
        sum += (g->part_stiffness[row * n + j] + (j == row ? g->spring[row] : 0.0)) * drift;
    }
    return sum;
}

// The storey shears of a building with parts: within the step where all is linear, and at its end.
static void dp_part_shears(struct dp *p, const struct building *g) {
    const struct state *now = &p->now, *next = &p->next;
    if (!g->elastic) {
        dp_rates_parts(p, g, dp_is_instant(p) ? now->storey_history : p->system.part_history,
                       next->u, next->v, next->storey_history);
    }
    for (int i = g->first; i < g->first + g->n_dof; i++) {
        if (!g->elastic) {
            const double storey = dp_system_shear(p, i, next->drift[i]);
            dp_note(p, PEAK_SHEAR, i, storey + p->system.part_shear[i], next->time);
            continue;
        }
        const struct motion m = {
            .d = {dp_linear_shear(p, g, now->u, i), dp_linear_shear(p, g, next->u, i)},
            .v = {dp_linear_shear(p, g, now->v, i), dp_linear_shear(p, g, next->v, i)},
            .a = {dp_linear_shear(p, g, now->a, i), dp_linear_shear(p, g, next->a, i)},
            .h = p->h,
        };
        dp_note_turns(p, PEAK_SHEAR, i, &m);
        dp_note(p, PEAK_SHEAR, i, m.d[1], next->time);
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
static void dp_floors_step(struct dp *p) {
    const struct model *m = p->model;
    bool always = m->n_ground != 1 || !m->elastic;
    struct dp_candidates c;
    for (c.first = 0; c.first < m->n_dof; c.first += DP_CANDIDATES) {
        c.n = m->n_dof - c.first < DP_CANDIDATES ? m->n_dof - c.first : DP_CANDIDATES;
        bool found = p->floors->candidates(p, &c);
        for (int i = 0; (found || always) && i < c.n; i++) {
            if ((always || c.hit[i] < 0) && !dp_is_instant(p)) {
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
    dp_forces_step(p, !dp_is_instant(p));
    dp_rescale(p);
}

// Largest penetration of link k in the step: at its end, or where it turns.
static double dp_penetration(struct dp *p, int k, const struct motion *m) {
    double largest = peaks_size(p->model, k, m->d[1]);
    peaks_penetration(p->results, k, largest, p->next.time);
    if (m->v[0] * m->v[1] < 0.0) {
        const struct motion_pieces s = dp_motion_cut(m);
        for (int j = 1; j < s.n; j++) {
            const double d = peaks_size(p->model, k, s.d[j]);
            largest = fmax(largest, d);
            peaks_penetration(p->results, k, d, p->now.time + s.x[j] * p->h);
        }
    }
    return largest;
}

static double dp_motion_bend(const struct polynomial *p, double x) {
    const double *c = p->c;
    return 2.0 * c[2] + x * (6.0 * c[3] + x * (12.0 * c[4] + x * 20.0 * c[5]));
}

// The force of link number i of the live ones at place x of its path in the step, and its rate.
static double dp_link_force(const struct dp *p, int i, const struct polynomial *path, double x,
                            double *rate) {
    const int k = p->now.live[i];
    const double d = dp_motion_value(path, x), v = dp_motion_slope(path, x) / p->h;
    const double a = dp_motion_bend(path, x) / (p->h * p->h);
    if (!p->model->link[k].law->creep) {
        const struct contact_response r = dp_system_response(p, k, d, v);
        *rate = r.dfdd * v + r.dfdv * a;
        return r.force;
    }
    struct dp_link_rates r = {.creep = dp_rates_creep(p, i, x)};
    dp_rates_creeping(p, i, d, v, &r);
    *rate = r.response.dfdd * (v - r.flow) + r.response.dfdv * a;
    return r.response.force;
}

// The force of link number i of the live ones where its rate changes its sign inside the step, and
// when; the one at the end where it does not.
static double dp_inner_force(const struct dp *p, int i, const struct motion *m, double *time) {
    const struct dp_link_rates *first = &p->stage[0]->link[i];
    const struct dp_link_rates *last = &p->stage[DP_STAGES - 1]->link[i];
    const double start =
        first->response.dfdd * (m->v[0] - first->flow) + first->response.dfdv * m->a[0];
    double rate = last->response.dfdd * (m->v[1] - last->flow) + last->response.dfdv * m->a[1];
    double force = last->response.force;
    *time = p->next.time;
    if (start * rate >= 0.0 || dp_is_instant(p)) {
        return force;
    }
    const struct polynomial path = dp_motion_path(m);
    struct root at = {.high = 1.0};
    while (at.high - at.low > PLACED) {
        const double x = root_middle(&at);
        force = dp_link_force(p, i, &path, x, &rate);
        *time = p->now.time + x * m->h;
        root_halve(&at, start * rate > 0.0);
    }
    return force;
}

void dp_peaks_link(struct dp *p, int i, struct impact_share *share) {
    const int k = p->now.live[i];
    const struct motion m = dp_motion_link(p, k);
    double time;
    const double inner = dp_inner_force(p, i, &m, &time);
    const double end = p->stage[DP_STAGES - 1]->link[i].response.force;
    peaks_force(p->results, k, peaks_size(p->model, k, end), p->next.time);
    peaks_force(p->results, k, peaks_size(p->model, k, inner), time);
    share->force = number_max(end, inner);
    share->penetration = dp_penetration(p, k, &m);
}

void dp_peaks_step(struct dp *p) {
    dp_floors_step(p);
    for (int k = 0, n = p->deepens ? p->model->n_contact : 0; k < n; k++) {
        if (p->reach[k] > p->results->deepest[k] && !p->now.link[k].closed) {
            const struct motion m = dp_motion_link(p, k);
            dp_penetration(p, k, &m);
        }
    }
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
        struct impact_share share = {.force = p->stage[0]->link[i].response.force};
        peaks_force(p->results, k, peaks_size(p->model, k, share.force), p->now.time);
        impacts_add(p->impacts, k, &share);
    }
}
