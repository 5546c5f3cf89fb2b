// SPDX-License-Identifier: GPL-3.0-or-later
// The steps of struct ensemble_steps, for parts of one size: see ensemble_floors.h. A few buildings
// are taken through the whole step before the next ones, while their numbers are at hand.
// part_any says whether a flag is negative in an active lane, and part_transpose makes the
// numbers of WIDTH floors by lanes those of the lanes by floors, or back. CLONES stands in front of
// functions; STEPS is the name of what they make up, and SOLVE its function for contacts.
#ifndef JOSTLE_ENSEMBLE_STEPS_H
#define JOSTLE_ENSEMBLE_STEPS_H

#include <stddef.h>
#include <string.h>

#include "solve/ensemble/ensemble_floors.h"

// Buildings that are taken through a step together. While the processor waits in the substitution
// of one, where each floor needs the one before, it goes on with the next.
enum { TOGETHER = 2 };

// A function that stays one: compilers mix up what is in others.
#define APART CLONES __attribute__((noinline)) static

APART void begin_once(const struct ensemble_lanes *e, const struct ensemble_building *b, int p,
                      const wide *ground, struct ensemble_trial *t) {
    const struct beginning g = beginning_of(e, b, p, ground, t);
    begin_floors(&g, HELD_ONCE, p);
}

APART void begin_each(const struct ensemble_lanes *e, const struct ensemble_building *b, int p,
                      const wide *ground, struct ensemble_trial *t) {
    const struct beginning g = beginning_of(e, b, p, ground, t);
    begin_floors(&g, HELD_BY_EACH, p);
}

LANES_INLINE void begin(const struct ensemble_lanes *e, const struct ensemble_building *b, int p,
                        const wide *ground, struct ensemble_trial *t) {
    b->held == HELD_ONCE ? begin_once(e, b, p, ground, t) : begin_each(e, b, p, ground, t);
}

APART void end_once(const struct ensemble_lanes *e, const struct ensemble_building *b, int p,
                    const wide *ground, const struct ensemble_trial *t, part_bits *beyond) {
    struct ending g = ending_of(e, b, p, ground, t);
    end_floors(&g, HELD_ONCE, p);
    *beyond = g.beyond;
}

APART void end_each(const struct ensemble_lanes *e, const struct ensemble_building *b, int p,
                    const wide *ground, const struct ensemble_trial *t, part_bits *beyond) {
    struct ending g = ending_of(e, b, p, ground, t);
    end_floors(&g, HELD_BY_EACH, p);
    *beyond = g.beyond;
}

// The state of building k, and whether it exceeds a peak.
LANES_INLINE void end(const struct ensemble_lanes *e, int k, int p, const wide *ground,
                      const struct ensemble_trial *t) {
    const struct ensemble_building *b = &e->building[k];
    part_bits *beyond = &FLAGS(e->beyond[k]);
    b->held == HELD_ONCE ? end_once(e, b, p, ground, t, beyond)
                         : end_each(e, b, p, ground, t, beyond);
}

// Negative in lanes where a contact is nearer than ever or closed.
LANES_INLINE void look_for_contacts(const struct ensemble_lanes *e, int p, part_bits *flags) {
    const struct ensemble_state *t = e->next;
    for (int k = 0; k < e->n_contact; k++) {
        const struct ensemble_gap *c = &e->gap[k];
        const part delta =
            PART_OF(t[e->end[k][0]].u) - PART_OF(t[e->end[k][1]].u) - PART_OF(c->width);
        *flags |= (part_bits)(PART_OF(c->limit) - delta);
    }
}

LANES_INLINE void commit(struct ensemble_lanes *e, const wide *ground) {
    struct ensemble_state *old = e->now;
    struct ensemble_works *w = e->works;
    for (int p = 0; p < PARTS; p++) {
        PART(w->ground_2x) = PART(w->ground) + PART_OF(*ground);
        PART(w->ground) = PART_OF(*ground);
    }
    e->now = e->next;
    e->next = old;
    e->owing = true;
}

// Computes `next`. Negative in lanes where it is beyond a peak.
LANES_INLINE void step(struct ensemble_lanes *e, int p, const wide *ground, part_bits *beyond) {
    const struct ensemble_building *b = e->building;
    for (int first = 0; first < e->n_building; first += TOGETHER) {
        const int last = first + TOGETHER < e->n_building ? first + TOGETHER : e->n_building;
        for (int k = first; k < last; k++) {
            begin(e, &b[k], p, ground, e->trial + b[k].shape->first - b[first].shape->first);
        }
        for (int k = first; k < last; k++) {
            end(e, k, p, ground, e->trial + b[k].shape->first - b[first].shape->first);
            *beyond |= FLAGS(e->beyond[k]);
        }
    }
}

CLONES static int march(struct ensemble_lanes *e, const wide *base, int n, bool *presses) {
    for (int i = 0; i < n; i++) {
        bool any = false, near = false;
        for (int p = 0; p < PARTS; p++) {
            const long long *active = e->active + (ptrdiff_t)p * WIDTH;
            part_bits beyond = {0}, pressed = {0};
            step(e, p, base + i, &beyond);
            look_for_contacts(e, p, &pressed);
            const part_bits flags = beyond | pressed;
            if (part_any(active, &flags)) {
                any = true;
                near |= part_any(active, &pressed);
            }
        }
        e->owing = false;
        if (any) {
            *presses = near;
            return i;
        }
        commit(e, base + i);
    }
    return n;
}

