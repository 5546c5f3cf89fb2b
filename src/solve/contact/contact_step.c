// SPDX-License-Identifier: GPL-3.0-or-later
// Which links act in a step: those that were closed before, those that close on its way, and which
// of them are closed at its end.
#include <math.h>
#include <string.h>

#include "core/number.h"
#include "solve/contact/contact.h"
#include "solve/contact/sweep_step.h"
#include "solve/event/event.h"
#include "solve/event/hermite.h"

// Link k, live and closed at the start of the step, begins it as it ended the last. Its force is
// guessed, but not one that pulls where it has pushed. Forces of rigid contacts at rest hardly
// curve: a parabola would amplify their errors.
static inline void contact_carry_on(struct work *w, const struct state *now, struct state *next,
                                    int k) {
    struct link_scratch *p = &w->link[k];
    const struct link_state *from = &now->link[k];
    const double guess = SWEEP_GUESS(from->force, from->past, from->n_past);
    const int most = p->law->rebound ? 1 : PAST_STEPS;
    next->link[k] = state_carry_on(from, most);
    if (from->force > 0.0) {
        next->link[k].force = number_max(guess, 0.0);
    }
    if (p->law->n_history > 0) {
        double *history = next->link_history + p->link->history;
        memcpy(history, now->link_history + p->link->history,
               (size_t)p->law->n_history * sizeof *history);
        p->history = history;
        if (p->law->traits & CONTACT_NEEDS_STEP) {
            history[0] = w->h;
        }
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

void contact_begin(struct work *w, const struct state *now, struct state *next) {
    state_open_links(next);
    gaps_forget(&w->gaps);
    w->n_toggled = 0;
    for (int i = 0; i < now->n_live; i++) {
        const int k = now->live[i];
        if (now->link[k].closed) {
            next->live[next->n_live++] = k;
            gaps_touch(&w->gaps, k);
            contact_carry_on(w, now, next, k);
        }
    }
}

// An open link that has just opened may stand a rounding error inside: it closes only if it goes
// deeper. Bodies at rest move by rounding, too, relative to a scale; fixed steps know none, and are
// too long for motions of that size to begin in. Rigid contacts close by an event.
//
// The velocity at the instant of closure is that of the link's path without its own force; the
// law's history starts from it.
bool contact_close(struct work *w, const struct state *now, struct state *next, int k) {
    const struct link *l = &w->model->link[k];
    const double d0 = now->delta[k], d = next->delta[k];
    const double rounding = w->scales ? SCALE_ROUNDING * (fabs(l->gap) + w->scales->most_u) : 0.0;
    if (!(d > rounding && d > d0) || next->link[k].is_live || k == w->held || l->law->rebound) {
        return false;
    }
    struct link_scratch *p = &w->link[k];
    state_enliven(next, k);
    gaps_touch(&w->gaps, k);
    p->branch = BRANCH_OPEN;
    p->clamped = false;
    *p->resolved = (struct resolved){.factors = w->factors};
    p->force = 0.0;
    p->history = next->link_history + l->history;
    struct equation e = exact_equation(w, now, next, k);
    struct path path = {fmin(d0, 0.0), state_rate(now, w->model, k), e.d_free, e.v_free, w->h};
    double rate;
    next->link[k].t_close = now->time + hermite_crossing(&path, &rate);
    next->link[k].v_close = number_max(rate, 0.0);
    if (l->law->close) {
        l->law->close(l->constant, next->link[k].v_close, next->link_history + l->history);
    }
    return true;
}

// The trial of a building is there already if links touched it before.
int contact_search(struct work *w, const struct state *now, struct state *next) {
    int before = next->n_live;
    for (int i = 0; i < w->gaps.n_pressed; i++) {
        const struct gap_run *r = &w->gaps.run[w->gaps.pressed[i]];
        for (int side = 0; side < 2; side++) {
            int b = r->building[side];
            if (b != WALL && !w->gaps.is_touched[b]) {
                floors_trial(w, now, b);
            }
        }
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
