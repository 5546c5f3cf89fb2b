// SPDX-License-Identifier: GPL-3.0-or-later
// The floors of a building in a step of all runs at once, by the arithmetic of floor_terms.h;
// storeys are elastic and one ground moves all. Each lane goes through the same operations in the
// same order as a run alone, so its bits are the same. What one floor needs of its neighbours is
// carried along in registers.
//
// Registers that hold only a part of the lanes take one part after the other: ensemble_whole.c and
// ensemble_half.c say what a `part` is, and `p` is the one in hand.
//
// As rounding is monotone, a shear exceeds its peak only if its drift does; so only drifts are
// compared.
#ifndef JOSTLE_ENSEMBLE_FLOORS_H
#define JOSTLE_ENSEMBLE_FLOORS_H

#include "solve/ensemble/ensemble_lanes.h"
#include "solve/floors/floor_terms.h"

enum { WIDTH = sizeof(part) / sizeof(double), PARTS = WIDE_RUNS / WIDTH };

// Part p of a value of all lanes, or of the flags of all.
#define WHICH (PARTS == 1 ? 0 : p)
#define PART(x) (((part *)&(x))[WHICH])
#define PART_OF(x) (((const part *)&(x))[WHICH])
#define FLAGS(x) (((part_bits *)&(x))[WHICH])

static const long long SIZE = 0x7fffffffffffffffLL;  // all bits but the sign

// Negative where |x| > peak.
#define UNDER(peak, x) ((part_bits)((peak) - (part)((part_bits)(x)&SIZE)))

// A number of floor i, in functions that have `x` and how it is `held`.
#define HELD(x, i)                                                                                 \
    (held == HELD_ONCE ? (part)((x)[i] - (part){0.0})                                              \
                       : (part)((const part *)((x) + (size_t)(i) * (size_t)WIDE_RUNS))[WHICH])
#define NUMBER(i, q) HELD(x, (i)*NUMBER_COUNT + NUMBER_##q)
#define FACTOR(i, q) HELD(x, (i)*FACTOR_COUNT + FACTOR_##q)

// Floors whose corrections are computed together, so that as many sums are under way at once; those
// left over at the end join the last group.
enum { ROWS = 4, ROWS_MOST = 2 * ROWS - 1 };
#define EACH_ROW(c, n) _Pragma("GCC unroll 8") for (int c = 0; c < (n); c++)

// A building that begins a step; the arrays are of its own floors.
struct beginning {
    const struct building *shape;
    const double *x;  // its numbers
    const struct ensemble_state *now, *old;
    struct ensemble_trial *trial;
    struct ensemble_works *works;
    part ground, ground_2x, h, half;
};

// What the residuals of the floors above and below need of one.
struct neighbour {
    part u, v, shear;  // at the trial, of the storey below
    part sum;          // of the velocities before and after the last step
};

// The works of the ground and of damping on floor i in the last step.
LANES_INLINE void account_floor(const struct beginning *g, enum ensemble_held held, int p, int i,
                                const part *below, const part *own, const part *above) {
    const double *x = g->x;
    const unsigned slot = (unsigned)(g->shape->first + i) % LANES_WIDTH;
    const part du = PART_OF(g->now[i].u) - PART_OF(g->old[i].u);
    PART(g->works->input_2x[slot]) += WORK_OF_GROUND(g->ground_2x, NUMBER(i, INERTIA), du);
    PART(g->works->damping_2x[slot]) += WORK_OF_DAMPING(
        du, BANDS(NUMBER(i, BELOW), *below, NUMBER(i, OWN), *own, NUMBER(i, ABOVE), *above));
}

// Where floor i would be at the end of the step if its acceleration stayed.
LANES_INLINE void try_floor(const struct beginning *g, int p, int i, part *u, part *v) {
    const struct ensemble_state *s = &g->now[i];
    *u = TRIAL_U(PART_OF(s->u), PART_OF(s->v), PART_OF(s->a), g->h, g->half);
    *v = TRIAL_V(PART_OF(s->v), PART_OF(s->a), g->h);
}

