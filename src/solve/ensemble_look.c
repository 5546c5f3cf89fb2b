// SPDX-License-Identifier: GPL-3.0-or-later
// What is done for runs in lanes now and then: a closer look at a step, and the energies of a row.
#include <string.h>

#include "solve/ensemble_lanes.h"

// Vectors are compared by the sign of a difference and chosen between by their bits: compilers take
// apart what is said with < and ?:, and may not pass vectors by value between processors.
static const long long SIZE = 0x7fffffffffffffffLL;  // all bits but the sign
enum { SIGN = 63 };

#define INLINE static inline __attribute__((always_inline))
#define ABSOLUTE(x) ((wide)((wide_bits)(x)&SIZE))
#define LESS(a, b) ((wide_bits)((a) - (b)))  // negative where a < b
#define CHOOSE(mask, a, b) ((wide)(((mask) & (wide_bits)(a)) | (~(mask) & (wide_bits)(b))))

LANES unsigned ensemble_leaving(const struct ensemble_lanes *e, const wide *base) {
    const wide most = ENSEMBLE_LARGEST - (wide){0.0};
    wide_bits bad = {0};
    for (int k = 0; k < e->n_contact; k++) {
        const struct ensemble_contact *c = &e->contact[k];
        wide delta = e->next[c->left].u - e->next[c->right].u - c->gap;
        bad |= LESS(0.0, delta);
    }
    for (int i = 0; i < e->n_floor; i++) {
        const struct ensemble_state *s = &e->next[i];
        const wide total = s->a + *base;
        bad |=
            LESS(most, ABSOLUTE(s->u)) | LESS(most, ABSOLUTE(s->v)) | LESS(most, ABSOLUTE(total));
    }
    unsigned leaving = 0;
    for (int lane = 0; lane < WIDE_RUNS; lane++) {
        leaving |= (unsigned)((e->aboard[lane] & bad[lane]) < 0) << lane;
    }
    return leaving;
}

// Where `size` is greater than the peak of a run aboard, the peak and its time.
INLINE void raise(const wide_bits *aboard, const wide *size, const wide *time, wide *peak,
                  wide *peak_time) {
    wide_bits above = (LESS(*peak, *size) >> SIGN) & *aboard;
    *peak = CHOOSE(above, *size, *peak);
    *peak_time = CHOOSE(above, *time, *peak_time);
}

INLINE void raise_floor(struct ensemble_lanes *e, int i, const wide_bits *aboard, const wide *base,
                        const wide *time, const wide *drift) {
    const wide total = e->next[i].a + *base;
    const wide value[PEAK_COUNT] = {
        [PEAK_DISPLACEMENT] = ABSOLUTE(e->next[i].u),
        [PEAK_VELOCITY] = ABSOLUTE(e->next[i].v),
        [PEAK_ACCELERATION] = ABSOLUTE(total),
        [PEAK_DRIFT] = ABSOLUTE(*drift),
        [PEAK_SHEAR] = ABSOLUTE(e->floor[i].stiffness * *drift),
    };
    for (int q = 0; q < PEAK_COUNT; q++) {
        raise(aboard, &value[q], time, &e->floor[i].peak[q], &e->peak_time[i].of[q]);
    }
}

LANES void ensemble_raise(struct ensemble_lanes *e, const wide *base, double time) {
    wide_bits aboard;
    memcpy(&aboard, e->aboard, sizeof aboard);
    const wide now = time - (wide){0.0};
    const struct ensemble_state *s = e->next;
    for (int k = 0; k < e->n_building; k++) {
        const struct building *g = &e->building[k];
        wide drift = s[g->first].u;
        for (int i = g->first; i < g->first + g->n_floor; i++) {
            raise_floor(e, i, &aboard, base, &now, &drift);
            drift = s[i + 1].u - s[i].u;
        }
    }
    for (int k = 0; k < e->n_contact; k++) {
        struct ensemble_contact *c = &e->contact[k];
        wide delta = s[c->left].u - s[c->right].u - c->gap;
        raise(&aboard, &delta, &now, &c->deepest, &c->deepest_time);
    }
}

LANES void ensemble_sums(const struct ensemble_lanes *e, struct energy_sums *sums) {
    wide kinetic = {0.0}, elastic = {0.0}, input = {0.0}, damping = {0.0};
    const struct ensemble_state *s = e->now;
    for (int k = 0; k < e->n_building; k++) {
        const struct building *g = &e->building[k];
        wide drift = s[g->first].u;
        for (int i = g->first; i < g->first + g->n_floor; i++) {
            kinetic -= e->floor[i].inertia * s[i].v * s[i].v;
            elastic += e->floor[i].stiffness * drift * drift / 2.0;
            drift = s[i + 1].u - s[i].u;
        }
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
