// SPDX-License-Identifier: GPL-3.0-or-later
// What is done for every floor at the end of every step, where all storeys are elastic and no C is
// full, is done in one pass: forces, their works, and the look for peaks. Each element sees the
// operations of chain.c.
#include "solve/account.h"

#include "core/lanes.h"
#include "core/number.h"
#include "solve/chain_floor.h"

// Floors, in whole lanes, that are looked at together for a new peak. They stay in the cache
// meanwhile.
enum { BLOCK = 16 * LANES_WIDTH };

// Forces of the floors from `first` on, n of them in whole lanes.
static inline void find_forces(const struct chain *c, int first, int n, struct state *next) {
    const double *u = next->u, *stiffness = c->stiffness;
    double *drift = next->drift, *shear = next->shear;
    LANES_LOOP
    for (int i = first, end = first + (n & ~(LANES_WIDTH - 1)); i < end; i++) {
        double d = floor_drift(c, u, i);
        drift[i] = d;
        shear[i] = stiffness[i] * d;
    }
}

// Their works.
static inline void add_works(const struct model *m, int first, int n, struct energy_account *a,
                             const struct state *now, const struct state *next) {
    const double ground_2x = state_is_uniform(m) ? now->ground_a[0] + next->ground_a[0] : 0.0;
    lanes_wide input = LANES_AT(a->input_2x, 0), damping = LANES_AT(a->damping_2x, 0);
    for (int i = first; i < first + n; i += LANES_WIDTH) {
        floors_input(&m->chain, i, ground_2x, now->u, next->u, &input);
        floors_damped(&m->chain, i, now->u, next->u, now->v, next->v, &damping);
    }
    *(lanes_wide *)a->input_2x = input;
    *(lanes_wide *)a->damping_2x = damping;
}

// Negative if one of them may have a new peak, or is not a number. The shear has one only with the
// drift: k |drift| is rounded to no less for a greater drift.
static inline int64_t look(int first, int n, double *const peak[PEAK_COUNT],
                           const struct state *s) {
    const double *u = s->u, *v = s->v, *total = s->total, *drift = s->drift;
    const double *peak_u = peak[PEAK_DISPLACEMENT], *peak_v = peak[PEAK_VELOCITY];
    const double *peak_a = peak[PEAK_ACCELERATION], *peak_d = peak[PEAK_DRIFT];
    int64_t sign = 0;
    LANES_LOOP
    for (int i = first, end = first + (n & ~(LANES_WIDTH - 1)); i < end; i++) {
        sign |= number_beyond(u[i], peak_u[i]) | number_beyond(v[i], peak_v[i]) |
                number_beyond(total[i], peak_a[i]) | number_beyond(drift[i], peak_d[i]);
    }
    return sign;
}

LANES static int64_t take_floors(const struct model *m, int first, int n, struct energy_account *a,
                                 double *const peak[PEAK_COUNT], const struct state *now,
                                 struct state *next) {
    find_forces(&m->chain, first, n, next);
    add_works(m, first, n, a, now, next);
    return look(first, n, peak, next);
}

void account_step(struct energy_account *a, struct results *r, const struct model *m,
                  const struct state *now, struct state *next) {
    if (!state_is_linear(m)) {
        energy_step(a, m, now, next);
        peaks_all_floors(r, m, next);
        return;
    }
    for (int first = 0; first < m->n_dof; first += BLOCK) {
        int n = m->n_dof - first < BLOCK ? m->n_dof - first : BLOCK;
        if (take_floors(m, first, lanes_whole(n), a, r->peak, now, next) < 0) {
            peaks_floors(r, first, n, next);
        }
    }
    if (!state_is_uniform(m)) {
        energy_input(a, m, now, next);
    }
}