// Floor i at the trial, and its velocities for the account.
LANES_INLINE void predict_floor(const struct beginning *g, enum ensemble_held held, int p, int i,
                                const part *u_below, struct neighbour *own) {
    const double *x = g->x;
    try_floor(g, p, i, &own->u, &own->v);
    own->shear = NUMBER(i, STIFFNESS) * (own->u - *u_below);
    own->sum = PART_OF(g->old[i].v) + PART_OF(g->now[i].v);
}

// r = -m (a_ground + a) - C v_t - K u_t of floor i.
LANES_INLINE void begin_floor(const struct beginning *g, enum ensemble_held held, int p, int i,
                              const struct neighbour *below, const struct neighbour *own,
                              const struct neighbour *above) {
    const double *x = g->x;
    const part damping =
        BANDS(NUMBER(i, BELOW), below->v, NUMBER(i, OWN), own->v, NUMBER(i, ABOVE), above->v);
    const part p_ma = NUMBER(i, INERTIA) * g->ground + NUMBER(i, INERTIA) * PART_OF(g->now[i].a);
    const part residual = RESIDUAL(p_ma, damping, own->shear, above->shear);
    PART(g->trial[i].u) = own->u;
    PART(g->trial[i].v) = own->v;
    PART(g->trial[i].residual) = residual;
    account_floor(g, held, p, i, &below->sum, &own->sum, &above->sum);
}

// The trial, with its residuals. The last step is accounted for while the numbers are at hand.
LANES_INLINE void begin_floors(const struct beginning *g, enum ensemble_held held, int p) {
    const struct neighbour nothing = {{0.0}, {0.0}, {0.0}, {0.0}};
    const int top = g->shape->n_floor - 1;
    struct neighbour below = nothing, own = nothing, above = nothing;
    predict_floor(g, held, p, 0, &nothing.u, &own);
    for (int i = 0; i < top; i++) {
        predict_floor(g, held, p, i + 1, &own.u, &above);
        begin_floor(g, held, p, i, &below, &own, &above);
        below = own;
        own = above;
    }
    begin_floor(g, held, p, top, &below, &own, &nothing);
}

// Takes only the works of the last step into account.
LANES_INLINE void account_floors(const struct beginning *g, enum ensemble_held held, int p) {
    const part nothing = {0.0};
    const int top = g->shape->n_floor - 1;
    part below = nothing, own = PART_OF(g->old[0].v) + PART_OF(g->now[0].v);
    for (int i = 0; i < top; i++) {
        const part above = PART_OF(g->old[i + 1].v) + PART_OF(g->now[i + 1].v);
        account_floor(g, held, p, i, &below, &own, &above);
        below = own;
        own = above;
    }
    account_floor(g, held, p, top, &below, &own, &nothing);
}

LANES_INLINE struct beginning beginning_of(const struct ensemble_lanes *e,
                                           const struct ensemble_building *b, int p,
                                           const wide *ground, struct ensemble_trial *t) {
    const int first = b->shape->first;
    return (struct beginning){
        .shape = b->shape,
        .x = b->number,
        .now = e->now + first,
        .old = e->next + first,
        .trial = t,
        .works = e->works,
        .ground = PART_OF(*ground),
        .ground_2x = PART_OF(e->works->ground_2x),
        .h = PART_OF(e->factors->h),
        .half = PART_OF(e->factors->half),
    };
}

// A building that ends a step; arrays as above.
struct ending {
    const double *inverse, *factor;
    bool multiplies;  // by the inverse
    const struct ensemble_state *now;
    const struct ensemble_trial *trial;
    const struct ensemble_peaks *peak;
    struct ensemble_state *next;
    wide *correction;
    int n;
    part ground, b, g;
    part u_below;
    part_bits beyond;  // negative in lanes where a floor exceeds a peak
};

LANES_INLINE struct ending ending_of(const struct ensemble_lanes *e,
                                     const struct ensemble_building *b, int p, const wide *ground,
                                     const struct ensemble_trial *t) {
    const int first = b->shape->first;
    return (struct ending){
        .inverse = b->inverse,
        .factor = b->factor,
        .multiplies = b->multiplies,
        .now = e->now + first,
        .trial = t,
        .peak = e->peak + first,
        .next = e->next + first,
        .correction = e->correction + first,
        .n = b->shape->n_floor,
        .ground = PART_OF(*ground),
        .b = PART_OF(e->factors->b),
        .g = PART_OF(e->factors->g),
    };
}

