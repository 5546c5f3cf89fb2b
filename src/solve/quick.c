// SPDX-License-Identifier: GPL-3.0-or-later
// With the corrections q of the accelerations, a link sees x = q_left - q_right, and
//     d = d_trial + beta h^2 x,   v = v_trial + gamma h x,   F = F(d, v).
// Its own force f moves it by S_ll per unit against itself, so Newton's method for F = f takes
//     df = (F - f) / (1 + S_ll t),   t = beta h^2 dF/dd + gamma h dF/dv,
// and q changes by df times the columns of A^-1 of both ends. A^-1 is almost diagonal, for
// beta h^2 K << M: links disturb each other where they share a floor, and little else.
//
// A link of a smooth law whose own step was so small that the error, of second order in df, does
// not matter, is settled: its F is known from F(x) = F(x_seen) + t (x - x_seen) from then on, and
// where t (x - x_seen) does not matter either it is passed over. A sweep in which all are passed
// over is the proof that all forces obey their laws. With F = k d^n a step changes d by the share
// b S df / d = s df / (n f), with s = S t, and so F by (n - 1) / (2 n) s^2 df^2 / f more than
// linearly. A dashpot that grows with d^(1/4) has at most 3/2 of s^2 df^2 / f; 4 are taken.
#include "solve/quick.h"

#include <float.h>
#include <math.h>

#include "core/lanes.h"
#include "core/number.h"

// A Newton step is trusted if it changes force and penetration by no more than this share, and if
// the law is no steeper than this against the flexibility of the link.
static const double NEAR = 0.1;
static const double STEEPEST = 0.1;

// What was settled while forces were larger by this factor still is.
static const double LOOSER = 4.0;

void quick_init(struct quick *p, const struct model *m, int k) {
    const struct link *l = &m->link[k];
    *p = (struct quick){.link = l, .index = k, .smooth = l->law->traits & CONTACT_SMOOTH};
    for (int i = 0; i < 2; i++) {
        p->end[i] = l->dof[i] == WALL ? m->n_dof : l->dof[i];
    }
}

// How the ends yield.
static void find_columns(const struct work *w, struct quick *p) {
    const struct link *l = p->link;
    p->factors = w->factors;
    p->flexibility = 0.0;
    for (int i = 0; i < 2; i++) {
        if (l->dof[i] != WALL) {
            struct effective *a = &w->effective[l->building[i]];
            int floor = l->floor[i] - 1;
            const double *column = effective_column(a, floor);
            const struct reach *reach = &a->reach[floor];
            p->flexibility += column[floor];
            p->column[i] = column + reach->from;
            p->first[i] = l->dof[i] - floor + reach->from;
            p->lanes[i] = reach->to - reach->from;
        }
    }
}

// Where d and v are without corrections, and how the ends yield, unless that has stayed.
static inline void gather(struct work *w, const struct state *next, struct quick *p) {
    const struct link *l = p->link;
    int left = p->end[0];
    int right = p->end[1];
    p->history = next->link_history + l->history;
    p->trusted = w->branch[p->index] == BRANCH_CLOSED && l->law->force && !w->clamped[p->index];
    p->settled = p->open = false;
    p->d_trial = w->u_trial[left] - w->u_trial[right] - l->gap;
    p->v_trial = w->v_trial[left] - w->v_trial[right];
    if (l->moving_ground) {
        p->d_trial += state_ground_gap(l, w->model, next->ground_u);
        p->v_trial += state_ground_gap(l, w->model, next->ground_v);
    }
    if (p->factors != w->factors) {
        find_columns(w, p);
    }
    w->flexibility[p->index] = p->flexibility;
}

void quick_gather(struct work *w, const struct state *next) {
    for (int i = 0; i < next->n_live; i++) {
        gather(w, next, &w->quick[next->live[i]]);
    }
}

