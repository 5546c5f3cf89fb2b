// SPDX-License-Identifier: GPL-3.0-or-later
// Steps in which no link acts, of all runs aboard at once: what chain_floor.h says, as a run alone
// goes through it where storeys are elastic and one ground moves all. Each lane sees the same
// operations in the same order, so that its bits are those of a run alone. A few buildings are
// taken through the whole step before the next ones, while their numbers are at hand; what one
// floor needs of its neighbours is carried along in registers.
//
// A drift that does not exceed its peak brings no shear beyond its own, as rounding keeps order; so
// shears are looked at only where a drift says so.
#include "solve/ensemble_lanes.h"

#define INLINE static inline __attribute__((always_inline))

static const long long SIZE = 0x7fffffffffffffffLL;  // all bits but the sign

// Negative where |x| > peak.
#define UNDER(peak, x) ((wide_bits)((peak) - (wide)((wide_bits)(x)&SIZE)))

// Buildings that are taken through a step together. While the processor waits in the substitution
// of one, where each floor needs the one before, it goes on with the next.
enum { TOGETHER = 2 };

// A number of floor i, in functions that know `x` and how it is `held`.
#define NUMBER(i, q) ENSEMBLE_AT(x, (i)*NUMBER_COUNT + NUMBER_##q)
#define FACTOR(i, q) ENSEMBLE_AT(x, (i)*FACTOR_COUNT + FACTOR_##q)

// The end of the step if the acceleration stays.
INLINE struct ensemble_trial predict(const struct ensemble_state *s, const wide *h,
                                     const wide *half) {
    return (struct ensemble_trial){s->u + (*h * s->v + *half * s->a), s->v + *h * s->a};
}

// r = -m (a_ground + a) - C v_t - K u_t of a building of n floors, with the trial in t.
INLINE void residuals(const struct ensemble_lanes *e, const double *restrict x,
                      enum ensemble_held held, const struct ensemble_state *restrict s,
                      struct ensemble_trial *restrict t, const wide *ground, int n,
                      wide *restrict r) {
    const wide none = {0.0};
    const wide h = e->h - none, half = e->h * e->h / 2.0 - none;
    wide v_below = none;
    struct ensemble_trial own = predict(&s[0], &h, &half);
    wide shear = NUMBER(0, STIFFNESS) * own.u;
    for (int i = 0; i < n; i++) {
        struct ensemble_trial above = {.v = none};
        wide shear_above = none;
        if (i + 1 < n) {
            above = predict(&s[i + 1], &h, &half);
            shear_above = NUMBER(i + 1, STIFFNESS) * (above.u - own.u);
        }
        wide damping =
            NUMBER(i, BELOW) * v_below + NUMBER(i, OWN) * own.v + NUMBER(i, ABOVE) * above.v;
        r[i] = NUMBER(i, INERTIA) * *ground + NUMBER(i, INERTIA) * s[i].a - damping - shear +
               shear_above;
        t[i] = own;
        v_below = own.v;
        own = above;
        shear = shear_above;
    }
}

// Four rows of the inverse from row j on times the residual.
INLINE void multiply_four(const double *restrict inverse, enum ensemble_held held, int j, int n,
                          const wide *restrict r, wide *restrict q) {
    wide q0 = {0.0}, q1 = {0.0}, q2 = {0.0}, q3 = {0.0};
    for (int i = 0, row = j * n; i < n; i++, row++) {
        q0 += r[i] * ENSEMBLE_AT(inverse, row);
        q1 += r[i] * ENSEMBLE_AT(inverse, row + n);
        q2 += r[i] * ENSEMBLE_AT(inverse, row + 2 * n);
        q3 += r[i] * ENSEMBLE_AT(inverse, row + 3 * n);
    }
    q[j] = q0;
    q[j + 1] = q1;
    q[j + 2] = q2;
    q[j + 3] = q3;
}

