// SPDX-License-Identifier: GPL-3.0-or-later
// Largest values within a step. A quantity has an extremum inside where its rate changes sign;
// displacements, velocities and drifts have it on their interpolation. Of an acceleration, the
// interpolation gives the place only: the right-hand side is evaluated there and beside it, and a
// parabola put through the three. Most steps are far from any peak, and cost a few comparisons.
#include "solve/dormand_prince/dp_peaks.h"

#include <math.h>

#include "core/number.h"
#include "solve/account/peaks.h"
#include "solve/dormand_prince/dp_motion.h"
#include "solve/dormand_prince/dp_stages.h"

// Distance in the step of the three values; how far the interpolation of an acceleration may be too
// low, and how far so beside the ends, where the step ends at no peak.
static const double BESIDE = 0.02, BEYOND = 1.1, NEARLY = 0.999;

// Place of the third stage.
static const double INNER = 0.3;

enum { ITERATIONS_MAX = 40, TRIES = 3 };

// Of the largest displacement over the largest velocity: in a shorter step, as between two events,
// rounding of displacements makes more of the interpolated velocities than any peak inside could.
static const double INSTANT = 1e-8;
static const double PLACED = 1e-4;  // of the step, of an extremum of a force; its error is a square

static bool is_instant(const struct dp *p) {
    return p->h * p->scales.most_v < INSTANT * p->scales.most_u;
}

static void note(struct dp *p, enum peak q, int i, double value, double time) {
    double size = fabs(value);
    if (size > p->results->peak[q][i]) {
        p->results->peak[q][i] = size;
        p->results->peak_time[q][i] = time;
        p->grown |= q == PEAK_DISPLACEMENT || q == PEAK_VELOCITY;
    }
}

// A new largest drift of a storey, and its shear.
static void note_drift(struct dp *p, int i, double drift, double time) {
    note(p, PEAK_DRIFT, i, drift, time);
    note(p, PEAK_SHEAR, i, dp_system_shear(&p->system, &p->now, i, drift), time);
}

// Could a quantity with this value and rate at the end, which turns in the step, go beyond the
// peak?
static bool may_exceed(double peak, double value, double rate, double h) {
    return fabs(value) + h * fabs(rate) > peak;
}

static void inner_displacement(struct dp *p, int i) {
    struct motion m = dp_motion_floor(p, i);
    struct polynomial u = hermite_position(&m);
    double x[TURNS_MAX];
    int n = hermite_turns(&m, x);
    for (int j = 0; j < n; j++) {
        note(p, PEAK_DISPLACEMENT, i, hermite_value(&u, x[j]), p->now.time + x[j] * p->h);
    }
}

static void inner_drift(struct dp *p, int i) {
    struct motion m = dp_motion_storey(p, i);
    struct polynomial drift = hermite_position(&m);
    double x[TURNS_MAX];
    int n = hermite_turns(&m, x);
    for (int j = 0; j < n; j++) {
        double d = hermite_value(&drift, x[j]);
        note_drift(p, i, d, p->now.time + x[j] * p->h);
    }
}

// The velocity turns where the relative acceleration is zero.
static void inner_velocity(struct dp *p, int i) {
    struct motion m = dp_motion_floor(p, i);
    struct polynomial v = hermite_velocity(&m);
    struct polynomial u = hermite_position(&m);
    double a0 = v.c[1];
    struct polynomial slope = {{a0, 2.0 * v.c[2], 3.0 * v.c[3]}};
    double x = hermite_root(&slope, 0.0, 1.0);
    note(p, PEAK_VELOCITY, i, hermite_slope(&u, x) / p->h, p->now.time + x * p->h);
}

static double total(const struct dp_rates *r, const struct building *g, int i) {
    return r->a[i] + r->ground.a[g->ground];
}

