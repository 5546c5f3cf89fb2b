// SPDX-License-Identifier: GPL-3.0-or-later
// The loops over floors of which steps are made, on the vectors of floor_vectors.h. Arrays are
// those of core/lanes.h; first, n and `end` are whole lanes.
#ifndef JOSTLE_FLOOR_LOOPS_H
#define JOSTLE_FLOOR_LOOPS_H

#include <float.h>
#include <math.h>
#include <stddef.h>

#include "core/number.h"
#include "solve/floors/floor_terms.h"
#include "solve/floors/floor_vectors.h"
#include "solve/newmark/flight.h"

// Copies of pointers: what is stored may be anything, so that those behind a pointer would be read
// again after each store.
struct floors_motion {
    double *u, *v, *a;
};

LANES_INLINE struct floors_motion floors_motion(const struct state *s) {
    return (struct floors_motion){s->u, s->v, s->a};
}

// The lines that storeys follow, and the drifts and shears at the end of the step.
struct floors_lines {
    const double *back, *spring, *rest, *limit, *peak;
    double *drift, *shear;
};

LANES_INLINE struct floors_lines floors_lines_of(const struct flight *f, const struct state *s) {
    return (struct floors_lines){
        f->back,  f->spring, f->rest, f->limit, f->account->results->peak[PEAK_SHEAR],
        s->drift, s->shear};
}

// Shears of the storeys below a vector of floors: elastic ones, or where `lines` is not NULL, of
// the lines they are on. *beyond gets negative if one is beyond its line.
LANES_INLINE void floors_shear(const struct chain *c, const struct floors_lines *lines, ptrdiff_t i,
                               const floor_lanes *drift, floor_lanes *shear, floor_bits *beyond) {
    if (!lines) {
        *shear = FLOORS_AT(c->stiffness, i) * *drift;
        return;
    }
    floor_lanes force = LINE_FORCE(FLOORS_AT(lines->spring, i), FLOORS_AT(lines->rest, i), *drift);
    *beyond |= BEYOND(force, FLOORS_AT(lines->limit, i));
    *shear = LINE_SHEAR(FLOORS_AT(lines->back, i), *drift, force);
}

// A vector of floors at the end of the step if the accelerations stay.
struct floors_trial {
    floor_lanes u, v, shear;
};

LANES_INLINE void floors_predict(const struct floors_motion *now, double h, int i, floor_lanes *u,
                                 floor_lanes *v) {
    double half = h * h / 2.0;
    *u = TRIAL_U(FLOORS_AT(now->u, i), FLOORS_AT(now->v, i), FLOORS_AT(now->a, i), h, half);
    *v = TRIAL_V(FLOORS_AT(now->v, i), FLOORS_AT(now->a, i), h);
}

LANES_INLINE void floors_try(const struct chain *c, const struct floors_lines *lines,
                             const struct floors_motion *now, double h, int i,
                             const floor_lanes *under, struct floors_trial *t, floor_bits *beyond) {
    floors_predict(now, h, i, &t->u, &t->v);
    floor_lanes drift = t->u - FLOORS_AT(c->joint, i) * BELOW(*under, t->u);
    floors_shear(c, lines, i, &drift, &t->shear, beyond);
}

// What a block leaves behind for its correction, from its first floor on.
struct floors_scratch {
    double *residual, *u, *v;  // [F]; the trial
};

// residual = p - M a - C v - storey shears of n floors, at the trial. True if a storey is
// beyond its line. `external` NULL: p is that of the acceleration of the ground.
LANES_INLINE bool floors_unbalance(const struct chain *c, const struct floors_lines *lines,
                                   double h, int first, int n, const struct floors_motion *now,
                                   double ground, const double *external,
                                   const struct floors_scratch *to) {
    floor_bits beyond = {0};
    struct floors_trial under, own, over;
    floors_predict(now, h, first - FLOORS_VECTOR, &under.u, &under.v);
    floors_try(c, lines, now, h, first, &under.u, &own, &beyond);
    for (int i = first; i < first + n; i += FLOORS_VECTOR) {
        floors_try(c, lines, now, h, i + FLOORS_VECTOR, &own.u, &over, &beyond);
        floor_lanes mass = FLOORS_AT(c->mass, i);
        floor_lanes p = mass * -ground;
        if (external) {
            p = FLOORS_AT(external, i);
        }
        floor_lanes damping =
            BANDS(FLOORS_AT(c->damping_below, i), BELOW(under.v, own.v), FLOORS_AT(c->damping, i),
                  own.v, FLOORS_AT(c->damping_below, i + 1), ABOVE(own.v, over.v));
        const ptrdiff_t j = i - first;
        *(floor_lanes *)(to->residual + j) =
            RESIDUAL(p - mass * FLOORS_AT(now->a, i), damping, own.shear,
                     FLOORS_AT(c->joint, i + 1) * ABOVE(own.shear, over.shear));
        *(floor_lanes *)(to->u + j) = own.u;
        *(floor_lanes *)(to->v + j) = own.v;
        under = own;
        own = over;
    }
    return floors_any(&beyond);
}

#define ABSOLUTE_WIDE(x) ((lanes_wide)((lanes_wide_bits)(x)&INT64_MAX))
#define BEYOND_WIDE(x, limit) ((lanes_wide_bits)(limit) - ((lanes_wide_bits)(x)&INT64_MAX))

// How corrections lead to a state: q of a block, from its first floor on, beta h^2 and gamma h.
struct floors_correction {
    const double *q;
    double b, g;
};

