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
INLINE void predict(const struct ensemble_state *restrict s, const wide *h, const wide *half,
                    struct ensemble_motion *restrict m) {
    m->u = s->u + (*h * s->v + *half * s->a);
    m->v = s->v + *h * s->a;
}

// r = -m (a_ground + a) - C v_t - K u_t of a building of n floors, with the trial.
INLINE void residuals(const struct ensemble_lanes *e, const double *restrict x,
                      enum ensemble_held held, const struct ensemble_state *restrict s,
                      const wide *ground, int n, struct ensemble_motion *restrict m) {
    const wide none = {0.0};
    const wide h = e->h - none, half = e->h * e->h / 2.0 - none;
    wide v_below = none;
    predict(&s[0], &h, &half, &m[0]);
    wide shear = NUMBER(0, STIFFNESS) * m[0].u;
    for (int i = 0; i < n; i++) {
        wide v_above = none, shear_above = none;
        if (i + 1 < n) {
            predict(&s[i + 1], &h, &half, &m[i + 1]);
            v_above = m[i + 1].v;
            shear_above = NUMBER(i + 1, STIFFNESS) * (m[i + 1].u - m[i].u);
        }
        wide damping =
            NUMBER(i, BELOW) * v_below + NUMBER(i, OWN) * m[i].v + NUMBER(i, ABOVE) * v_above;
        m[i].residual = NUMBER(i, INERTIA) * *ground + NUMBER(i, INERTIA) * s[i].a - damping -
                        shear + shear_above;
        v_below = m[i].v;
        shear = shear_above;
    }
}

// Four rows of the inverse from row j on times the residuals.
INLINE void multiply_four(const double *restrict inverse, enum ensemble_held held, int j, int n,
                          struct ensemble_motion *m) {
    wide q0 = {0.0}, q1 = {0.0}, q2 = {0.0}, q3 = {0.0};
    for (int i = 0, row = j * n; i < n; i++, row++) {
        const wide r = m[i].residual;
        q0 += r * ENSEMBLE_AT(inverse, row);
        q1 += r * ENSEMBLE_AT(inverse, row + n);
        q2 += r * ENSEMBLE_AT(inverse, row + 2 * n);
        q3 += r * ENSEMBLE_AT(inverse, row + 3 * n);
    }
    m[j].correction = q0;
    m[j + 1].correction = q1;
    m[j + 2].correction = q2;
    m[j + 3].correction = q3;
}

INLINE void multiply(const double *restrict inverse, enum ensemble_held held, int n,
                     struct ensemble_motion *m) {
    int j = 0;
    for (; j + 4 <= n; j += 4) {
        multiply_four(inverse, held, j, n, m);
    }
    for (; j < n; j++) {
        wide sum = {0.0};
        for (int i = 0; i < n; i++) {
            sum += m[i].residual * ENSEMBLE_AT(inverse, j * n + i);
        }
        m[j].correction = sum;
    }
}

// L D L^T, from the ground up and back.
INLINE void substitute(const double *restrict x, enum ensemble_held held, int n,
                       struct ensemble_motion *m) {
    wide below = m[0].residual;
    for (int i = 1; i < n; i++) {
        below = m[i].residual - FACTOR(i - 1, OFF) * below;
        m[i].residual = below;
    }
    wide above = below * FACTOR(n - 1, PIVOT);
    m[n - 1].correction = 0.0 + above;
    for (int i = n - 2; i >= 0; i--) {
        above = m[i].residual * FACTOR(i, PIVOT) - FACTOR(i, OFF) * above;
        m[i].correction = 0.0 + above;
    }
}

// Negative in lanes where a floor exceeds a peak.
INLINE void look(const struct ensemble_peaks *restrict p, const struct ensemble_state *restrict t,
                 const wide *ground, const wide *u_below, wide_bits *flags) {
    *flags |= UNDER(p->of[PEAK_DISPLACEMENT], t->u) | UNDER(p->of[PEAK_VELOCITY], t->v) |
              UNDER(p->of[PEAK_ACCELERATION], t->a + *ground) |
              UNDER(p->of[PEAK_DRIFT], t->u - *u_below);
}

// The state that the corrections of building k lead to, and whether it exceeds a peak.
INLINE void move(const struct ensemble_lanes *e, int k, const wide *ground,
                 const struct ensemble_motion *restrict m) {
    const int first = e->building[k].shape->first, n = e->building[k].shape->n_floor;
    const struct ensemble_peaks *restrict p = e->peak + first;
    const struct ensemble_state *restrict s = e->now + first;
    struct ensemble_state *restrict t = e->next + first;
    const wide none = {0.0};
    const wide b = e->b - none, g = e->g - none;
    wide_bits beyond = {0};
    wide u_below = none;
    for (int i = 0; i < n; i++) {
        const wide q = m[i].correction;
        const struct ensemble_state x = {m[i].u + b * q, m[i].v + g * q, s[i].a + q};
        t[i] = x;
        look(&p[i], &x, ground, &u_below, &beyond);
        u_below = x.u;
    }
    e->beyond[k] = beyond;
}

