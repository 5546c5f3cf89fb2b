// SPDX-License-Identifier: GPL-3.0-or-later
// What runs in lanes need only now and then: a closer look at a step, and the energies of a row.
#include <string.h>

#include "solve/ensemble/ensemble_lanes.h"

// Vectors are compared by the sign of a difference and selected by their bits, as compilers split <
// and ?: of vectors into scalars; they are passed by address, as code for other processors has
// another convention for values.
enum { SIGN = 63 };

// Contacts looked at together, of which few are pressed.
enum { TOGETHER = 8 };

#define LESS(a, b) ((wide_bits)((a) - (b)))  // negative where a < b

// The bits of active lanes in which flags are negative.
LANES_INLINE unsigned active_runs(const struct ensemble_lanes *e, const wide_bits *flags) {
    static const wide_bits bit = {1, 2, 4, 8, 16, 32, 64, 128};
    const wide_bits own = (*flags >> SIGN) & bit;
    lanes_bits part[2], active[2];
    memcpy(part, &own, sizeof part);
    memcpy(active, e->active, sizeof active);
    const lanes_bits set = (part[0] & active[0]) | (part[1] & active[1]);
    return (unsigned)(set[0] | set[1] | set[2] | set[3]);
}

LANES unsigned ensemble_overflows(const struct ensemble_lanes *e) {
    return active_runs(e, &e->works->beyond);
}

// Lists a contact that may be beyond its limit in some lanes.
LANES_INLINE void list_pressed(struct ensemble_lanes *e, int k) {
    const wide delta = ENSEMBLE_PENETRATION(e, k, e->next);
    const wide_bits flags = LESS(e->gap[k].limit, delta), inside = LESS(0.0, delta);
    const unsigned beyond = active_runs(e, &flags);
    if (beyond != 0) {
        const unsigned closed = beyond & active_runs(e, &inside);
        e->pressed[e->n_pressed++] = (struct ensemble_pressed){k, closed, beyond & ~closed};
    }
}

LANES void ensemble_press(struct ensemble_lanes *e) {
    e->n_pressed = 0;
    for (int first = 0; first < e->n_contact; first += TOGETHER) {
        const int end = first + TOGETHER < e->n_contact ? first + TOGETHER : e->n_contact;
        wide_bits any = {0};
        for (int k = first; k < end; k++) {
            const wide delta = ENSEMBLE_PENETRATION(e, k, e->next);
            any |= LESS(e->gap[k].limit, delta);
        }
        const bool pressed = ensemble_any(e->active, &any);
        for (int k = first; pressed && k < end; k++) {
            list_pressed(e, k);
        }
    }
}

LANES void ensemble_approach(struct ensemble_lanes *e, double time) {
    wide_bits active;
    memcpy(&active, e->active, sizeof active);
    const wide now = time - (wide){0.0};
    for (int i = 0; i < e->n_pressed; i++) {
        const int k = e->pressed[i].contact;
        struct ensemble_gap *c = &e->gap[k];
        struct ensemble_nearest *p = &e->nearest[k];
        const wide delta = ENSEMBLE_PENETRATION(e, k, e->next);
        const wide_bits nearer =
            (LESS(c->limit, delta) >> SIGN) & ~(LESS(0.0, delta) >> SIGN) & active;
        c->limit = WIDE_CHOOSE(nearer, delta, c->limit);
        p->depth = WIDE_CHOOSE(nearer, delta, p->depth);
        p->time = WIDE_CHOOSE(nearer, now, p->time);
    }
}

LANES_INLINE void add_building(const struct ensemble_lanes *e, const struct ensemble_building *b,
                               wide *kinetic, wide *elastic) {
    const enum ensemble_held held = b->held;
    const struct ensemble_state *s = e->now + b->shape->first;
    wide u_below = {0.0};
    for (int i = 0; i < b->shape->n_floor; i++) {
        const double *x = b->number;
        const wide drift = s[i].u - u_below;
        *kinetic += ENSEMBLE_AT(x, i * NUMBER_COUNT + NUMBER_MASS) * s[i].v * s[i].v;
        *elastic += ENSEMBLE_AT(x, i * NUMBER_COUNT + NUMBER_STIFFNESS) * drift * drift / 2.0;
        u_below = s[i].u;
    }
}

LANES static void add_sums(const struct ensemble_lanes *e, struct energy_sums *sums) {
    wide kinetic = {0.0}, elastic = {0.0}, input = {0.0}, damping = {0.0};
    for (int k = 0; k < e->n_building; k++) {
        add_building(e, &e->building[k], &kinetic, &elastic);
    }
    for (int i = 0; i < LANES_WIDTH; i++) {
        input += e->works->input_2x[i];
        damping += e->works->damping_2x[i];
    }
    for (int lane = 0; lane < WIDE_RUNS; lane++) {
        sums[lane] = (struct energy_sums){.kinetic = kinetic[lane] / 2.0,
                                          .elastic = elastic[lane],
                                          .input_2x = input[lane],
                                          .damping_2x = damping[lane]};
    }
}

void ensemble_sums(struct ensemble_lanes *e, struct energy_sums *sums) {
    e->steps->catch_up(e);
    add_sums(e, sums);
}
