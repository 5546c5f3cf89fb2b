// SPDX-License-Identifier: GPL-3.0-or-later
// The loops over floors of which steps are made, for functions compiled by LANES. Arrays are those
// of core/lanes.h; first, n and `end` are whole lanes.
//
// Neighbours' values are taken from registers, not from memory: a load that spans two stores made
// just before waits until both are in the cache. And what is cheap is computed twice rather than
// written and read.
#ifndef JOSTLE_FLOOR_LOOPS_H
#define JOSTLE_FLOOR_LOOPS_H

#include <float.h>
#include <math.h>
#include <stddef.h>

#include "core/number.h"
#include "solve/chain_floor.h"
#include "solve/flight.h"

// Four elements of an array from i on.
#define FOUR(x, i) (*(const lanes *)((x) + (i)))

// Of four floors, those below each and above each; `under` and `over` are the four next to them.
#if defined(__has_builtin) && __has_builtin(__builtin_shufflevector)
#define BELOW(under, own) __builtin_shufflevector(under, own, 3, 4, 5, 6)
#define ABOVE(own, over) __builtin_shufflevector(own, over, 1, 2, 3, 4)
#else
#define BELOW(under, own) ((lanes){(under)[3], (own)[0], (own)[1], (own)[2]})
#define ABOVE(own, over) ((lanes){(own)[1], (own)[2], (own)[3], (over)[0]})
#endif

LANES_INLINE int floors_whole(int n) {
    return n & ~(LANES_WIDTH - 1);
}

// Negative where |x| > limit >= 0, as number_beyond.
#define BEYOND(x, limit) ((lanes_bits)(limit) - ((lanes_bits)(x)&INT64_MAX))

LANES_INLINE int64_t floors_any(const lanes_bits *sign) {
    return (*sign)[0] | (*sign)[1] | (*sign)[2] | (*sign)[3];
}

// Copies of pointers: what is stored may be anything, so that those behind a pointer would be read
// again after each store.
struct floors_of {
    double *u, *v, *a;
};

LANES_INLINE struct floors_of floors_of(const struct state *s) {
    return (struct floors_of){s->u, s->v, s->a};
}

// The lines that storeys follow, and the drifts and shears at the end of the step.
struct floors_lines {
    const double *back, *spring, *rest, *limit, *peak;
    double *drift, *shear;
};

// Shears of the storeys below four floors: elastic ones, or where `lines` is not NULL, of the lines
// they are on. *beyond gets negative if one is beyond its line.
LANES_INLINE void floors_shear(const struct chain *c, const struct floors_lines *lines, int i,
                               const lanes *drift, lanes *shear, lanes_bits *beyond) {
    if (!lines) {
        *shear = FOUR(c->stiffness, i) * *drift;
        return;
    }
    lanes force = FOUR(lines->spring, i) * (*drift - FOUR(lines->rest, i));
    *beyond |= BEYOND(force, FOUR(lines->limit, i));
    *shear = FOUR(lines->back, i) * *drift + force;
}

// Four floors at the end of the step if the accelerations stay.
struct floors_trial {
    lanes u, v, shear;
};

LANES_INLINE void floors_predict(const struct floors_of *now, double h, int i, lanes *u, lanes *v) {
    double half = h * h / 2.0;
    *u = FOUR(now->u, i) + (h * FOUR(now->v, i) + half * FOUR(now->a, i));
    *v = FOUR(now->v, i) + h * FOUR(now->a, i);
}

LANES_INLINE void floors_try(const struct chain *c, const struct floors_lines *lines,
                             const struct floors_of *now, double h, int i, const lanes *under,
                             struct floors_trial *t, lanes_bits *beyond) {
    floors_predict(now, h, i, &t->u, &t->v);
    lanes drift = t->u - FOUR(c->joint, i) * BELOW(*under, t->u);
    floors_shear(c, lines, i, &drift, &t->shear, beyond);
}