// The forces that live links begin the step with, link by link as a run alone takes them.
LANES_INLINE void push(struct ensemble_lanes *e) {
    for (int k = 0; k < e->n_contact; k++) {
        for (int p = 0; e->acts[k] && p < PARTS; p++) {
            PART(e->trial[e->end[k][0]].residual) -= PART(e->force[k]);
            PART(e->trial[e->end[k][1]].residual) += PART(e->force[k]);
            PART(e->force[k]) = (part){0.0};
        }
        e->acts[k] = false;
    }
}

CLONES static void move(struct ensemble_lanes *e, const wide *base) {
    for (int k = 0; k < e->n_building; k++) {
        for (int p = 0; p < PARTS; p++) {
            begin(e, &e->building[k], p, base, e->trial + e->building[k].shape->first);
        }
    }
    e->owing = false;
    push(e);
    for (int k = 0; k < e->n_building; k++) {
        for (int p = 0; p < PARTS; p++) {
            end(e, k, p, base, e->trial + e->building[k].shape->first);
        }
    }
}

// Stores the numbers of WIDTH floors from floor i on in the arrays of the runs of part p.
LANES_INLINE void store(part *x, double *const *array, int p, int i) {
    part_transpose(x);
    for (int lane = 0; lane < WIDTH; lane++) {
        *(unaligned *)(array[p * WIDTH + lane] + i) = (unaligned)x[lane];
    }
}

CLONES static void show(struct ensemble_lanes *e, int eight) {
    const struct building all = {.first = 0};
    const struct ensemble_building b = {.shape = &all};
    const wide still = {0.0};
    for (int first = eight * WIDE_RUNS; first < (eight + 1) * WIDE_RUNS; first += WIDTH) {
        for (int p = 0; p < PARTS; p++) {
            const struct beginning g = beginning_of(e, &b, p, &still, NULL);
            part u[WIDTH], v[WIDTH], q[WIDTH];
            for (int i = 0; i < WIDTH; i++) {
                try_floor(&g, p, first + i, &u[i], &v[i]);
                q[i] = PART(e->correction[first + i]);
            }
            store(u, e->show.u_trial, p, first);
            store(v, e->show.v_trial, p, first);
            store(q, e->show.correction, p, first);
        }
    }
    e->shown[eight] = true;
}

// The corrections that links have changed, of up to WIDTH floors from floor i on.
LANES_INLINE void load_changed(const struct ensemble_lanes *e, int k, int p, int i, part *q) {
    const int first = e->building[k].shape->first + i;
    if (!e->building[k].pushed) {
        for (int lane = 0; lane < WIDTH; lane++) {
            q[lane] = PART(e->correction[first + lane]);
        }
        return;
    }
    for (int lane = 0; lane < WIDTH; lane++) {
        q[lane] = (part) * (const unaligned *)(e->show.correction[p * WIDTH + lane] + first);
    }
    part_transpose(q);
}

// Building k with those.
LANES_INLINE void move_building(struct ensemble_lanes *e, int k, int p, const wide *ground) {
    const struct building *shape = e->building[k].shape;
    const struct beginning s = beginning_of(e, &e->building[k], p, ground, NULL);
    struct ending g = ending_of(e, &e->building[k], p, ground, NULL);
    for (int first = 0; first < shape->n_floor; first += WIDTH) {
        part q[WIDTH];
        load_changed(e, k, p, first, q);
        for (int i = 0; i < WIDTH && first + i < shape->n_floor; i++) {
            part u, v;
            try_floor(&s, p, first + i, &u, &v);
            end_floor(&g, p, first + i, &u, &v, &q[i]);
        }
    }
    FLAGS(e->beyond[k]) = g.beyond;
}

CLONES static void move_pushed(struct ensemble_lanes *e, const wide *base) {
    for (int k = 0; k < e->n_building; k++) {
        struct ensemble_building *b = &e->building[k];
        for (int p = 0; (b->pushed || b->swept) && p < PARTS; p++) {
            move_building(e, k, p, base);
        }
        b->pushed = b->swept = false;
    }
}

CLONES static void catch_up(struct ensemble_lanes *e) {
    const wide still = {0.0};
    if (!e->owing) {
        return;
    }
    for (int k = 0; k < e->n_building; k++) {
        for (int p = 0; p < PARTS; p++) {
            const struct beginning g = beginning_of(e, &e->building[k], p, &still, e->trial);
            if (e->building[k].held == HELD_ONCE) {
                account_floors(&g, HELD_ONCE, p);
            } else {
                account_floors(&g, HELD_BY_EACH, p);
            }
        }
    }
    e->owing = false;
    memcpy(e->next, e->now, (size_t)e->n_floor * sizeof *e->next);
}

CLONES static void commit_step(struct ensemble_lanes *e, const wide *base) {
    commit(e, base);
    memset(e->shown, false, (size_t)(e->n_floor / WIDE_RUNS) + 1);
}

const struct ensemble_steps STEPS = {
    .march = march,
    .move = move,
    .solve = SOLVE,
    .show = show,
    .move_pushed = move_pushed,
    .commit = commit_step,
    .catch_up = catch_up,
};

#endif
