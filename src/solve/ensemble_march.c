// SPDX-License-Identifier: GPL-3.0-or-later
// Steps in which no link acts, of all runs aboard at once: what chain_floor.h, flight_step.c and
// account.c say for elastic storeys under one ground. Each lane sees their operations in their
// order, so that its bits are those of a run alone. A building is taken through the whole step
// before the next one, while its numbers are at hand; what one floor needs of its neighbours is
// carried along in registers.
//
// A drift that does not exceed its peak brings no shear beyond its own, as rounding keeps order; so
// shears are looked at only where a drift says so.
#include "solve/ensemble_lanes.h"

#define INLINE static inline __attribute__((always_inline))

static const long long SIZE = 0x7fffffffffffffffLL;  // all bits but the sign

// Negative where |x| > peak.
#define UNDER(peak, x) ((wide_bits)((peak) - (wide)((wide_bits)(x)&SIZE)))

// The end of the step if the acceleration stays.
INLINE void predict(const struct ensemble_lanes *e, const struct ensemble_state *restrict s,
                    struct ensemble_state *restrict t) {
    double h = e->h, half = h * h / 2.0;
    t->u = s->u + (h * s->v + half * s->a);
    t->v = s->v + h * s->a;
}

// r = -m (a_ground + a) - C v_t - K u_t of a building of n floors, with the trial in t.
INLINE void residuals(const struct ensemble_lanes *e, const struct ensemble_floor *restrict f,
                      const struct ensemble_state *restrict s, struct ensemble_state *restrict t,
                      const wide *ground, int n) {
    const wide none = {0.0};
    wide *restrict r = e->residual;
    wide v_below = none;
    predict(e, &s[0], &t[0]);
    wide shear = f[0].stiffness * t[0].u;
    for (int i = 0; i < n; i++) {
        wide v_above = none, shear_above = none;
        if (i + 1 < n) {
            predict(e, &s[i + 1], &t[i + 1]);
            v_above = t[i + 1].v;
            shear_above = f[i + 1].stiffness * (t[i + 1].u - t[i].u);
        }
        wide damping = f[i].below * v_below + f[i].own * t[i].v + f[i].above * v_above;
        r[i] = f[i].inertia * *ground + f[i].inertia * s[i].a - damping - shear + shear_above;
        v_below = t[i].v;
        shear = shear_above;
    }
}

// Four rows of the inverse times the residual.
INLINE void multiply_four(const wide *restrict row, int n, const wide *restrict r,
                          wide *restrict q) {
    wide q0 = {0.0}, q1 = {0.0}, q2 = {0.0}, q3 = {0.0};
    for (int i = 0; i < n; i++) {
        q0 += r[i] * row[i];
        q1 += r[i] * row[n + i];
        q2 += r[i] * row[2 * n + i];
        q3 += r[i] * row[3 * n + i];
    }
    q[0] = q0;
    q[1] = q1;
    q[2] = q2;
    q[3] = q3;
}

INLINE void multiply(const wide *restrict inverse, int n, const wide *restrict r,
                     wide *restrict q) {
    int j = 0;
    for (; j + 4 <= n; j += 4) {
        multiply_four(inverse + (size_t)j * (size_t)n, n, r, q + j);
    }
    for (; j < n; j++) {
        wide sum = {0.0};
        for (int i = 0; i < n; i++) {
            sum += r[i] * inverse[j * n + i];
        }
        q[j] = sum;
    }
}

// L D L^T, from the ground up and back.
INLINE void substitute(const struct ensemble_factor *restrict f, int n, wide *restrict r,
                       wide *restrict q) {
    for (int i = 1; i < n; i++) {
        r[i] -= f[i - 1].factor * r[i - 1];
    }
    wide x = r[n - 1] * f[n - 1].pivot;
    q[n - 1] = 0.0 + x;
    for (int i = n - 2; i >= 0; i--) {
        x = r[i] * f[i].pivot - f[i].factor * x;
        q[i] = 0.0 + x;
    }
}

// The state that the corrections lead to from the trial. *flags: see step.
INLINE void correct(const struct ensemble_lanes *e, const struct ensemble_floor *restrict f,
                    const struct ensemble_state *restrict s, struct ensemble_state *restrict t,
                    const wide *ground, int n, wide_bits *flags) {
    const wide *restrict q = e->correction;
    wide_bits more = {0};
    wide under = {0.0};
    double b = e->b, g = e->g;
    for (int i = 0; i < n; i++) {
        wide u = t[i].u + b * q[i];
        wide v = t[i].v + g * q[i];
        wide a = s[i].a + q[i];
        t[i].u = u;
        t[i].v = v;
        t[i].a = a;
        more |= UNDER(f[i].peak[PEAK_DISPLACEMENT], u) | UNDER(f[i].peak[PEAK_VELOCITY], v) |
                UNDER(f[i].peak[PEAK_ACCELERATION], a + *ground) |
                UNDER(f[i].peak[PEAK_DRIFT], u - under);
        under = u;
    }
    *flags |= more;
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
INLINE void step(const struct ensemble_lanes *e, const wide *ground, wide_bits *flags) {
    for (int k = 0; k < e->n_building; k++) {
        const int first = e->building[k].first, n = e->building[k].n_floor;
        const struct ensemble_floor *f = e->floor + first;
        residuals(e, f, e->now + first, e->next + first, ground, n);
        if (e->inverse[k]) {
            multiply(e->inverse[k], n, e->residual, e->correction);
        } else {
            substitute(e->factor + first, n, e->residual, e->correction);
        }
        correct(e, f, e->now + first, e->next + first, ground, n, flags);
    }
    penetrate(e, flags);
}

// The works of the ground and of damping on a building.
INLINE void account(const struct ensemble_lanes *e, const struct building *g,
                    const wide *ground_2x) {
    const struct ensemble_floor *restrict f = e->floor;
    const struct ensemble_state *restrict s = e->now, *restrict t = e->next;
    struct ensemble_works *restrict w = e->works;
    const wide none = {0.0};
    wide below = none, own = s[g->first].v + t[g->first].v;
    for (int i = g->first, end = i + g->n_floor; i < end; i++) {
        wide above = i + 1 < end ? s[i + 1].v + t[i + 1].v : none;
        wide du = t[i].u - s[i].u;
        w->input_2x[i % LANES_WIDTH] += *ground_2x * (f[i].inertia * du);
        w->damping_2x[i % LANES_WIDTH] +=
            du * (f[i].below * below + f[i].own * own + f[i].above * above);
        below = own;
        own = above;
    }
}

INLINE void commit(struct ensemble_lanes *e, const wide *ground) {
    const wide ground_2x = e->works->ground + *ground;
    for (int k = 0; k < e->n_building; k++) {
        account(e, &e->building[k], &ground_2x);
    }
    e->works->ground = *ground;
    struct ensemble_state *old = e->now;
    e->now = e->next;
    e->next = old;
}

LANES void ensemble_commit(struct ensemble_lanes *e, const wide *base) {
    commit(e, base);
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
        commit(e, base + i);
    }
    return n;
}