// residual (n) = p - M a - C v - storey shears of n floors, at the trial. Negative if a storey is
// beyond its line. `external` NULL: p is that of the acceleration of the ground.
LANES_INLINE int64_t floors_unbalance(const struct chain *c, const struct floors_lines *lines,
                                      double h, int first, int n, const struct floors_of *now,
                                      double ground, const double *external, double *residual) {
    lanes_bits beyond = {0};
    struct floors_trial under, own, over;
    floors_predict(now, h, first - LANES_VECTOR, &under.u, &under.v);
    floors_try(c, lines, now, h, first, &under.u, &own, &beyond);
    for (int i = first; i < first + n; i += LANES_VECTOR) {
        floors_try(c, lines, now, h, i + LANES_VECTOR, &own.u, &over, &beyond);
        lanes mass = FOUR(c->mass, i);
        lanes p = -mass * ground;
        if (external) {
            p = FOUR(external, i);
        }
        lanes damping = FOUR(c->damping_below, i) * BELOW(under.v, own.v) +
                        FOUR(c->damping, i) * own.v +
                        FOUR(c->damping_below, i + 1) * ABOVE(own.v, over.v);
        *(lanes *)(residual + (i - first)) = p - mass * FOUR(now->a, i) - damping - own.shear +
                                             FOUR(c->joint, i + 1) * ABOVE(own.shear, over.shear);
        under = own;
        own = over;
    }
    return floors_any(&beyond);
}

// How corrections lead to a state: q (n_dof), beta h^2, gamma h and h.
struct floors_correction {
    const double *q;
    double b, g, h;
};

// Stores what corrections lead to. Negative if that is not finite.
LANES_INLINE int64_t floors_correct(const struct floors_correction *k, int first, int end,
                                    const struct floors_of *now, const struct floors_of *next) {
    const double *u0 = now->u, *v0 = now->v, *a0 = now->a, *q = k->q;
    double *u = next->u, *v = next->v, *a = next->a;
    const double b = k->b, g = k->g, h = k->h, half = h * h / 2.0;
    int64_t sign = 0;
    LANES_LOOP
    for (int i = first, n = first + floors_whole(end - first); i < n; i++) {
        u[i] = u0[i] + (h * v0[i] + half * a0[i]) + b * q[i];
        v[i] = v0[i] + h * a0[i] + g * q[i];
        a[i] = a0[i] + q[i];
        sign |= number_beyond(fabs(u[i]) + fabs(v[i]) + fabs(a[i]), DBL_MAX);
    }
    return sign;
}

// Which of the quantities of floors may have peaks. The shear of an elastic storey has one only
// with its drift: k |drift| is rounded to no less for a greater drift.
enum floors_higher {
    FLOORS_MOTION = 1,  // displacements, velocities, total accelerations
    FLOORS_DRIFT = 2,   // drifts, shears
};

// Is a displacement, velocity or total acceleration greater than ever? `base` NULL: the
// acceleration of the ground is that of all floors.
LANES_INLINE unsigned floors_compare(int first, int end, const struct floors_of *s, double ground,
                                     const double *base, double *const peak[PEAK_COUNT]) {
    const double *peak_u = peak[PEAK_DISPLACEMENT], *peak_v = peak[PEAK_VELOCITY];
    const double *peak_a = peak[PEAK_ACCELERATION];
    const double *u = s->u, *v = s->v, *a = s->a;
    int64_t sign = 0;
    LANES_LOOP
    for (int i = first, n = first + floors_whole(end - first); i < n; i++) {
        sign |= number_beyond(u[i], peak_u[i]) | number_beyond(v[i], peak_v[i]) |
                number_beyond(a[i] + (base ? base[i] : ground), peak_a[i]);
    }
    return sign < 0 ? FLOORS_MOTION : 0;
}

// The same of what corrections lead to, which is stored.
LANES_INLINE unsigned floors_correct_and_compare(const struct floors_correction *k, int first,
                                                 int end, const struct floors_of *now,
                                                 const struct floors_of *next, double ground,
                                                 const double *base,
                                                 double *const peak[PEAK_COUNT]) {
    const double *peak_u = peak[PEAK_DISPLACEMENT], *peak_v = peak[PEAK_VELOCITY];
    const double *peak_a = peak[PEAK_ACCELERATION];
    const double *u0 = now->u, *v0 = now->v, *a0 = now->a, *q = k->q;
    double *u = next->u, *v = next->v, *a = next->a;
    const double b = k->b, g = k->g, h = k->h, half = h * h / 2.0;
    int64_t sign = 0;
    LANES_LOOP
    for (int i = first, n = first + floors_whole(end - first); i < n; i++) {
        u[i] = u0[i] + (h * v0[i] + half * a0[i]) + b * q[i];
        v[i] = v0[i] + h * a0[i] + g * q[i];
        a[i] = a0[i] + q[i];
        sign |= number_beyond(u[i], peak_u[i]) | number_beyond(v[i], peak_v[i]) |
                number_beyond(a[i] + (base ? base[i] : ground), peak_a[i]);
    }
    return sign < 0 ? FLOORS_MOTION : 0;
}