// The state of floor i with its correction q, and whether it exceeds a peak.
LANES_INLINE void end_floor(struct ending *g, int p, int i, const part *u_trial,
                            const part *v_trial, const part *q) {
    const struct ensemble_peaks *peak = &g->peak[i];
    const part u = END(*u_trial, g->b, *q);
    const part v = END(*v_trial, g->g, *q);
    const part a = PART_OF(g->now[i].a) + *q;
    g->beyond = g->beyond | UNDER(PART_OF(peak->of[PEAK_DISPLACEMENT]), u) |
                UNDER(PART_OF(peak->of[PEAK_VELOCITY]), v);
    g->beyond = g->beyond | UNDER(PART_OF(peak->of[PEAK_ACCELERATION]), a + g->ground) |
                UNDER(PART_OF(peak->of[PEAK_DRIFT]), u - g->u_below);
    PART(g->next[i].u) = u;
    PART(g->next[i].v) = v;
    PART(g->next[i].a) = a;
    g->u_below = u;
}

// `count` floors from floor j on, by as many rows of the inverse, which is stored by columns.
LANES_INLINE void end_rows(struct ending *g, enum ensemble_held held, int p, int j, int count) {
    part q[ROWS_MOST];
    EACH_ROW(c, count) {
        q[c] = (part){0.0};
    }
    for (int i = 0, at = j; i < g->n; i++, at += g->n) {
        EACH_ROW(c, count) {
            q[c] += PART_OF(g->trial[i].residual) * HELD(g->inverse, at + c);
        }
    }
    EACH_ROW(c, count) {
        const struct ensemble_trial *t = &g->trial[j + c];
        PART(g->correction[j + c]) = q[c];
        end_floor(g, p, j + c, &PART_OF(t->u), &PART_OF(t->v), &q[c]);
    }
}

LANES_INLINE void multiply(struct ending *g, enum ensemble_held held, int p) {
    int j = 0;
    for (; j + ROWS_MOST < g->n; j += ROWS) {
        end_rows(g, held, p, j, ROWS);
    }
    switch (g->n - j) {
        case 1:
            end_rows(g, held, p, j, 1);
            break;
        case 2:
            end_rows(g, held, p, j, 2);
            break;
        case 3:
            end_rows(g, held, p, j, 3);
            break;
        case 4:
            end_rows(g, held, p, j, 4);
            break;
        case 5:
            end_rows(g, held, p, j, 5);
            break;
        case 6:
            end_rows(g, held, p, j, 6);
            break;
        default:
            end_rows(g, held, p, j, ROWS_MOST);
    }
}

// L D L^T, from the ground up and back.
LANES_INLINE void substitute(const struct ending *g, enum ensemble_held held, int p) {
    const double *x = g->factor;
    const int n = g->n;
    wide *q = g->correction;
    part below = PART_OF(g->trial[0].residual);
    PART(q[0]) = below;
    for (int i = 1; i < n; i++) {
        below = PART_OF(g->trial[i].residual) - FACTOR(i - 1, OFF) * below;
        PART(q[i]) = below;
    }
    part above = below * FACTOR(n - 1, PIVOT);
    PART(q[n - 1]) = 0.0 + above;
    for (int i = n - 2; i >= 0; i--) {
        above = PART(q[i]) * FACTOR(i, PIVOT) - FACTOR(i, OFF) * above;
        PART(q[i]) = 0.0 + above;
    }
}

// What the residuals lead to.
LANES_INLINE void end_floors(struct ending *g, enum ensemble_held held, int p) {
    if (g->multiplies) {
        multiply(g, held, p);
        return;
    }
    substitute(g, held, p);
    for (int i = 0; i < g->n; i++) {
        const struct ensemble_trial *t = &g->trial[i];
        end_floor(g, p, i, &PART_OF(t->u), &PART_OF(t->v), &PART_OF(g->correction[i]));
    }
}

#endif
