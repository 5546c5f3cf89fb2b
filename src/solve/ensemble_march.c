// SPDX-License-Identifier: GPL-3.0-or-later
// Steps in which no link acts, of all runs aboard at once: chain.c, effective.c, energy.c and
// peaks.c for elastic storeys, in one pass over the floors. Each lane sees their operations in
// their order, so that its bits are those of a run alone.
//
// A drift that does not exceed its peak brings no shear beyond its own, as rounding keeps order; so
// shears are looked at only where a drift says so.
#include "solve/ensemble_lanes.h"

#define INLINE static inline __attribute__((always_inline))

static const long long SIZE = 0x7fffffffffffffffLL;  // all bits but the sign

// Negative where |x| > peak.
#define UNDER(peak, x) ((wide_bits)((peak) - (wide)((wide_bits)(x)&SIZE)))

INLINE void trial(const struct ensemble_lanes *e) {
    const struct ensemble_state *restrict s = e->now;
    struct ensemble_floor *restrict f = e->floor;
    double h = e->h, half = h * h / 2.0;
    for (int i = 0; i < e->n_floor; i++) {
        f[i].u_trial = s[i].u + (h * s[i].v + half * s[i].a);
        f[i].v_trial = s[i].v + h * s[i].a;
    }
}

// r = -m (a_ground + a) - C v_t - K u_t of a building of n floors; the joints below its first floor
// and above its last one are 0.
INLINE void residuals(struct ensemble_floor *restrict f, const struct ensemble_state *restrict s,
                      const wide *base, int n) {
    wide ground = *base;
    wide shear = f[0].stiffness * (f[0].u_trial - 0.0 * f[-1].u_trial);
    for (int i = 0; i < n; i++) {
        wide above = f[i + 1].stiffness * (f[i + 1].u_trial - f[i].u_trial);
        if (i + 1 == n) {
            above *= 0.0;
        }
        wide damping =
            f[i].below * f[i - 1].v_trial + f[i].own * f[i].v_trial + f[i].above * f[i + 1].v_trial;
        f[i].residual = f[i].inertia * ground + f[i].inertia * s[i].a - damping - shear + above;
        shear = above;
    }
}

// Four rows of the inverse times the residual.
INLINE void multiply_four(const wide *restrict row, int n, struct ensemble_floor *restrict f,
                          int j) {
    wide q0 = {0.0}, q1 = {0.0}, q2 = {0.0}, q3 = {0.0};
    for (int i = 0; i < n; i++) {
        wide r = f[i].residual;
        q0 += r * row[i];
        q1 += r * row[n + i];
        q2 += r * row[2 * n + i];
        q3 += r * row[3 * n + i];
    }
    f[j].correction = q0;
    f[j + 1].correction = q1;
    f[j + 2].correction = q2;
    f[j + 3].correction = q3;
}

INLINE void multiply(const wide *restrict inverse, int n, struct ensemble_floor *restrict f) {
    int j = 0;
    for (; j + 4 <= n; j += 4) {
        multiply_four(inverse + (size_t)j * (size_t)n, n, f, j);
    }
    for (; j < n; j++) {
        wide q = {0.0};
        for (int i = 0; i < n; i++) {
            q += f[i].residual * inverse[j * n + i];
        }
        f[j].correction = q;
    }
}

// L D L^T, from the ground up and back.
INLINE void substitute(struct ensemble_floor *restrict f, int n) {
    for (int i = 1; i < n; i++) {
        f[i].residual -= f[i - 1].factor * f[i - 1].residual;
    }
    wide x = f[n - 1].residual * f[n - 1].pivot;
    f[n - 1].correction = 0.0 + x;
    for (int i = n - 2; i >= 0; i--) {
        x = f[i].residual * f[i].pivot - f[i].factor * x;
        f[i].correction = 0.0 + x;
    }
}