// Drifts and shears of storeys that follow lines, and whether these are beyond their lines or
// peaks.
LANES_INLINE void floors_follow(const struct chain *c, const struct floors_lines *lines, int i,
                                const lanes *drift, lanes_bits *beyond, lanes_bits *higher) {
    lanes shear;
    floors_shear(c, lines, i, drift, &shear, beyond);
    *higher |= BEYOND(shear, FOUR(lines->peak, i));
    *(lanes *)(lines->drift + i) = *drift;
    *(lanes *)(lines->shear + i) = shear;
}

LANES_INLINE void floors_exchange(lanes *x, lanes *y) {
    lanes old = *x;
    *x = *y;
    *y = old;
}

// Adds the works of the floors from `first` to `end` under ground accelerations whose sum is
// ground_2x. *beyond gets negative if a storey is beyond its line. Is a drift or shear greater than
// ever?
LANES_INLINE unsigned floors_add_works(const struct chain *c, const struct floors_lines *lines,
                                       int first, int end, const struct floors_of *now,
                                       const struct floors_of *next, double ground_2x,
                                       const double *peak, struct energy_account *account,
                                       lanes_bits *beyond) {
    lanes input = FOUR(account->input_2x, 0), damping = FOUR(account->damping_2x, 0);
    lanes other_input = FOUR(account->input_2x, LANES_VECTOR);
    lanes other_damping = FOUR(account->damping_2x, LANES_VECTOR);
    lanes_bits higher = {0};
    int before = first - LANES_VECTOR;
    lanes under = FOUR(next->u, before);
    lanes speed_under = FOUR(now->v, before) + FOUR(next->v, before);
    lanes speed = FOUR(now->v, first) + FOUR(next->v, first);
    for (int i = first; i < end; i += LANES_VECTOR) {
        lanes u = FOUR(next->u, i);
        lanes du = u - FOUR(now->u, i);
        lanes speed_over = FOUR(now->v, i + LANES_VECTOR) + FOUR(next->v, i + LANES_VECTOR);
        lanes drift = u - FOUR(c->joint, i) * BELOW(under, u);
        input -= ground_2x * (FOUR(c->mass, i) * du);
        damping += du * (FOUR(c->damping_below, i) * BELOW(speed_under, speed) +
                         FOUR(c->damping, i) * speed +
                         FOUR(c->damping_below, i + 1) * ABOVE(speed, speed_over));
        higher |= BEYOND(drift, FOUR(peak, i));
        if (lines) {
            floors_follow(c, lines, i, &drift, beyond, &higher);
        }
        under = u;
        speed_under = speed;
        speed = speed_over;
        floors_exchange(&input, &other_input);
        floors_exchange(&damping, &other_damping);
    }
    *(lanes *)account->input_2x = input;
    *(lanes *)account->damping_2x = damping;
    *(lanes *)(account->input_2x + LANES_VECTOR) = other_input;
    *(lanes *)(account->damping_2x + LANES_VECTOR) = other_damping;
    return floors_any(&higher) < 0 ? FLOORS_DRIFT : 0;
}

// How near have the contacts of some groups come: closed, or nearer than ever?
LANES_INLINE enum nearness floors_look(const struct flight *f, int from, int to, const double *u,
                                       const double *ground) {
    const double *gap = f->gap + (ptrdiff_t)from * LANES_WIDTH;
    lanes_bits closed = {0}, nearer = {0};
    for (const struct gap_group *g = f->group + from; g < f->group + to; g++) {
        const double *left = u + g->dof[0], *right = u + g->dof[1];
        const double *deepest = f->results->deepest + g->contact;
        double apart = ground[g->ground[0]] - ground[g->ground[1]];
        for (int i = 0; i < LANES_WIDTH; i += LANES_VECTOR, gap += LANES_VECTOR) {
            lanes delta = FOUR(left, i) - FOUR(right, i) - FOUR(gap, 0) + apart;
            closed |= (lanes_bits)(0.0 - delta);
            nearer |= (lanes_bits)(FOUR(deepest, i) - delta);
        }
    }
    return floors_any(&closed) < 0   ? NEARNESS_CLOSED
           : floors_any(&nearer) < 0 ? NEARNESS_DEEPEST
                                     : NEARNESS_FAR;
}

#endif
