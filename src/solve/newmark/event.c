// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/newmark/event.h"

#include <math.h>

#include "solve/event/crossing.h"
#include "solve/event/rest.h"

// An event this close to an end of the step, relative to it, is at that end.
static const double AT_END = 1e-9;

// Energy that the opening of a contact may bring, over the kinetic energy at the largest velocity
// so far, or that it would have reached after a step of the deck at this rate.
static const double ABRUPT = 1e-4;

static double event_snap(double time, double h) {
    return time <= AT_END * h ? 0.0 : time >= (1.0 - AT_END) * h ? h : time;
}

// Has contact k closed or opened in the step, in a way that steps are split at?
static bool event_splits(const struct work *w, const struct state *now, const struct state *next,
                         int k) {
    const struct contact_law *law = w->model->link[k].law;
    bool jumps =
        (law->traits & CONTACT_JUMPS) && (now->link[k].force != 0.0 || next->link[k].force != 0.0);
    return now->link[k].closed != next->link[k].closed && !law->rebound &&
           (jumps || w->splitting == SPLIT_ALWAYS);
}

static struct path event_path_of(const struct model *m, const struct state *now,
                                 const struct state *next, double h, int k) {
    return (struct path){now->delta[k], state_rate(now, m, k), next->delta[k],
                         state_rate(next, m, k), h};
}

// Time from the start of the step at which the force of link k jumps.
static double event_jump_time(const struct model *m, const struct state *now,
                              const struct state *next, double h, int k) {
    if (next->link[k].closed) {
        return next->link[k].t_close - now->time;
    }
    struct path path = event_path_of(m, now, next, h, k);
    path.d0 = fmax(path.d0, 0.0);
    path.d1 = fmin(path.d1, 0.0);
    double rate;
    return crossing_find(&path, &rate);
}

// Time from the start of the step at which the bodies of rigid contact k meet; infinite if they do
// not, but for rounding.
static double event_meeting_time(const struct model *m, const struct state *now,
                                 const struct state *next, double h, int k) {
    struct path path = event_path_of(m, now, next, h, k);
    double inside = fmax(path.d0, 0.0);  // by an error of rounding or integration
    double rate;
    path.d0 -= inside;
    path.d1 -= inside;
    bool meets = path.d1 > state_rounding(&m->link[k], next->u);
    if (meets) {
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

bool event_is_idle(const struct state *s, const struct model *m, int k) {
    const struct link *l = &m->link[k];
    double rate = state_rate(s, m, k);
    double rounding = rest_rounding(l, s->v);
    double pressing = state_pressing(s, m, k);
    return rate < -rounding || (rate <= rounding && pressing <= rest_rounding(l, s->a));
}

// Does contact k, which closes at the start of the step, neither move nor press inwards then? What
// makes it close comes later in the step; closed before, it would open again, to and fro at one
// instant.
static bool event_closes_idle(const struct state *now, const struct state *next,
                              const struct model *m, int k) {
    return next->link[k].closed && event_is_idle(now, m, k);
}

static void event_take_earlier(struct event *first, int k, double time, double h) {
    if (time < first->time) {
        *first = (struct event){.link = k, .time = event_snap(time, h)};
    }
}

struct event event_first(const struct work *w, const struct state *now, const struct state *next,
                         double h, const int *count, int except) {
    const struct model *m = w->model;
    struct event first = {.link = -1, .time = INFINITY};
    struct event otherwise = first;
    for (int i = 0; i < w->n_toggled; i++) {
        int k = w->toggled[i];
        if (k != except && event_splits(w, now, next, k) && count[k] < EVENTS_JUMP_MAX) {
            double time = event_jump_time(m, now, next, h, k);
            bool is_idle = event_snap(time, h) == 0.0 && event_closes_idle(now, next, m, k);
            event_take_earlier(is_idle ? &otherwise : &first, k, time, h);
        }
    }
    for (int i = 0; i < w->n_rigid; i++) {
        int k = w->rigid[i];
        if (k != except && !now->link[k].closed) {
            event_take_earlier(&first, k, event_meeting_time(m, now, next, h, k), h);
        }
    }
    return first.link < 0 ? otherwise : first;
}

bool event_is_abrupt(struct work *w, const struct state *now, const struct state *next) {
    for (int i = 0; i < w->n_toggled; i++) {
        int k = w->toggled[i];
        const struct link *l = &w->model->link[k];
        if (!l->law->rebound || next->link[k].closed) {
            continue;
        }
        double way = now->delta[k] - next->delta[k];
        double parting = fabs(state_rate(next, w->model, k));
        double speed = fmax(floors_speed(w, now), parting * w->model->dt / w->h);
        if (now->link[k].force * way > ABRUPT * l->mass * speed * speed) {
            w->memory->unresolved = k;
            return true;
        }
    }
    return false;
}

void event_apply(struct state *s, const struct model *m, int link) {
    if (s->link[link].closed) {
        s->link[link].closed = false;
        s->link[link].force = 0.0;
    } else {
        state_close_link(s, m, link);
    }
    state_complete(s, m);
    equilibrium_find(s, m);
}