// The state that the correction leads to. *flags: see step.
INLINE void correct(const struct ensemble_lanes *e, const wide *base, wide_bits *flags) {
    const struct ensemble_state *restrict s = e->now;
    struct ensemble_state *restrict t = e->next;
    struct ensemble_floor *restrict f = e->floor;
    wide_bits more = {0};
    wide ground = *base;
    double b = e->b, g = e->g;
    for (int i = 0; i < e->n_floor; i++) {
        wide q = f[i].correction;
        wide u = f[i].u_trial + b * q;
        wide v = f[i].v_trial + g * q;
        wide a = s[i].a + q;
        wide total = a + ground;
        t[i].u = u;
        t[i].v = v;
        t[i].a = a;
        f[i].total = total;
        more |= UNDER(f[i].peak[PEAK_DISPLACEMENT], u) | UNDER(f[i].peak[PEAK_VELOCITY], v) |
                UNDER(f[i].peak[PEAK_ACCELERATION], total);
    }
    *flags |= more;
}

// The works of a building, and a look for peaks of its drifts.
INLINE void account_building(const struct ensemble_lanes *e, const struct building *g,
                             const wide *ground_2x, wide_bits *flags) {
    const struct ensemble_floor *restrict f = e->floor;
    const struct ensemble_state *restrict s = e->now, *restrict t = e->next;
    wide *restrict input = e->next_works->input_2x, *restrict damping = e->next_works->damping_2x;
    wide_bits more = {0};
    wide under = 0.0 * t[g->first - 1].u;
    wide below = s[g->first - 1].v + t[g->first - 1].v;
    wide own = s[g->first].v + t[g->first].v;
    for (int i = g->first; i < g->first + g->n_floor; i++) {
        wide u = t[i].u;
        wide du = u - s[i].u;
        wide above = s[i + 1].v + t[i + 1].v;
        input[i % LANES_WIDTH] += *ground_2x * (f[i].inertia * du);
        damping[i % LANES_WIDTH] += du * (f[i].below * below + f[i].own * own + f[i].above * above);
        more |= UNDER(f[i].peak[PEAK_DRIFT], u - under);
        under = u;
        below = own;
        own = above;
    }
    *flags |= more;
}

INLINE void account(const struct ensemble_lanes *e, const wide *base, wide_bits *flags) {
    *e->next_works = *e->works;
    e->next_works->ground = *base;
    wide ground_2x = e->works->ground + *base;
    for (int k = 0; k < e->n_building; k++) {
        account_building(e, &e->building[k], &ground_2x, flags);
    }
}

INLINE void penetrate(const struct ensemble_lanes *e, wide_bits *flags) {
    const struct ensemble_state *restrict t = e->next;
    wide_bits deeper = {0};
    for (int k = 0; k < e->n_contact; k++) {
        const struct ensemble_contact *c = &e->contact[k];
        wide delta = t[c->left].u - t[c->right].u - c->gap;
        deeper |= (wide_bits)(c->deepest - delta);
    }
    *flags |= deeper;
}

// Computes `next`. *flags gets negative in lanes where a peak is exceeded, and so where a link
// would act.
INLINE void step(const struct ensemble_lanes *e, const wide *base, wide_bits *flags) {
    trial(e);
    for (int k = 0; k < e->n_building; k++) {
        const struct building *g = &e->building[k];
        struct ensemble_floor *f = e->floor + g->first;
        residuals(f, e->now + g->first, base, g->n_floor);
        if (e->inverse[k]) {
            multiply(e->inverse[k], g->n_floor, f);
        } else {
            substitute(f, g->n_floor);
        }
    }
    correct(e, base, flags);
    penetrate(e, flags);
    account(e, base, flags);
}

LANES int ensemble_march(struct ensemble_lanes *e, const wide *base, int n) {
    for (int i = 0; i < n; i++) {
        wide_bits flags = {0};
        step(e, base + i, &flags);
        long long any = 0;
        for (int lane = 0; lane < WIDE_RUNS; lane++) {
            any |= flags[lane] & e->aboard[lane];
        }
        if (any < 0) {
            return i;
        }
        ensemble_swap(e);
    }
    return n;
}
