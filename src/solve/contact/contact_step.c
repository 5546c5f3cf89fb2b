// SPDX-License-Identifier: GPL-3.0-or-later
// Which links act in a step: those that were closed before, those that close on its way, and which
// of them are closed at its end.
#include <math.h>
#include <string.h>

#include "core/number.h"
#include "solve/contact/contact.h"
#include "solve/contact/exact.h"
#include "solve/contact/sweep_step.h"
#include "solve/event/crossing.h"
#include "solve/event/rest.h"

// A first guess of the force, which does not begin to pull.
static inline double contact_guess(double f, int n_past, const double past[PAST_STEPS]) {
    const double next = SWEEP_GUESS(f, past, n_past);
    return f > 0.0 ? number_max(next, 0.0) : f;
}

// Forces of rigid contacts at rest hardly curve; a parabola would amplify their errors.
static inline int contact_past_after(int n_past, const struct contact_law *law) {
    int most = law->rebound ? 1 : PAST_STEPS;
    return n_past < most ? n_past + 1 : most;
}

// Copies the history of a link's law.
static void contact_keep_history(const struct state *now, struct state *next,
                                 struct link_scratch *p) {
    const struct link *l = p->link;
    double *history = next->link_history + l->history;
    memcpy(history, now->link_history + l->history, (size_t)l->law->n_history * sizeof *history);
    p->history = history;
}

// Link k, live and closed at the start of the step, begins it as it ended the last.
static inline void contact_carry_on(struct work *w, const struct state *now, struct state *next,
                                    int k) {
    struct link_scratch *p = &w->link[k];
    const struct link_state *from = &now->link[k];
    next->link[k] = (struct link_state){
        .force = contact_guess(from->force, from->n_past, from->past),
        .past = {from->force, from->past[0], from->past[1]},
        .t_close = from->t_close,
        .v_close = from->v_close,
        .n_past = contact_past_after(from->n_past, p->law),
        .is_live = true,
        .closed = true,
    };
    if (p->law->n_history > 0) {
        contact_keep_history(now, next, p);
    }
    if (p->law->rebound) {
        p->v_rest = rest_velocity(now, w->model, w->h, k);
    }
    p->branch = BRANCH_CLOSED;
    p->clamped = false;
    if (!(from->t_close < now->time)) {
        p->resolved->step = 0.0;
    }
}

// Do the same links act as in the last step and the one before?
static bool contact_is_steady(const struct gaps *g, const struct state *now,
                              const struct state *next) {
    bool same = now->n_live == g->n_acting && next->n_live == g->n_acting;
    for (int i = 0; same && i < g->n_acting; i++) {
        int k = g->acting[i];
        same = now->live[i] == k && next->live[i] == k && now->link[k].closed;
    }
    return same;
}

// Makes the links that are closed in `now`, and no others, live in `next`.
static void contact_enliven_closed(struct gaps *g, const struct state *now, struct state *next) {
    state_open_links(next);
    gaps_forget(g);
    for (int i = 0; i < now->n_live; i++) {
        int k = now->live[i];
        if (now->link[k].closed) {
            next->live[next->n_live++] = k;
            gaps_touch(g, k);
        }
    }
}

void contact_begin(struct work *w, const struct state *now, struct state *next) {
    if (!contact_is_steady(&w->gaps, now, next)) {
        contact_enliven_closed(&w->gaps, now, next);
    }
    w->n_toggled = 0;
    for (int i = 0; i < next->n_live; i++) {
        contact_carry_on(w, now, next, next->live[i]);
    }
}

// Makes link k live, which closes in this step. Its velocity at the instant of closure is that of
// its path without its own force; the law's history starts from it.
static void contact_close_link(struct work *w, const struct state *now, struct state *next, int k) {
    struct link_scratch *p = &w->link[k];
    const struct link *l = p->link;
    state_enliven(next, k);
    gaps_touch(&w->gaps, k);
    p->branch = BRANCH_OPEN;
    p->clamped = false;
    *p->resolved = (struct resolved){.factors = w->factors};
    p->force = 0.0;
    p->history = next->link_history + l->history;
    struct equation e = exact_equation(w, now, next, k);
    struct path path = {fmin(now->delta[k], 0.0), state_rate(now, w->model, k), e.d_free, e.v_free,
                        w->h};
    double rate;
    next->link[k].t_close = now->time + crossing_find(&path, &rate);
    next->link[k].v_close = number_max(rate, 0.0);
    if (l->law->close) {
        l->law->close(l->constant, next->link[k].v_close, next->link_history + l->history);
    }
}

// The penetration up to which bodies do not hit each other: those at rest move by rounding. Fixed
// steps know no scale, and are too long for motions of that size to begin in.
static double contact_rounding(const struct work *w, int k) {
    if (!w->scales) {
        return 0.0;
    }
    return SCALE_ROUNDING * (fabs(w->model->link[k].gap) + w->scales->most_u);
}

// Does an open link close in this step? One that has just opened may stand a rounding error inside;
// it closes only if it goes deeper. Rigid contacts close by an event.
static inline bool contact_closes(const struct work *w, const struct state *now,
                                  const struct state *next, int k) {
    return next->delta[k] > contact_rounding(w, k) && next->delta[k] > now->delta[k] &&
           !next->link[k].is_live && k != w->held && !w->model->link[k].law->rebound;
}

bool contact_close(struct work *w, const struct state *now, struct state *next, int k) {
    bool closed = contact_closes(w, now, next, k);
    if (closed) {
        contact_close_link(w, now, next, k);
    }
    return closed;
}

// Computes the trial of the buildings of a run of links, unless links touched them before.
static void contact_try_buildings(struct work *w, const struct state *now,
                                  const struct gap_run *r) {
    for (int i = 0; i < 2; i++) {
        int b = r->building[i];
        if (b != WALL && !w->gaps.is_touched[b]) {
            floors_trial(w, now, b);
        }
    }
}

int contact_search(struct work *w, const struct state *now, struct state *next) {
    int before = next->n_live;
    for (int i = 0; i < w->gaps.n_pressed; i++) {
        const struct gap_run *r = &w->gaps.run[w->gaps.pressed[i]];
        contact_try_buildings(w, now, r);
        for (int k = r->first; k < r->first + r->n; k++) {
            contact_close(w, now, next, k);
        }
    }
    return next->n_live - before;
}

void contact_finish(const struct work *w, struct state *next) {
    if (w->commits) {
        state_commit_links(next, w->model);
    }
}
