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

INLINE void trial(const struct ensemble_lanes *e, int n) {
    const wide *restrict u = e->now.u, *restrict v = e->now.v, *restrict a = e->now.a;
    wide *restrict u_t = e->u_trial, *restrict v_t = e->v_trial;
    double h = e->h, half = h * h / 2.0;
    for (int i = 0; i < n; i++) {
        u_t[i] = u[i] + (h * v[i] + half * a[i]);
        v_t[i] = v[i] + h * a[i];
    }
}

// r = -m (a_ground + a) - C v_t - K u_t of one building; the joints below its first floor and above
// its last one are 0.
INLINE void residuals(const struct ensemble_lanes *e, const wide *base, int first, int end) {
    const wide *restrict u = e->u_trial, *restrict v = e->v_trial, *restrict a = e->now.a;
    const wide *restrict k = e->stiffness, *restrict below = e->below;
    const wide *restrict own = e->own, *restrict above = e->above, *restrict m = e->inertia;
    wide *restrict external = e->next.external, *restrict r = e->residual;
    wide shear = k[first] * (u[first] - 0.0 * u[first - 1]);
    for (int i = first; i < end; i++) {
        wide lift = k[i + 1] * (u[i + 1] - u[i]);
        wide shear_above = i + 1 < end ? lift : 0.0 * lift;
        wide damping = below[i] * v[i - 1] + own[i] * v[i] + above[i] * v[i + 1];
        wide p = m[i] * *base;
        external[i] = p;
        r[i] = p + m[i] * a[i] - damping - shear + shear_above;
        shear = shear_above;
    }
}

// Row j of the inverse times r, and the three that follow.
INLINE void four_rows(const wide *restrict row, int n, const wide *restrict r, wide *restrict q) {
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
        four_rows(inverse + j * n, n, r, q + j);
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
INLINE void substitute(const wide *restrict pivot, const wide *restrict l, int n, wide *restrict r,
                       wide *restrict q) {
    for (int i = 1; i < n; i++) {
        r[i] -= l[i - 1] * r[i - 1];
    }
    wide x = r[n - 1] * pivot[n - 1];
    q[n - 1] = 0.0 + x;
    for (int i = n - 2; i >= 0; i--) {
        x = r[i] * pivot[i] - l[i] * x;
        q[i] = 0.0 + x;
    }
}

// The state that the correction q, in `total`, leads to. *flags: see step.
INLINE void correct(const struct ensemble_lanes *e, const wide *base, int n, wide_bits *flags) {
    const wide *restrict u_t = e->u_trial, *restrict v_t = e->v_trial, *restrict a_0 = e->now.a;
    const wide *restrict most_u = e->peak[PEAK_DISPLACEMENT];
    const wide *restrict most_v = e->peak[PEAK_VELOCITY];
    const wide *restrict most_a = e->peak[PEAK_ACCELERATION];
    wide *restrict u = e->next.u, *restrict v = e->next.v, *restrict a = e->next.a;
    wide *restrict total = e->total;
    wide_bits above = {0};
    for (int i = 0; i < n; i++) {
        wide q = total[i];
        wide x = u_t[i] + e->b * q;
        wide y = v_t[i] + e->g * q;
        wide z = a_0[i] + q;
        wide sum = z + *base;
        u[i] = x;
        v[i] = y;
        a[i] = z;
        total[i] = sum;
        above |= UNDER(most_u[i], x) | UNDER(most_v[i], y) | UNDER(most_a[i], sum);
    }
    *flags |= above;
}

// C v at the end of the step, and the works.
INLINE void account(const struct ensemble_lanes *e, int first, int end, wide_bits *flags) {
    const struct ensemble_state *s = &e->now, *t = &e->next;
    const wide *restrict u0 = s->u, *restrict u1 = t->u, *restrict v = t->v;
    const wide *restrict p0 = s->external, *restrict p1 = t->external;
    const wide *restrict f0 = s->damping, *restrict in0 = s->input_2x;
    const wide *restrict out0 = s->damping_2x, *restrict most = e->peak[PEAK_DRIFT];
    const wide *restrict below = e->below, *restrict own = e->own, *restrict above = e->above;
    wide *restrict f1 = t->damping, *restrict in1 = t->input_2x, *restrict out1 = t->damping_2x;
    wide_bits more = {0};
    wide under = 0.0 * u1[first - 1];
    for (int i = first; i < end; i++) {
        wide x = u1[i];
        wide du = x - u0[i];
        wide f = below[i] * v[i - 1] + own[i] * v[i] + above[i] * v[i + 1];
        f1[i] = f;
        in1[i] = in0[i] + (p0[i] + p1[i]) * du;
        out1[i] = out0[i] + (f0[i] + f) * du;
        more |= UNDER(most[i], x - under);
        under = x;
    }
    *flags |= more;
}

INLINE void penetrate(const struct ensemble_lanes *e, wide_bits *flags) {
    const wide *restrict u = e->next.u;
    wide_bits deeper = {0};
    for (int k = 0; k < e->n_contact; k++) {
        wide delta = u[e->ends[k].left] - u[e->ends[k].right] - e->gap[k];
        deeper |= (wide_bits)(e->deepest[k] - delta);
    }
    *flags |= deeper;
}

// Computes `next`. *flags gets negative in lanes where a peak is exceeded, and so where a link
// would act.
INLINE void step(const struct ensemble_lanes *e, const wide *base, wide_bits *flags) {
    trial(e, e->n_dof);
    for (int k = 0; k < e->n_building; k++) {
        const struct building *g = &e->building[k];
        int first = g->first, n = g->n_floor;
        residuals(e, base, first, first + n);
        if (e->inverse[k]) {
            multiply(e->inverse[k], n, e->residual + first, e->total + first);
        } else {
            substitute(e->pivot + first, e->factor + first, n, e->residual + first,
                       e->total + first);
        }
    }
    correct(e, base, e->n_dof, flags);
    penetrate(e, flags);
    for (int k = 0; k < e->n_building; k++) {
        const struct building *g = &e->building[k];
        account(e, g->first, g->first + g->n_floor, flags);
    }
}

WIDE int ensemble_march(struct ensemble_lanes *e, const wide *base, int n) {
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
        struct ensemble_state old = e->now;
        e->now = e->next;
        e->next = old;
    }
    return n;
}