// The works of the ground and of damping on a building in the last step.
INLINE void account_held(const struct ensemble_lanes *e, const struct ensemble_building *b,
                         enum ensemble_held held) {
    const int first = b->shape->first, n = b->shape->n_floor;
    const double *restrict x = b->number;
    const struct ensemble_state *restrict s = e->next + first, *restrict t = e->now + first;
    struct ensemble_works *restrict w = e->works;
    const wide none = {0.0}, ground_2x = w->ground_2x;
    wide below = none, own = s[0].v + t[0].v;
    for (int i = 0; i < n; i++) {
        wide above = i + 1 < n ? s[i + 1].v + t[i + 1].v : none;
        wide du = t[i].u - s[i].u;
        w->input_2x[(first + i) % LANES_WIDTH] += ground_2x * (NUMBER(i, INERTIA) * du);
        w->damping_2x[(first + i) % LANES_WIDTH] +=
            du * (NUMBER(i, BELOW) * below + NUMBER(i, OWN) * own + NUMBER(i, ABOVE) * above);
        below = own;
        own = above;
    }
}

INLINE void account(const struct ensemble_lanes *e, const struct ensemble_building *b) {
    if (b->held == HELD_ONCE) {
        account_held(e, b, HELD_ONCE);
    } else {
        account_held(e, b, HELD_BY_EACH);
    }
}

// The last step of a building is accounted for while the next one has its numbers at hand.
INLINE void unbalance(const struct ensemble_lanes *e, const struct ensemble_building *b,
                      const wide *ground, struct ensemble_motion *m) {
    const struct ensemble_state *s = e->now + b->shape->first;
    if (e->owing) {
        account(e, b);
    }
    if (b->held == HELD_ONCE) {
        residuals(e, b->number, HELD_ONCE, s, ground, b->shape->n_floor, m);
    } else {
        residuals(e, b->number, HELD_BY_EACH, s, ground, b->shape->n_floor, m);
    }
}

INLINE void solve_held(const struct ensemble_building *b, enum ensemble_held held,
                       struct ensemble_motion *m) {
    if (b->inverse) {
        multiply(b->inverse, held, b->shape->n_floor, m);
    } else {
        substitute(b->factor, held, b->shape->n_floor, m);
    }
}

INLINE void solve(const struct ensemble_building *b, struct ensemble_motion *m) {
    if (b->held == HELD_ONCE) {
        solve_held(b, HELD_ONCE, m);
    } else {
        solve_held(b, HELD_BY_EACH, m);
    }
}

// Negative in lanes where a contact is nearer than ever or closed.
INLINE void penetrate(const struct ensemble_lanes *e, wide_bits *flags) {
    const struct ensemble_state *restrict t = e->next;
    for (int k = 0; k < e->n_contact; k++) {
        const struct ensemble_contact *c = &e->contact[k];
        *flags |= (wide_bits)(c->limit - (t[e->end[k][0]].u - t[e->end[k][1]].u - c->gap));
    }
}

INLINE void commit(struct ensemble_lanes *e, const wide *ground) {
    struct ensemble_state *old = e->now;
    e->works->ground_2x = e->works->ground + *ground;
    e->works->ground = *ground;
    e->now = e->next;
    e->next = old;
    e->owing = true;
}

// Computes `next`.
INLINE void step(struct ensemble_lanes *e, const wide *ground, wide_bits *flags) {
    const struct ensemble_building *b = e->building;
    for (int first = 0; first < e->n_building; first += TOGETHER) {
        const int end = first + TOGETHER < e->n_building ? first + TOGETHER : e->n_building;
        struct ensemble_motion *m = e->motion;
        for (int k = first; k < end; k++) {
            unbalance(e, &b[k], ground, m + b[k].shape->first);
        }
        for (int k = first; k < end; k++) {
            solve(&b[k], m + b[k].shape->first);
        }
        for (int k = first; k < end; k++) {
            move(e, k, ground, m + b[k].shape->first);
            *flags |= e->beyond[k];
        }
    }
    e->owing = false;
    penetrate(e, flags);
}

LANES int ensemble_march(struct ensemble_lanes *e, const wide *base, int n) {
    for (int i = 0; i < n; i++) {
        wide_bits flags = {0};
        step(e, base + i, &flags);
        if (ensemble_any(e, &flags)) {
            return i;
        }
        commit(e, base + i);
    }
    return n;
}

LANES void ensemble_unbalance(struct ensemble_lanes *e, const wide *base) {
    for (int k = 0; k < e->n_building; k++) {
        unbalance(e, &e->building[k], base, e->motion + e->building[k].shape->first);
    }
    e->owing = false;
}

LANES void ensemble_move(struct ensemble_lanes *e, const wide *base) {
    for (int k = 0; k < e->n_building; k++) {
        struct ensemble_motion *m = e->motion + e->building[k].shape->first;
        solve(&e->building[k], m);
        move(e, k, base, m);
    }
}

LANES void ensemble_move_pushed(struct ensemble_lanes *e, const wide *base) {
    for (int k = 0; k < e->n_building; k++) {
        if (e->building[k].pushed) {
            e->building[k].pushed = false;
            move(e, k, base, e->motion + e->building[k].shape->first);
        }
    }
}

LANES void ensemble_commit(struct ensemble_lanes *e, const wide *base) {
    commit(e, base);
}

LANES void ensemble_settle(struct ensemble_lanes *e) {
    for (int k = 0; e->owing && k < e->n_building; k++) {
        account(e, &e->building[k]);
    }
    e->owing = false;
}
