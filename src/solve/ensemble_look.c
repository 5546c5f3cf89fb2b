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

WIDE unsigned ensemble_leaving(const struct ensemble_lanes *e) {
    const wide most = ENSEMBLE_LARGEST - (wide){0.0};
    wide_bits bad = {0};
    for (int k = 0; k < e->n_contact; k++) {
        wide delta = e->next.u[e->ends[k].left] - e->next.u[e->ends[k].right] - e->gap[k];
        bad |= LESS(0.0, delta);
    }
    for (int i = 0; i < e->n_dof; i++) {
        bad |= LESS(most, ABSOLUTE(e->next.u[i])) | LESS(most, ABSOLUTE(e->next.v[i])) |
               LESS(most, ABSOLUTE(e->total[i]));
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

INLINE void raise_floor(struct ensemble_lanes *e, int i, const wide_bits *aboard, const wide *time,
                        const wide *drift) {
    const wide value[PEAK_COUNT] = {
        [PEAK_DISPLACEMENT] = ABSOLUTE(e->next.u[i]),      [PEAK_VELOCITY] = ABSOLUTE(e->next.v[i]),
        [PEAK_ACCELERATION] = ABSOLUTE(e->total[i]),       [PEAK_DRIFT] = ABSOLUTE(*drift),
        [PEAK_SHEAR] = ABSOLUTE(e->stiffness[i] * *drift),
    };
    for (int q = 0; q < PEAK_COUNT; q++) {
        raise(aboard, &value[q], time, &e->peak[q][i], &e->peak_time[q][i]);
    }
}

WIDE void ensemble_commit(struct ensemble_lanes *e, double time) {
    wide_bits aboard;
    memcpy(&aboard, e->aboard, sizeof aboard);
    const wide now = time - (wide){0.0};
    const wide *u = e->next.u;
    for (int k = 0; k < e->n_building; k++) {
        const struct building *g = &e->building[k];
        wide drift = u[g->first] - 0.0 * u[g->first - 1];
        for (int i = g->first; i < g->first + g->n_floor; i++) {
            raise_floor(e, i, &aboard, &now, &drift);
            drift = u[i + 1] - u[i];
        }
    }
    for (int k = 0; k < e->n_contact; k++) {
        wide delta = u[e->ends[k].left] - u[e->ends[k].right] - e->gap[k];
        raise(&aboard, &delta, &now, &e->deepest[k], &e->deepest_time[k]);
    }
    struct ensemble_state old = e->now;
    e->now = e->next;
    e->next = old;
}

WIDE void ensemble_sums(const struct ensemble_lanes *e, struct energy_sums *sums) {
    wide kinetic = {0.0}, elastic = {0.0}, input = {0.0}, damping = {0.0};
    const wide *u = e->now.u, *v = e->now.v;
    for (int k = 0; k < e->n_building; k++) {
        const struct building *g = &e->building[k];
        wide drift = u[g->first] - 0.0 * u[g->first - 1];
        for (int i = g->first; i < g->first + g->n_floor; i++) {
            kinetic -= e->inertia[i] * v[i] * v[i];
            elastic += e->stiffness[i] * drift * drift / 2.0;
            input += e->now.input_2x[i];
            damping += e->now.damping_2x[i];
            drift = u[i + 1] - u[i];
        }
    }
    for (int lane = 0; lane < WIDE_RUNS; lane++) {
        sums[lane] = (struct energy_sums){.kinetic = kinetic[lane] / 2.0,
                                          .elastic = elastic[lane],
                                          .input_2x = input[lane],
                                          .damping_2x = damping[lane]};
    }
}
