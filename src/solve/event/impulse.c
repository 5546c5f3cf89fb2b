// SPDX-License-Identifier: GPL-3.0-or-later
// Newton's impact, one contact at a time. With r the velocity of approach, m* the effective mass
// and w the rebound that the law wants, the impulse m* (r + w) keeps the momentum to rounding.
//
// Contacts that are closed at that instant, because they rest on each other, are struck in turn
// wherever the bodies now approach, until none do: so an impulse travels through a row that
// touches, as through the balls of Newton's cradle. (Contacts that close at the same instant from
// apart come as events of their own, no time later.) Where that takes too long, as between a light
// body and two heavy ones, the rest is settled at once without rebound (rest_pool).
//
// A body that bounces under a constant pressing acceleration comes to rest after infinitely many
// bounces in a finite time. A bounce with rebound w under the acceleration a lasts 2 w / a; one
// too short to follow is none, and the contact is at rest: the bodies stay together until a force
// would have to pull. The energy given up, m* w^2 / 2, is booked as dissipated.
#include "solve/event/event.h"

#include <math.h>
#include <string.h>

enum { SWEEPS_BY_LAW = 1000, SWEEPS_MAX = 20000 };

// Bodies that meet within this share of the shortest bounce meet at once.
static const double AT_ONCE = 1e-6;

// The rebound below which contact k rests. Its bodies are pressed together by what accelerates
// them, and by what its force at rest held up.
static double impulse_slowest_rebound(const struct state *s, const struct model *m, int k,
                                      const struct least_bounce *least) {
    const struct link *l = &m->link[k];
    double pressing = state_pressing(s, m, k) + s->link[k].force / l->mass;
    return fmax(fmax(least->time * pressing / 2.0, least->velocity),
                rest_rounding(&m->link[k], s->v));
}

// One impact; returns the velocity of the rebound.
static double impulse_strike(struct state *s, const struct model *m, int k, enum rebound rebound,
                             const struct least_bounce *least, struct meeting *meeting) {
    const struct link *l = &m->link[k];
    double r = state_rate(s, m, k);
    double w = rebound == REBOUND_BY_LAW ? l->law->rebound(l->constant, r) : 0.0;
    if (w <= impulse_slowest_rebound(s, m, k, least)) {
        w = 0.0;
    }
    double impulse = l->mass * (r + w);
    state_push(l, m, impulse, s->v);
    if (!meeting->struck) {
        *meeting = (struct meeting){.struck = true, .approach = r};
    }
    meeting->impulse += impulse;
    meeting->work += impulse * (r - w) / 2.0;
    return w;
}

// Strikes the contacts at rest whose bodies approach; false: none do.
static bool impulse_sweep(struct state *s, const struct model *m, enum rebound rebound,
                          const struct least_bounce *least, struct meeting *meeting) {
    bool struck = false;
    for (int k = 0; k < m->n_contact; k++) {
        if (state_rests(s, m, k) && state_rate(s, m, k) > rest_rounding(&m->link[k], s->v)) {
            impulse_strike(s, m, k, rebound, least, &meeting[k]);
            struck = true;
        }
    }
    return struck;
}

// Gives the bodies of rows at rest that approach each other one motion; false: there are no rows.
static bool impulse_pool(struct state *s, const struct model *m, struct meeting *meeting) {
    struct rest_contacts t;
    if (!rest_find(s, m, &t)) {
        return false;
    }
    rest_pool(&t, m, s->v, s->ground_v);
    for (int i = 0; i < t.n; i++) {
        const struct passage *p = &t.passage[i];
        struct meeting *met = &meeting[t.contact[i]];
        if (p->pooled && !met->struck) {
            *met = (struct meeting){.struck = true, .approach = fmax(p->approach, 0.0)};
        }
        met->impulse += p->push;
        met->work += p->lost;
    }
    return true;
}

// Strikes contacts at rest until the bodies of none approach.
static void impulse_strike_those_at_rest(struct state *s, const struct model *m,
                                         const struct least_bounce *least,
                                         struct meeting *meeting) {
    bool settled = false;
    for (int i = 0; !settled && i < SWEEPS_MAX; i++) {
        const enum rebound rebound = i < SWEEPS_BY_LAW ? REBOUND_BY_LAW : REBOUND_NONE;
        settled = (i == SWEEPS_BY_LAW && impulse_pool(s, m, meeting)) ||
                  !impulse_sweep(s, m, rebound, least, meeting);
    }
}

static void impulse_come_to_rest(struct state *s, int k, double approached) {
    state_enliven(s, k);
    s->link[k].closed = true;
    s->link[k].t_close = s->time;
    s->link[k].v_close = approached;
}

void impulse_hold(struct state *s, const struct model *m, int k, struct meeting *meeting) {
    memset(meeting, 0, (size_t)m->n_contact * sizeof *meeting);
    impulse_come_to_rest(s, k, 0.0);
    state_complete(s, m);
}

// A light body between two heavy ones that approach each other meets them in turn at one instant,
// as often as it is lighter, where the accelerations part it from both, so that neither contact
// comes to rest. Takes the contacts that are about to meet among those at rest.
static void impulse_hold_touching(struct state *s, const struct model *m,
                                  const struct least_bounce *least) {
    for (int k = 0; k < m->n_contact; k++) {
        double r = state_rate(s, m, k);
        bool open = !s->link[k].closed && m->link[k].law->rebound;
        if (open && r > rest_rounding(&m->link[k], s->v) &&
            -s->delta[k] <= AT_ONCE * least->time * r) {
            impulse_come_to_rest(s, k, r);
        }
    }
}

void impulse_meet(struct state *s, const struct model *m, int k, enum rebound rebound,
                  const struct least_bounce *least, struct meeting *meeting) {
    memset(meeting, 0, (size_t)m->n_contact * sizeof *meeting);
    double approached = fmax(state_rate(s, m, k), 0.0);
    if (approached == 0.0 || impulse_strike(s, m, k, rebound, least, &meeting[k]) == 0.0) {
        impulse_come_to_rest(s, k, approached);
    }
    if (rebound == REBOUND_NONE) {
        impulse_hold_touching(s, m, least);
    }
    impulse_strike_those_at_rest(s, m, least, meeting);
    // Contacts at rest whose bodies leave each other for longer than the shortest bounce open.
    for (int i = 0; i < m->n_contact; i++) {
        if (state_rests(s, m, i) &&
            state_rate(s, m, i) < -impulse_slowest_rebound(s, m, i, least)) {
            s->link[i].closed = false;
            s->link[i].force = 0.0;
        }
    }
    // Forces and accelerations follow from the velocities. Those of storeys are found by
    // state_complete where models are linear.
    state_complete(s, m);
    if (!state_is_linear(m)) {
        state_forces(s, m, s->storey_history, NULL);
    }
    for (int i = 0; i < m->n_link; i++) {
        if (s->link[i].closed && m->link[i].law->force) {
            s->link[i].force = state_link_force(s, m, i);
        }
    }
    rest_equilibrium(s, m);
}