INLINE void multiply(const double *restrict inverse, enum ensemble_held held, int n,
                     const wide *restrict r, wide *restrict q) {
    int j = 0;
    for (; j + 4 <= n; j += 4) {
        multiply_four(inverse, held, j, n, r, q);
    }
    for (; j < n; j++) {
        wide sum = {0.0};
        for (int i = 0; i < n; i++) {
            sum += r[i] * ENSEMBLE_AT(inverse, j * n + i);
        }
        q[j] = sum;
    }
}

// L D L^T, from the ground up and back.
INLINE void substitute(const double *restrict x, enum ensemble_held held, int n, wide *restrict r,
                       wide *restrict q) {
    wide below = r[0];
    for (int i = 1; i < n; i++) {
        below = r[i] - FACTOR(i - 1, OFF) * below;
        r[i] = below;
    }
    wide above = below * FACTOR(n - 1, PIVOT);
    q[n - 1] = 0.0 + above;
    for (int i = n - 2; i >= 0; i--) {
        above = r[i] * FACTOR(i, PIVOT) - FACTOR(i, OFF) * above;
        q[i] = 0.0 + above;
    }
}

// Negative in lanes where a floor exceeds a peak.
INLINE void look(const struct ensemble_peaks *restrict p, const struct ensemble_state *restrict t,
                 const wide *ground, const wide *u_below, wide_bits *flags) {
    *flags |= UNDER(p->of[PEAK_DISPLACEMENT], t->u) | UNDER(p->of[PEAK_VELOCITY], t->v) |
              UNDER(p->of[PEAK_ACCELERATION], t->a + *ground) |
              UNDER(p->of[PEAK_DRIFT], t->u - *u_below);
}

// The state t that the corrections q lead to from the trial. Negative in lanes where it exceeds a
// peak.
INLINE void correct(const struct ensemble_lanes *e, int first, int n, const wide *ground,
                    wide_bits *beyond) {
    const struct ensemble_peaks *restrict p = e->peak + first;
    const struct ensemble_trial *restrict trial = e->trial + first;
    const struct ensemble_state *restrict s = e->now + first;
    struct ensemble_state *restrict t = e->next + first;
    const wide *restrict q = e->correction + first;
    const wide none = {0.0};
    const wide b = e->b - none, g = e->g - none;
    wide_bits flags = {0};
    wide u_below = none;
    for (int i = 0; i < n; i++) {
        const struct ensemble_state x = {trial[i].u + b * q[i], trial[i].v + g * q[i],
                                         s[i].a + q[i]};
        t[i] = x;
        look(&p[i], &x, ground, &u_below, &flags);
        u_below = x.u;
    }
    *beyond = flags;
}

INLINE void unbalance(const struct ensemble_lanes *e, const struct ensemble_building *b,
                      const wide *ground) {
    const int first = b->shape->first, n = b->shape->n_floor;
    const struct ensemble_state *s = e->now + first;
    struct ensemble_trial *t = e->trial + first;
    if (b->held == HELD_ONCE) {
        residuals(e, b->number, HELD_ONCE, s, t, ground, n, e->residual + first);
    } else {
        residuals(e, b->number, HELD_BY_EACH, s, t, ground, n, e->residual + first);
    }
}

INLINE void solve_held(const struct ensemble_lanes *e, const struct ensemble_building *b,
                       enum ensemble_held held) {
    const int first = b->shape->first, n = b->shape->n_floor;
    if (b->inverse) {
        multiply(b->inverse, held, n, e->residual + first, e->correction + first);
    } else {
        substitute(b->factor, held, n, e->residual + first, e->correction + first);
    }
}

INLINE void solve(const struct ensemble_lanes *e, const struct ensemble_building *b) {
    if (b->held == HELD_ONCE) {
        solve_held(e, b, HELD_ONCE);
    } else {
        solve_held(e, b, HELD_BY_EACH);
    }
}

INLINE void move(const struct ensemble_lanes *e, int k, const wide *ground) {
    const struct building *g = e->building[k].shape;
    correct(e, g->first, g->n_floor, ground, &e->beyond[k]);
}

