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
// where t (x - x_seen) does not matter either it is passed over. With F = k d^n a step changes d by
// the share b S df / d = s df / (n f), with s = S t, and so F by (n - 1) / (2 n) s^2 df^2 / f more
// than linearly. A dashpot that grows with d^(1/4) has at most 3/2 of s^2 df^2 / f; 4 are taken.
//
// What is left to a settled link are the changes of others after its own. They change its force by
//     |df_l| <= t / (1 + s) sum over m of |S_lm df_m| <= s sum of |S_lm| / S_ll max |df_m|,
// so that another sweep would change forces by such a share of what this one did. Where that does
// not matter no such sweep is made.
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

static double sum_of_sizes(const double *x, int n) {
    double sum = 0.0;
    for (int i = 0; i < n; i++) {
        sum += fabs(x[i]);
    }
    return sum;
}

// How the ends yield.
static void find_columns(const struct work *w, struct quick *p) {
    const struct link *l = p->link;
    p->factors = w->factors;
    p->flexibility = 0.0;
    p->fits_to = 0.0;
    double sum = 0.0;
    for (int i = 0; i < 2; i++) {
        if (l->dof[i] != WALL) {
            struct effective *a = &w->effective[l->building[i]];
            int floor = l->floor[i] - 1;
            const double *column = effective_column(a, floor);
            const struct reach *reach = &a->reach[floor];
            p->flexibility += column[floor];
            sum += sum_of_sizes(column, a->building->n_floor);
            p->column[i] = column + reach->from;
            p->first[i] = l->dof[i] - floor + reach->from;
            p->lanes[i] = reach->to - reach->from;
        }
    }
    p->others = w->crowd * sum / p->flexibility - 1.0;
}

// Where d and v are without corrections, and how the ends yield, unless that has stayed.
static inline void gather(struct work *w, const struct state *next, struct quick *p) {
    const struct link *l = p->link;
    int left = p->end[0];
    int right = p->end[1];
    p->history = next->link_history + l->history;
    p->force = next->force[p->index];
    p->trusted = p->branch == BRANCH_CLOSED && l->law->force && !p->clamped;
    p->open = false;
    p->room = -1.0;
    p->d_trial = w->u_trial[left] - w->u_trial[right] - l->gap;
    p->v_trial = w->v_trial[left] - w->v_trial[right];
    if (l->moving_ground) {
        p->d_trial += state_ground_gap(l, w->model, next->ground_u);
        p->v_trial += state_ground_gap(l, w->model, next->ground_v);
    }
    if (p->factors != w->factors) {
        find_columns(w, p);
    }
}

void quick_gather(struct work *w, const struct state *next) {
    w->n_acting = next->n_live;
    for (int i = 0; i < next->n_live; i++) {
        w->acting[i] = &w->quick[next->live[i]];
        gather(w, next, w->acting[i]);
    }
}

void quick_tighten(struct work *w, struct progress *s) {
    bool looser = s->loosest > LOOSER * s->enough;
    for (int i = 0; looser && i < w->n_acting; i++) {
        w->acting[i]->room = -1.0;
    }
    s->loosest = looser ? s->enough : number_max(s->loosest, s->enough);
}

// q += f column; beyond the floors of the building the column is 0.
static inline void push(double *restrict q, const double *restrict column, int n, double f) {
    for (int i = 0; i != n; i += LANES_WIDTH) {
        lanes low = *(const lanes *)(q + i) + f * *(const lanes *)(column + i);
        lanes high = *(const lanes *)(q + i + LANES_VECTOR) +
                     f * *(const lanes *)(column + i + LANES_VECTOR);
        *(lanes *)(q + i) = low;
        *(lanes *)(q + i + LANES_VECTOR) = high;
    }
}

// Is a change of the force no more than the rounding of d and v makes of it?
static inline bool negligible(const struct work *w, const struct quick *p, double df) {
    double d = fabs(w->u_trial[p->end[0]]) + fabs(w->u_trial[p->end[1]]) + p->link->gap;
    double v = fabs(w->v_trial[p->end[0]]) + fabs(w->v_trial[p->end[1]]);
    double change = 4.0 * DBL_EPSILON * (fabs(p->law.dfdd) * d + fabs(p->law.dfdv) * v);
    return fabs(df) <= change * p->damped;
}