// Stores what corrections lead to from the trial. True if that is not finite, or next to it.
LANES_INLINE bool floors_reach(const struct floors_correction *k, int first, int end,
                               const struct floors_scratch *trial, const double *restrict a0,
                               const struct floors_motion *next) {
    const floor_lanes most = DBL_MAX - (floor_lanes){0.0};
    const double *q = k->q, *u_t = trial->u, *v_t = trial->v;
    double *next_u = next->u + first, *next_v = next->v + first, *next_a = next->a + first;
    const double b = k->b, g = k->g;
    floor_lanes sum = {0.0};
    for (int i = 0; i < end - first; i += FLOORS_VECTOR) {
        floor_lanes u = END(FLOORS_AT(u_t, i), b, FLOORS_AT(q, i));
        floor_lanes v = END(FLOORS_AT(v_t, i), g, FLOORS_AT(q, i));
        floor_lanes a = FLOORS_AT(a0, first + i) + FLOORS_AT(q, i);
        *(floor_lanes *)(next_u + i) = u;
        *(floor_lanes *)(next_v + i) = v;
        *(floor_lanes *)(next_a + i) = a;
        sum += u + v + a;
    }
    const floor_bits beyond = BEYOND(sum, most);
    return floors_any(&beyond);
}

// Drifts and shears at the end of the step of storeys that follow lines. *beyond gets negative if
// one is beyond its line.
LANES_INLINE void floors_follow(const struct chain *c, const struct floors_lines *lines, int first,
                                int end, const double *u, floor_bits *beyond) {
    floor_lanes under = FLOORS_AT(u, first - FLOORS_VECTOR);
    for (int i = first; i < end; i += FLOORS_VECTOR) {
        floor_lanes own = FLOORS_AT(u, i), shear;
        floor_lanes drift = own - FLOORS_AT(c->joint, i) * BELOW(under, own);
        floors_shear(c, lines, i, &drift, &shear, beyond);
        *(floor_lanes *)(lines->drift + i) = drift;
        *(floor_lanes *)(lines->shear + i) = shear;
        under = own;
    }
}

// Twice the works of the ground and of damping; floor i % LANES_WIDTH counts.
struct floors_works {
    floor_lanes input[FLOORS_VECTORS], damping[FLOORS_VECTORS];
};

LANES_INLINE void floors_load_works(const struct energy_account *a, struct floors_works *w) {
    EACH_OF_LANES(j) {
        w->input[j] = FLOORS_AT(a->input_2x, j * FLOORS_VECTOR);
        w->damping[j] = FLOORS_AT(a->damping_2x, j * FLOORS_VECTOR);
    }
}

LANES_INLINE void floors_store_works(const struct floors_works *w, struct energy_account *a) {
    EACH_OF_LANES(j) {
        *(floor_lanes *)(a->input_2x + j * FLOORS_VECTOR) = w->input[j];
        *(floor_lanes *)(a->damping_2x + j * FLOORS_VECTOR) = w->damping[j];
    }
}

// Penetrations of a vector of contacts of a group, from number i on.
LANES_INLINE void floors_delta(const struct gap_group *g, ptrdiff_t i, const double *gap,
                               const double *u, const double *ground, floor_lanes *delta) {
    const int left = g->ground[0], right = g->ground[1];
    *delta = FLOORS_AT(u + g->dof[0], i) - FLOORS_AT(u + g->dof[1], i) - FLOORS_AT(gap, i);
    if (left != right) {
        *delta += ground[left] - ground[right];
    }
}

// Notes the penetrations of some groups that are larger than ever.
LANES_INLINE void floors_note(const struct flight *f, int from, int to, const struct state *s) {
    const double *gap = f->gap + (ptrdiff_t)from * LANES_WIDTH;
    struct gaps *gaps = &f->work->gaps;
    for (const struct gap_group *g = f->group + from; g < f->group + to; g++, gap += LANES_WIDTH) {
        for (int i = 0; i < LANES_WIDTH; i += FLOORS_VECTOR) {
            floor_lanes d;
            floors_delta(g, i, gap, s->u, s->ground_u, &d);
            const floor_bits larger = (floor_bits)(FLOORS_AT(gaps->nearest + g->contact, i) - d);
            for (int k = 0; floors_any(&larger) && k < FLOORS_VECTOR; k++) {
                gaps_note(gaps, g->contact + i + k, d[k], s->time);
            }
        }
    }
}

// True if one of some groups of contacts is closed at the end of a step. Those that were
// nearest at its start are noted, as peaks are.
LANES_INLINE bool floors_approach(const struct flight *f, int from, int to, const struct state *now,
                                  const struct state *next) {
    const double *gap = f->gap + (ptrdiff_t)from * LANES_WIDTH, *nearest = f->work->gaps.nearest;
    const double *u0 = now->u, *u1 = next->u;
    floor_bits closed = {0}, turned = {0};
    for (const struct gap_group *g = f->group + from; g < f->group + to; g++, gap += LANES_WIDTH) {
        EACH_OF_LANES(j) {
            const ptrdiff_t i = j * FLOORS_VECTOR;
            floor_lanes d0, d1;
            floors_delta(g, i, gap, u0, now->ground_u, &d0);
            floors_delta(g, i, gap, u1, next->ground_u, &d1);
            closed |= (floor_bits)(0.0 - d1);
            turned |=
                (floor_bits)(FLOORS_AT(nearest + g->contact, i) - d0) & ~(floor_bits)(d0 - d1);
        }
    }
    if (floors_any(&turned)) {
        floors_note(f, from, to, now);
    }
    return floors_any(&closed);
}

#endif