// Negative in lanes where a contact is nearer than ever or closed.
INLINE void penetrate(const struct ensemble_lanes *e, wide_bits *flags) {
    const struct ensemble_state *restrict t = e->next;
    for (int k = 0; k < e->n_contact; k++) {
        const struct ensemble_contact *c = &e->contact[k];
        *flags |= (wide_bits)(c->limit - (t[e->end[k][0]].u - t[e->end[k][1]].u - c->gap));
    }
}

// The works of the ground and of damping on a building.
INLINE void account_held(const struct ensemble_lanes *e, const struct ensemble_building *b,
                         enum ensemble_held held, const wide *ground_2x) {
    const int first = b->shape->first, n = b->shape->n_floor;
    const double *restrict x = b->number;
    const struct ensemble_state *restrict s = e->now + first, *restrict t = e->next + first;
    struct ensemble_works *restrict w = e->works;
    const wide none = {0.0};
    wide below = none, own = s[0].v + t[0].v;
    for (int i = 0; i < n; i++) {
        wide above = i + 1 < n ? s[i + 1].v + t[i + 1].v : none;
        wide du = t[i].u - s[i].u;
        w->input_2x[(first + i) % LANES_WIDTH] += *ground_2x * (NUMBER(i, INERTIA) * du);
        w->damping_2x[(first + i) % LANES_WIDTH] +=
            du * (NUMBER(i, BELOW) * below + NUMBER(i, OWN) * own + NUMBER(i, ABOVE) * above);
        below = own;
        own = above;
    }
}

INLINE void account(const struct ensemble_lanes *e, const struct ensemble_building *b,
                    const wide *ground_2x) {
    if (b->held == HELD_ONCE) {
        account_held(e, b, HELD_ONCE, ground_2x);
    } else {
        account_held(e, b, HELD_BY_EACH, ground_2x);
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

// Any of the flags of those aboard?
INLINE bool any_aboard(const struct ensemble_lanes *e, const wide_bits *flags) {
    long long any = 0;
    for (int lane = 0; lane < WIDE_RUNS; lane++) {
        any |= (*flags)[lane] & e->aboard[lane];
    }
    return any < 0;
}

// Computes `next`.
INLINE void step(const struct ensemble_lanes *e, const wide *ground, wide_bits *flags) {
    const struct ensemble_building *b = e->building;
    for (int first = 0; first < e->n_building; first += TOGETHER) {
        const int end = first + TOGETHER < e->n_building ? first + TOGETHER : e->n_building;
        for (int k = first; k < end; k++) {
            unbalance(e, &b[k], ground);
        }
        for (int k = first; k < end; k++) {
            solve(e, &b[k]);
        }
        for (int k = first; k < end; k++) {
            move(e, k, ground);
            *flags |= e->beyond[k];
        }
    }
    penetrate(e, flags);
}

LANES int ensemble_march(struct ensemble_lanes *e, const wide *base, int n) {
    for (int i = 0; i < n; i++) {
        wide_bits flags = {0};
        step(e, base + i, &flags);
        if (any_aboard(e, &flags)) {
            return i;
        }
        commit(e, base + i);
    }
    return n;
}

LANES void ensemble_unbalance(struct ensemble_lanes *e, const wide *base) {
    for (int k = 0; k < e->n_building; k++) {
        unbalance(e, &e->building[k], base);
    }
}

LANES void ensemble_move(struct ensemble_lanes *e, const wide *base) {
    for (int k = 0; k < e->n_building; k++) {
        solve(e, &e->building[k]);
        move(e, k, base);
    }
}

LANES void ensemble_move_pushed(struct ensemble_lanes *e, const wide *base) {
    for (int k = 0; k < e->n_building; k++) {
        if (e->building[k].pushed) {
            e->building[k].pushed = false;
            move(e, k, base);
        }
    }
}

LANES void ensemble_commit(struct ensemble_lanes *e, const wide *base) {
    commit(e, base);
}
