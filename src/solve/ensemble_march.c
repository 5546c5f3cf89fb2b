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
INLINE void predict(const struct ensemble_lanes *e, const struct ensemble_state *restrict s,
                    struct ensemble_state *restrict t) {
    double h = e->h, half = h * h / 2.0;
    t->u = s->u + (h * s->v + half * s->a);
    t->v = s->v + h * s->a;
}

// r = -m (a_ground + a) - C v_t - K u_t of a building of n floors, with the trial in t.
INLINE void residuals(const struct ensemble_lanes *e, const double *restrict x,
                      enum ensemble_held held, const struct ensemble_state *restrict s,
                      struct ensemble_state *restrict t, const wide *ground, int n,
                      wide *restrict r) {
    const wide none = {0.0};
    wide v_below = none;
    predict(e, &s[0], &t[0]);
    wide shear = NUMBER(0, STIFFNESS) * t[0].u;
    for (int i = 0; i < n; i++) {
        wide v_above = none, shear_above = none;
        if (i + 1 < n) {
            predict(e, &s[i + 1], &t[i + 1]);
            v_above = t[i + 1].v;
            shear_above = NUMBER(i + 1, STIFFNESS) * (t[i + 1].u - t[i].u);
        }
        wide damping =
            NUMBER(i, BELOW) * v_below + NUMBER(i, OWN) * t[i].v + NUMBER(i, ABOVE) * v_above;
        r[i] = NUMBER(i, INERTIA) * *ground + NUMBER(i, INERTIA) * s[i].a - damping - shear +
               shear_above;
        v_below = t[i].v;
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

// The state that the corrections q lead to from the trial, with a look at it.
INLINE void correct(const struct ensemble_lanes *e, const struct ensemble_peaks *restrict p,
                    const struct ensemble_state *restrict s, struct ensemble_state *restrict t,
                    const wide *ground, int n, const wide *restrict q, wide_bits *flags) {
    wide_bits more = {0};
    wide u_below = {0.0};
    double b = e->b, g = e->g;
    for (int i = 0; i < n; i++) {
        const struct ensemble_state x = {t[i].u + b * q[i], t[i].v + g * q[i], s[i].a + q[i]};
        t[i] = x;
        look(&p[i], &x, ground, &u_below, &more);
        u_below = x.u;
    }
    *flags |= more;
}

INLINE void unbalance(const struct ensemble_lanes *e, const struct ensemble_building *b,
                      const wide *ground) {
    const int first = b->shape->first, n = b->shape->n_floor;
    const struct ensemble_state *s = e->now + first;
    struct ensemble_state *t = e->next + first;
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

INLINE void move(const struct ensemble_lanes *e, const struct ensemble_building *b,
                 const wide *ground, wide_bits *flags) {
    const int first = b->shape->first;
    correct(e, e->peak + first, e->now + first, e->next + first, ground, b->shape->n_floor,
            e->correction + first, flags);
}

// *closer gets negative in lanes where a contact is nearer than ever or closed, *open where one is
// so that is open.
INLINE void penetrate(const struct ensemble_lanes *e, wide_bits *closer, wide_bits *open) {
    const struct ensemble_state *restrict t = e->next;
    for (int k = 0; k < e->n_contact; k++) {
        const struct ensemble_contact *c = &e->contact[k];
        wide delta = t[e->end[k][0]].u - t[e->end[k][1]].u - c->gap;
        wide_bits deeper = (wide_bits)(c->deepest - delta);
        *closer |= deeper;
        *open |= deeper & ~(wide_bits)(0.0 - delta);
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
            move(e, &b[k], ground, flags);
        }
    }
    wide_bits closer = {0}, open = {0};
    penetrate(e, &closer, &open);
    *flags |= closer;
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
    wide_bits flags = {0};
    for (int k = 0; k < e->n_building; k++) {
        solve(e, &e->building[k]);
        move(e, &e->building[k], base, &flags);
    }
}

LANES bool ensemble_exceeds(struct ensemble_lanes *e, const wide *base) {
    wide_bits closer = {0}, open = {0};
    penetrate(e, &closer, &open);
    e->nearer = any_aboard(e, &open);
    bool any = e->nearer;
    for (int k = 0; k < e->n_building; k++) {
        struct ensemble_building *b = &e->building[k];
        wide_bits flags = {0};
        wide u_below = {0.0};
        for (int i = b->shape->first; i < b->shape->first + b->shape->n_floor; i++) {
            look(&e->peak[i], &e->next[i], base, &u_below, &flags);
            u_below = e->next[i].u;
        }
        b->exceeds = any_aboard(e, &flags);
        any |= b->exceeds;
    }
    return any;
}

LANES void ensemble_commit(struct ensemble_lanes *e, const wide *base) {
    commit(e, base);
}