// q += f column; beyond the floors of the building the column is 0.
static inline void push(double *restrict q, const double *restrict column, int n, double f) {
    for (int i = 0; i < n; i += LANES_WIDTH) {
        lanes low = *(const lanes *)(q + i) + f * *(const lanes *)(column + i);
        lanes high = *(const lanes *)(q + i + LANES_VECTOR) +
                     f * *(const lanes *)(column + i + LANES_VECTOR);
        *(lanes *)(q + i) = low;
        *(lanes *)(q + i + LANES_VECTOR) = high;
    }
}

// Is a change of the force no more than the rounding of d and v makes of it?
static bool negligible(const struct work *w, const struct quick *p, double df) {
    double d = state_rounding(p->link, w->u_trial) + 4.0 * DBL_EPSILON * p->link->gap;
    double v = state_rounding(p->link, w->v_trial);
    double change = fabs(p->law.dfdd) * d + fabs(p->law.dfdv) * v;
    return fabs(df) * (1.0 + p->flexibility * p->slope) <= change;
}

// The force of the law at x; false: a Newton step is not safe from there.
static inline bool evaluate(const struct work *w, struct quick *p, double x) {
    const struct link *l = p->link;
    double d = p->d_trial + w->b * x;
    double v = p->v_trial + w->g * x;
    if (!p->trusted || !(d > 0.0 || l->bilateral)) {
        return false;
    }
    p->law = l->law->force(l->constant, p->history, d, v);
    p->slope = w->b * p->law.dfdd + w->g * p->law.dfdv;
    p->room = l->bilateral ? INFINITY : NEAR * d;
    p->room_v = p->smooth ? fabs(v) : 0.0;
    double slope = p->flexibility * p->slope;
    return slope >= 0.0 && slope <= STEEPEST;
}

// Is the error of the second order small that a force f has which follows the slope of its law by
// `change`?
static inline bool straight(double change, double f, double enough) {
    return 4.0 * change * change <= 0.1 * enough * fabs(f);
}

// Moves the ends of the link by what df does to them.
static inline void move(const struct work *w, struct quick *p, double x, double df) {
    p->seen = x - p->flexibility * df;
    push(w->correction + p->first[0], p->column[0], p->lanes[0], -df);
    push(w->correction + p->first[1], p->column[1], p->lanes[1], df);
}

// A Newton step on the force f of a link that sees x; false: not safe.
static inline bool step(const struct work *w, struct quick *p, double x, double *f,
                        struct progress *s) {
    double dx = x - p->seen;
    double pending = p->slope * dx;
    bool known = p->settled && p->within <= LOOSER * s->enough && w->b * fabs(dx) <= p->room &&
                 w->g * fabs(dx) < p->room_v && straight(pending, *f, s->enough);
    if (known && fabs(pending) <= 0.1 * s->enough) {
        return true;
    }
    if (!known) {
        if (!evaluate(w, p, x)) {
            return false;
        }
        pending = p->law.force - *f;
        p->within = s->enough;
    }
    double slope = p->flexibility * p->slope;
    double df = pending / (1.0 + slope);
    double moved = p->flexibility * fabs(df);
    if (w->b * moved > p->room || fabs(df) > NEAR * fabs(*f)) {
        return false;
    }
    *f += df;
    p->settled = w->g * moved < p->room_v && straight(slope * df, *f, s->enough);
    move(w, p, x, df);
    p->room_v = p->smooth ? fabs(p->v_trial + w->g * p->seen) : 0.0;
    if (fabs(df) > s->change && fabs(df) > s->enough && !negligible(w, p, df)) {
        s->change = fabs(df);
    }
    return true;
}

LANES int quick_sweep(struct work *w, struct state *next, int first, struct progress *s) {
    for (int i = first; i < next->n_live; i++) {
        struct quick *p = &w->quick[next->live[i]];
        double *f = &next->force[p->index];
        double x = w->correction[p->end[0]] - w->correction[p->end[1]];
        bool apart = p->open && p->d_trial + w->b * x <= 0.0;
        if (!apart && !step(w, p, x, f, s)) {
            return i;
        }
        s->largest = number_max(s->largest, fabs(*f));
    }
    return next->n_live;
}