// Where the interpolated total acceleration has its largest value inside; < 0: at an end, or far
// below the peak so far.
static double acceleration_place(const struct dp *p, const struct building *g, int i) {
    struct motion m = dp_motion_floor(p, i);
    struct polynomial u = hermite_position(&m);
    double square = p->h * p->h;
    double ground0 = p->now.ground_a[g->ground];
    double rise = p->next.ground_a[g->ground] - ground0;
    double bend = (ground0 + INNER * rise - p->stage[2]->ground.a[g->ground]) /
                  (INNER * (1.0 - INNER));  // the ground's parabola, of a sine
    struct polynomial a = {{2.0 * u.c[2] / square + ground0, 6.0 * u.c[3] / square + rise - bend,
                            12.0 * u.c[4] / square + bend, 20.0 * u.c[5] / square, 0.0, 0.0}};
    double ends = fmax(fabs(total(p->stage[0], g, i)), fabs(total(p->stage[DP_STAGES - 1], g, i)));
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

// Notes the acceleration at place x, or at the top of the parabola about it if that is as near as
// the values it is put through. Returns where the top is.
static double note_acceleration(struct dp *p, double x, int i) {
    double beside = fmin(BESIDE, fmin(x, 1.0 - x));
    double low = dp_motion_acceleration(p, x - beside, i);
    double high = dp_motion_acceleration(p, x + beside, i);
    double middle = dp_motion_acceleration(p, x, i);
    double bend = low - 2.0 * middle + high;
    double slope = (high - low) / 2.0;
    double shift = fabs(bend) > fabs(slope) ? -slope / bend : 0.0;
    note(p, PEAK_ACCELERATION, i, middle + shift * slope / 2.0,
         p->now.time + (x + shift * beside) * p->h);
    return bend * middle < 0.0 ? x - slope / bend * beside : x;
}

static void inner_acceleration(struct dp *p, const struct building *g, int i) {
    double x = acceleration_place(p, g, i);
    for (int n = 0; n < TRIES && x > 0.0 && x < 1.0; n++) {
        double top = note_acceleration(p, x, i);
        if (fabs(top - x) < BESIDE) {
            return;
        }
        x = top;
    }
}

static void inner_step(struct dp *p, int i) {
    const struct state *now = &p->now;
    const struct state *next = &p->next;
    const struct building *g = &p->model->building[p->system.building[i]];
    double *const *peak = p->results->peak;
    double h = p->h;
    double v0 = now->v[i];
    double v1 = next->v[i];
    double below0 = i > g->first ? now->v[i - 1] : 0.0;
    double below1 = i > g->first ? next->v[i - 1] : 0.0;
    if (v0 * v1 < 0.0 && may_exceed(peak[PEAK_DISPLACEMENT][i], next->u[i], v1, h)) {
        inner_displacement(p, i);
    }
    if (now->a[i] * next->a[i] < 0.0 && may_exceed(peak[PEAK_VELOCITY][i], v1, next->a[i], h)) {
        inner_velocity(p, i);
    }
    if ((v0 - below0) * (v1 - below1) < 0.0 &&
        may_exceed(peak[PEAK_DRIFT][i], next->drift[i], v1 - below1, h)) {
        inner_drift(p, i);
    }
}

// Values at one instant. The shear of an elastic storey is largest with its drift.
static void floor_at(struct dp *p, const struct state *s, int i) {
    const struct building *g = &p->model->building[p->system.building[i]];
    note(p, PEAK_DISPLACEMENT, i, s->u[i], s->time);
    note(p, PEAK_VELOCITY, i, s->v[i], s->time);
    note(p, PEAK_ACCELERATION, i, s->a[i] + s->ground_a[g->ground], s->time);
    if (!g->elastic || fabs(s->drift[i]) > p->results->peak[PEAK_DRIFT][i]) {
        note_drift(p, i, s->drift[i], s->time);
    }
}

// Makes the scales of errors again, if motions have grown.
static void rescale(struct dp *p) {
    if (p->grown) {
        p->grown = false;
        scale_update(&p->scales, p->model, p->results);
    }
}

// Could the acceleration of a floor have a peak within the step, by those at the stages?
static bool may_bend(const struct dp *p, const struct dp_look *l, int i) {
    if (p->model->n_ground == 1) {
        return l->bends[i - l->first] < 0;
    }
    const struct building *g = &p->model->building[p->system.building[i]];
    double most = number_max(fabs(total(p->stage[2], g, i)), fabs(total(p->stage[3], g, i)));
    return BEYOND * most > p->results->peak[PEAK_ACCELERATION][i];
}

static void floor_step(struct dp *p, const struct dp_look *l, int i) {
    bool instant = is_instant(p);
    if (!instant) {
        inner_step(p, i);
    }
    if (!instant && may_bend(p, l, i)) {
        inner_acceleration(p, &p->model->building[p->system.building[i]], i);
    }
    floor_at(p, &p->next, i);
}

// Where there are several grounds, or storeys with a history, no bound is known.
static void floors_step(struct dp *p) {
    const struct model *m = p->model;
    bool always = m->n_ground != 1 || m->n_storey_history > 0;
    struct dp_look l;
    for (l.first = 0; l.first < m->n_dof; l.first += DP_LOOK) {
        l.n = m->n_dof - l.first < DP_LOOK ? m->n_dof - l.first : DP_LOOK;
        bool found = p->floors->look(p, &l);
        for (int i = 0; (found || always) && i < l.n; i++) {
            if (always || l.hit[i] < 0) {
                floor_step(p, &l, l.first + i);
            }
        }
    }
    rescale(p);
}

// Largest penetration in the step: at its end, or where it turns.
static double link_penetration(struct dp *p, int k, const struct motion *m) {
    double largest = peaks_size(p->model, k, m->d[1]);
    peaks_penetration(p->results, k, largest, p->next.time);
    if (m->v[0] * m->v[1] < 0.0) {
        struct polynomial path = hermite_position(m);
        double x[TURNS_MAX];
        int n = hermite_turns(m, x);
        for (int j = 0; j < n; j++) {
            double d = peaks_size(p->model, k, hermite_value(&path, x[j]));
            largest = fmax(largest, d);
            peaks_penetration(p->results, k, d, p->now.time + x[j] * p->h);
        }
    }
    return largest;
}

static void open_step(struct dp *p, int k) {
    double most = p->results->link[k].penetration;
    double d = fmax(p->now.delta[k], p->next.delta[k]);
    bool turns = p->rate[0][k] > 0.0 && p->rate[1][k] < 0.0;
    if (d > most || (turns && d + p->h * p->rate[0][k] > most)) {
        struct motion m = dp_motion_link(p, k);
        link_penetration(p, k, &m);
    }
}

// The force of link k and its rate at place x of its motion.
static double force_at(const struct dp *p, int k, const struct polynomial *path, double x,
                       double *rate) {
    const double *c = path->c;
    double h = p->h;
    double d = hermite_value(path, x);
    double v = hermite_slope(path, x) / h;
    double a = (2.0 * c[2] + x * (6.0 * c[3] + x * (12.0 * c[4] + x * 20.0 * c[5]))) / (h * h);
    struct contact_response r = dp_system_response(&p->system, &p->now, k, d, v);
    *rate = r.dfdd * v + r.dfdv * a;
    return r.force;
}

// The force of link k, number i of the active ones, where its rate changes its sign inside the
// step, and when; the one at the end where it does not.
static double inner_force(const struct dp *p, int i, const struct motion *m, double *time) {
    const struct dp_rates *first = p->stage[0];
    const struct dp_rates *last = p->stage[DP_STAGES - 1];
    double start = first->dfdd[i] * m->v[0] + first->dfdv[i] * m->a[0];
    double rate = last->dfdd[i] * m->v[1] + last->dfdv[i] * m->a[1];
    double force = last->force[i];
    *time = p->next.time;
    if (start * rate >= 0.0 || is_instant(p)) {
        return force;
    }
    struct polynomial path = hermite_position(m);
    double low = 0.0;
    double high = 1.0;
    for (int n = 0; n < ITERATIONS_MAX && high - low > PLACED; n++) {
        double x = 0.5 * (low + high);
        force = force_at(p, p->now.live[i], &path, x, &rate);
        *time = p->now.time + x * p->h;
        *(start * rate > 0.0 ? &low : &high) = x;
    }
    return force;
}

void dp_peaks_link(struct dp *p, int i, struct impact_share *share) {
    int k = p->now.live[i];
    struct motion m = dp_motion_link(p, k);
    double time;
    double force = inner_force(p, i, &m, &time);
    share->penetration = link_penetration(p, k, &m);
    share->force = p->stage[DP_STAGES - 1]->force[i];
    peaks_force(p->results, k, peaks_size(p->model, k, share->force), p->next.time);
    peaks_force(p->results, k, peaks_size(p->model, k, force), time);
    share->force = number_max(share->force, force);
}

void dp_peaks_step(struct dp *p) {
    floors_step(p);
    for (int k = 0, n = p->deepens ? p->model->n_contact : 0; k < n; k++) {
        if (p->reach[k] > p->results->deepest[k] && !p->now.link[k].closed) {
            open_step(p, k);
        }
    }
}

void dp_peaks_jump(struct dp *p) {
    if (!p->jumped) {
        return;
    }
    p->jumped = false;
    for (int i = 0; i < p->model->n_dof; i++) {
        floor_at(p, &p->now, i);
    }
    rescale(p);
    for (int i = 0; i < p->now.n_live; i++) {
        int k = p->now.live[i];
        struct impact_share share = {.force = p->stage[0]->force[i]};
        peaks_force(p->results, k, peaks_size(p->model, k, share.force), p->now.time);
        impacts_add(p->impacts, k, &share);
    }
}
