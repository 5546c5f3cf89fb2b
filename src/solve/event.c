// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/event.h"

#include <math.h>

#include "solve/crossing.h"

// An event this close to an end of the step, relative to it, is at that end.
static const double AT_END = 1e-9;

static double snap(double time, double h) {
    return time <= AT_END * h ? 0.0 : time >= (1.0 - AT_END) * h ? h : time;
}

static bool jumped(const struct link *l, const struct state *now, const struct state *next, int k) {
    return (l->law->traits & CONTACT_JUMPS) && now->closed[k] != next->closed[k] &&
           (now->force[k] != 0.0 || next->force[k] != 0.0);
}

// Time from the start of the step at which the force of link k jumps.
static double jump_time(const struct state *now, const struct state *next, double h, int k) {
    if (next->closed[k]) {
        return next->t_close[k] - now->time;
    }
    struct path path = {fmax(now->delta[k], 0.0), now->rate[k], fmin(next->delta[k], 0.0),
                        next->rate[k], h};
    double rate;
    return crossing_find(&path, &rate);
}

// Time from the start of the step at which the bodies of rigid contact k meet; infinite if they do
// not, but for rounding.
static double meeting_time(const struct link *l, const struct state *now, const struct state *next,
                           double h, int k) {
    struct path path = {fmin(now->delta[k], 0.0), now->rate[k], next->delta[k], next->rate[k], h};
    double rate;
    if (path.d1 > fmax(now->delta[k], 0.0) + state_rounding(l, next->u)) {
        return crossing_find(&path, &rate);
    }
    if (path.d0 < 0.0 && path.v0 > 0.0 && path.v1 < 0.0) {
        struct path rising = path;
        rising.h = crossing_summit(&path, &rising.d1);
        rising.v1 = 0.0;
        return rising.d1 > 0.0 ? crossing_find(&rising, &rate) : INFINITY;
    }
    return INFINITY;
}

static double event_time(const struct link *l, const struct state *now, const struct state *next,
                         double h, int k, int count) {
    if (l->law->rebound) {
        return now->closed[k] ? INFINITY : meeting_time(l, now, next, h, k);
    }
    return jumped(l, now, next, k) && count < EVENTS_JUMP_MAX ? jump_time(now, next, h, k)
                                                              : INFINITY;
}

struct event event_first(const struct model *m, const struct state *now, const struct state *next,
                         double h, const int *count, int except) {
    struct event first = {.link = -1, .time = INFINITY};
    for (int k = 0; k < m->n_contact; k++) {
        double time = event_time(&m->link[k], now, next, h, k, count[k]);
        if (time < first.time && k != except) {
            first = (struct event){.link = k, .time = snap(time, h)};
        }
    }
    return first;
}

void event_apply(struct state *s, const struct model *m, int link) {
    if (s->closed[link]) {
        s->closed[link] = false;
        s->force[link] = 0.0;
    } else {
        state_close_link(s, m, link);
    }
    state_equilibrium(s, m);
}
