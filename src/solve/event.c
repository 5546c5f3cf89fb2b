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
    return (l->law->traits & CONTACT_JUMPS) && !l->bilateral && now->closed[k] != next->closed[k] &&
           (now->force[k] != 0.0 || next->force[k] != 0.0);
}

static double instant(const struct state *now, const struct state *next, double h, int k) {
    if (next->closed[k]) {
        return next->t_close[k] - now->time;
    }
    struct path path = {fmax(now->delta[k], 0.0), now->rate[k], fmin(next->delta[k], 0.0),
                        next->rate[k], h};
    double rate;
    return crossing_find(&path, &rate);
}

struct event event_first(const struct model *m, const struct state *now, const struct state *next,
                         double h) {
    struct event first = {.link = -1, .time = INFINITY};
    for (int k = 0; k < m->n_contact; k++) {
        if (jumped(&m->link[k], now, next, k)) {
            double time = instant(now, next, h, k);
            if (time < first.time) {
                first = (struct event){.link = k, .time = snap(time, h)};
            }
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