// Is the error of the second order small that a force f has which follows the slope of its law by
// `change`?
static inline bool straight(double change, double f, double enough) {
    return 40.0 * change * change <= enough * fabs(f);
}

static inline void push_ends(const struct work *w, const struct quick *p, double df) {
    push(w->correction + p->first[0], p->column[0], p->lanes[0], -df);
    push(w->correction + p->first[1], p->column[1], p->lanes[1], df);
}

void quick_push(const struct work *w, const struct quick *p, double df) {
    push_ends(w, p, df);
}

// Changes the force of a link that sees x by df.
static inline void move(const struct work *w, struct quick *p, double x, double df) {
    p->force += df;
    p->seen = x - p->flexibility * df;
    push_ends(w, p, df);
}

// Takes note of the change df.
static inline void note(const struct work *w, const struct quick *p, double df,
                        struct progress *s) {
    double *most = p->room >= 0.0 ? &s->moved : &s->change;
    if (fabs(df) > *most && fabs(df) > s->enough && !negligible(w, p, df)) {
        *most = fabs(df);
    }
}

// A Newton step of a link that sees x, from the law there; false: not safe.
static inline bool step(const struct work *w, struct quick *p, double x, struct progress *s) {
    const struct link *l = p->link;
    double d = p->d_trial + w->b * x;
    double v = p->v_trial + w->g * x;
    if (!p->trusted || !(d > 0.0 || l->bilateral)) {
        return false;
    }
    p->law = l->law->force(l->constant, p->history, d, v);
    p->slope = w->b * p->law.dfdd + w->g * p->law.dfdv;
    double share = p->flexibility * p->slope;
    p->damped = 1.0 / (1.0 + share);
    double df = (p->law.force - p->force) * p->damped;
    double moved = p->flexibility * fabs(df);
    double room = l->bilateral ? INFINITY : NEAR * d * w->per_b;
    bool safe = share >= 0.0 && share <= STEEPEST && moved <= room;
    if (!safe || fabs(df) > NEAR * fabs(p->force)) {
        return false;
    }
    room = p->smooth ? number_min(room, fabs(v) * w->per_g) - moved : -1.0;
    move(w, p, x, df);
    p->room = straight(share * df, p->force, s->enough) ? room : -1.0;
    s->echo = number_max(s->echo, share * p->others);
    note(w, p, df, s);
    return true;
}

// The same from what is known of the law, where that is enough; else false.
static inline bool follow(const struct work *w, struct quick *p, double x, struct progress *s) {
    double dx = x - p->seen;
    double change = p->slope * dx;
    if (!(fabs(dx) <= p->room && straight(change, p->force, s->enough))) {
        return false;
    }
    double df = change * p->damped;
    p->room -= fabs(dx);
    move(w, p, x, df);
    note(w, p, df, s);
    return true;
}

// Does the force of a link that sees x need no change?
static inline bool rests(const struct work *w, const struct quick *p, double x,
                         struct progress *s) {
    double dx = x - p->seen;
    if (fabs(dx) <= p->room && fabs(p->slope * dx) <= 0.1 * s->enough) {
        return true;
    }
    double d = p->d_trial + w->b * x;
    bool open = p->open && d <= 0.0;
    if (open) {
        s->clear = number_min(s->clear, -d / (w->b * p->flexibility * p->others));
    }
    return open;
}

LANES int quick_sweep(struct work *w, int first, struct progress *s) {
    for (int i = first, n = w->n_acting; i < n; i++) {
        struct quick *p = w->acting[i];
        double x = w->correction[p->end[0]] - w->correction[p->end[1]];
        if (!rests(w, p, x, s) && !follow(w, p, x, s) && !step(w, p, x, s)) {
            return i;
        }
        s->largest = number_max(s->largest, fabs(p->force));
    }
    return w->n_acting;
}
