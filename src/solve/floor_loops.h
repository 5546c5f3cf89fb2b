// SPDX-License-Identifier: GPL-3.0-or-later
// The loops over floors of which steps are made, for functions compiled by LANES. Arrays are those
// of core/lanes.h; first, n and `end` are whole lanes.
//
// A load that spans two stores made just before waits until both are in the cache, so neighbours'
// values are read by another loop than the one that writes them.
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
#define LOWER_HALF(x) __builtin_shufflevector(x, x, 0, 1, 2, 3)
#define UPPER_HALF(x) __builtin_shufflevector(x, x, 4, 5, 6, 7)
#else
#define BELOW(under, own) ((lanes){(under)[3], (own)[0], (own)[1], (own)[2]})
#define ABOVE(own, over) ((lanes){(own)[1], (own)[2], (own)[3], (over)[0]})
#define LOWER_HALF(x) ((lanes_bits){(x)[0], (x)[1], (x)[2], (x)[3]})
#define UPPER_HALF(x) ((lanes_bits){(x)[4], (x)[5], (x)[6], (x)[7]})
#endif

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

LANES_INLINE struct floors_lines floors_lines_of(const struct flight *f, const struct state *s) {
    return (struct floors_lines){
        f->back, f->spring, f->rest, f->limit, f->results->peak[PEAK_SHEAR], s->drift, s->shear};
}

// Shears of the storeys below four floors: elastic ones, or where `lines` is not NULL, of the lines
// they are on. *beyond gets negative if one is beyond its line.
LANES_INLINE void floors_shear(const struct chain *c, const struct floors_lines *lines, ptrdiff_t i,
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
        lanes p = mass * -ground;
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

LANES_INLINE int64_t floors_any_wide(const lanes_wide_bits *sign) {
    const lanes_bits either = LOWER_HALF(*sign) | UPPER_HALF(*sign);
    return floors_any(&either);
}

#define ABSOLUTE_WIDE(x) ((lanes_wide)((lanes_wide_bits)(x)&INT64_MAX))
#define BEYOND_WIDE(x, limit) ((lanes_wide_bits)(limit) - ((lanes_wide_bits)(x)&INT64_MAX))

// How corrections lead to a state: q (n_dof), beta h^2, gamma h and h.
struct floors_correction {
    const double *q;
    double b, g, h;
};

// Stores what corrections lead to. Negative if that is not finite.
LANES_INLINE int64_t floors_correct(const struct floors_correction *k, int first, int end,
                                    const struct floors_of *now, const struct floors_of *next) {
    const lanes_wide most = DBL_MAX - (lanes_wide){0.0};
    const double *q = k->q, *u0 = now->u, *v0 = now->v, *a0 = now->a;
    double *next_u = next->u, *next_v = next->v, *next_a = next->a;
    const double b = k->b, g = k->g, h = k->h, half = k->h * k->h / 2.0;
    lanes_wide_bits sign = {0};
    for (int i = first; i < end; i += LANES_WIDTH) {
        lanes_wide u =
            LANES_AT(u0, i) + (h * LANES_AT(v0, i) + half * LANES_AT(a0, i)) + b * LANES_AT(q, i);
        lanes_wide v = LANES_AT(v0, i) + h * LANES_AT(a0, i) + g * LANES_AT(q, i);
        lanes_wide a = LANES_AT(a0, i) + LANES_AT(q, i);
        *(lanes_wide *)(next_u + i) = u;
        *(lanes_wide *)(next_v + i) = v;
        *(lanes_wide *)(next_a + i) = a;
        lanes_wide size = ABSOLUTE_WIDE(u) + ABSOLUTE_WIDE(v) + ABSOLUTE_WIDE(a);
        sign |= BEYOND_WIDE(size, most);
    }
    return floors_any_wide(&sign);
}

// What there is of the floors at one time. `base` NULL: the acceleration of the ground is that of
// all floors; `shear` NULL: all storeys are elastic.
struct floors_moment {
    double time, ground;
    const double *u, *v, *a, *base, *shear;
};

LANES_INLINE struct floors_moment floors_moment_of(const struct model *m, const struct state *s) {
    return (struct floors_moment){.time = s->time,
                                  .ground = s->ground_a[0],
                                  .u = s->u,
                                  .v = s->v,
                                  .a = s->a,
                                  .base = state_is_uniform(m) ? NULL : s->base,
                                  .shear = m->n_storey_history > 0 ? s->shear : NULL};
}

// The largest values so far, and when.
struct floors_peaks {
    double *const *peak, *const *time;  // by enum peak
};

#define CHOOSE_WIDE(mask, x, y)                                                                    \
    ((lanes_wide)(((mask) & (lanes_wide_bits)(x)) | (~(mask) & (lanes_wide_bits)(y))))

// Where |x| of eight values from i on is beyond its peak, the peak and its time.
LANES_INLINE void floors_raise(const struct floors_peaks *p, int quantity, int i, double time,
                               const lanes_wide *x) {
    double *peak = p->peak[quantity] + i, *when = p->time[quantity] + i;
    lanes_wide_bits beyond = BEYOND_WIDE(*x, LANES_AT(peak, 0)) >> 63;
    if (floors_any_wide(&beyond) < 0) {
        *(lanes_wide *)peak = CHOOSE_WIDE(beyond, ABSOLUTE_WIDE(*x), LANES_AT(peak, 0));
        *(lanes_wide *)when = CHOOSE_WIDE(beyond, time - (lanes_wide){0.0}, LANES_AT(when, 0));
    }
}

// Takes the motion of eight floors into the peaks.
LANES_INLINE void floors_raise_motion(const struct floors_peaks *p, const struct floors_moment *s,
                                      int i) {
    lanes_wide u = LANES_AT(s->u, i), v = LANES_AT(s->v, i);
    lanes_wide total = LANES_AT(s->a, i) + s->ground;
    if (s->base) {
        total = LANES_AT(s->a, i) + LANES_AT(s->base, i);
    }
    floors_raise(p, PEAK_DISPLACEMENT, i, s->time, &u);
    floors_raise(p, PEAK_VELOCITY, i, s->time, &v);
    floors_raise(p, PEAK_ACCELERATION, i, s->time, &total);
}

LANES_INLINE void floors_drift(const struct chain *c, const double *u, int i, lanes_wide *drift) {
    *drift = LANES_AT(u, i) - LANES_AT(c->joint, i) * LANES_AT(u, i - 1);
}

// The same of drifts and shears. An elastic shear is beyond its peak only with its drift: k |drift|
// is rounded to no less for a greater drift.
LANES_INLINE void floors_raise_drifts(const struct floors_peaks *p, const struct chain *c,
                                      const struct floors_moment *s, int i) {
    lanes_wide drift;
    floors_drift(c, s->u, i, &drift);
    lanes_wide shear = LANES_AT(c->stiffness, i) * drift;
    if (s->shear) {
        shear = LANES_AT(s->shear, i);
    }
    floors_raise(p, PEAK_DRIFT, i, s->time, &drift);
    floors_raise(p, PEAK_SHEAR, i, s->time, &shear);
}

// A peak is the last of values that grow, so that it is stored once: negative where |x0| > peak and
// then |x1| <= |x0|.
#define TURNED_WIDE(x0, x1, peak) (BEYOND_WIDE(x0, peak) & ~BEYOND_WIDE(x1, ABSOLUTE_WIDE(x0)))

// Whether anything is beyond its peak is asked for so many floors at once, and what turns there
// only if something is.
enum { FLOORS_ASKED = 64 };

LANES_INLINE int floors_asked(int i, int end) {
    return i + FLOORS_ASKED < end ? i + FLOORS_ASKED : end;
}

// Takes what turned in a step from s0 to s1 into the peaks of motion.
LANES_INLINE void floors_turn_motion(int first, int end, const struct floors_moment *s0,
                                     const struct floors_moment *s1, const struct floors_peaks *p) {
    const double *peak_u = p->peak[PEAK_DISPLACEMENT], *peak_v = p->peak[PEAK_VELOCITY];
    const double *peak_a = p->peak[PEAK_ACCELERATION];
    for (int i = first; i < end; i += LANES_WIDTH) {
        lanes_wide a0 = LANES_AT(s0->a, i) + s0->ground, a1 = LANES_AT(s1->a, i) + s1->ground;
        lanes_wide_bits turned =
            TURNED_WIDE(LANES_AT(s0->u, i), LANES_AT(s1->u, i), LANES_AT(peak_u, i)) |
            TURNED_WIDE(LANES_AT(s0->v, i), LANES_AT(s1->v, i), LANES_AT(peak_v, i)) |
            TURNED_WIDE(a0, a1, LANES_AT(peak_a, i));
        if (floors_any_wide(&turned) < 0) {
            floors_raise_motion(p, s0, i);
        }
    }
}

// Takes displacements, velocities and total accelerations that were highest at the start of a step
// from s0 to s1, under one ground, into the peaks.
LANES_INLINE void floors_add_peaks(int first, int end, const struct floors_moment *s0,
                                   const struct floors_moment *s1, const struct floors_peaks *p) {
    const double *peak_u = p->peak[PEAK_DISPLACEMENT], *peak_v = p->peak[PEAK_VELOCITY];
    const double *peak_a = p->peak[PEAK_ACCELERATION];
    for (int part = first; part < end; part = floors_asked(part, end)) {
        lanes_wide_bits higher = {0};
        for (int i = part; i < floors_asked(part, end); i += LANES_WIDTH) {
            higher |= BEYOND_WIDE(LANES_AT(s0->u, i), LANES_AT(peak_u, i)) |
                      BEYOND_WIDE(LANES_AT(s0->v, i), LANES_AT(peak_v, i)) |
                      BEYOND_WIDE(LANES_AT(s0->a, i) + s0->ground, LANES_AT(peak_a, i));
        }
        if (floors_any_wide(&higher) < 0) {
            floors_turn_motion(part, floors_asked(part, end), s0, s1, p);
        }
    }
}

// The same of shears of storeys that may yield.
LANES_INLINE void floors_add_shears(int first, int end, const struct floors_moment *s0,
                                    const struct floors_moment *s1, const struct floors_peaks *p) {
    const double *peak = p->peak[PEAK_SHEAR];
    for (int i = first; i < end; i += LANES_WIDTH) {
        lanes_wide shear = LANES_AT(s0->shear, i);
        lanes_wide_bits turned = TURNED_WIDE(shear, LANES_AT(s1->shear, i), LANES_AT(peak, i));
        if (floors_any_wide(&turned) < 0) {
            floors_raise(p, PEAK_SHEAR, i, s0->time, &shear);
        }
    }
}

// Takes what turned into the peaks of drifts and shears.
LANES_INLINE void floors_turn_drifts(const struct chain *c, int first, int end,
                                     const struct floors_moment *s0, const struct floors_moment *s1,
                                     const struct floors_peaks *p) {
    const double *peak = p->peak[PEAK_DRIFT];
    for (int i = first; i < end; i += LANES_WIDTH) {
        lanes_wide d0, d1;
        floors_drift(c, s0->u, i, &d0);
        floors_drift(c, s1->u, i, &d1);
        lanes_wide_bits turned = TURNED_WIDE(d0, d1, LANES_AT(peak, i));
        if (floors_any_wide(&turned) < 0) {
            floors_raise_drifts(p, c, s0, i);
        }
    }
}

// Adds the works of the floors from `first` to `end`. The same of drifts.
LANES_INLINE void floors_add_works(const struct chain *c, int first, int end,
                                   const struct floors_moment *s0, const struct floors_moment *s1,
                                   const struct floors_peaks *p, struct energy_account *account) {
    const double ground_2x = s0->ground + s1->ground, *peak = p->peak[PEAK_DRIFT];
    lanes_wide input = LANES_AT(account->input_2x, 0), damping = LANES_AT(account->damping_2x, 0);
    for (int part = first; part < end; part = floors_asked(part, end)) {
        lanes_wide_bits higher = {0};
        for (int i = part; i < floors_asked(part, end); i += LANES_WIDTH) {
            lanes_wide drift;
            floors_input(c, i, ground_2x, s0->u, s1->u, &input);
            floors_damped(c, i, s0->u, s1->u, s0->v, s1->v, &damping);
            floors_drift(c, s0->u, i, &drift);
            higher |= BEYOND_WIDE(drift, LANES_AT(peak, i));
        }
        if (floors_any_wide(&higher) < 0) {
            floors_turn_drifts(c, part, floors_asked(part, end), s0, s1, p);
        }
    }
    *(lanes_wide *)account->input_2x = input;
    *(lanes_wide *)account->damping_2x = damping;
}

// Drifts and shears at the end of the step of storeys that follow lines. *beyond gets negative if
// one is beyond its line.
LANES_INLINE void floors_follow(const struct chain *c, const struct floors_lines *lines, int first,
                                int end, const double *u, lanes_bits *beyond) {
    lanes under = FOUR(u, first - LANES_VECTOR);
    for (int i = first; i < end; i += LANES_VECTOR) {
        lanes own = FOUR(u, i), shear;
        lanes drift = own - FOUR(c->joint, i) * BELOW(under, own);
        floors_shear(c, lines, i, &drift, &shear, beyond);
        *(lanes *)(lines->drift + i) = drift;
        *(lanes *)(lines->shear + i) = shear;
        under = own;
    }
}

// Penetrations of four contacts of a group, from number i on.
LANES_INLINE void floors_delta(const struct gap_group *g, int i, const double *gap, const double *u,
                               const double *ground, lanes *delta) {
    *delta = FOUR(u + g->dof[0], i) - FOUR(u + g->dof[1], i) - FOUR(gap, i) +
             (ground[g->ground[0]] - ground[g->ground[1]]);
}

// Notes the penetrations of some groups that are larger than ever.
LANES_INLINE void floors_note(const struct flight *f, int from, int to, const struct state *s) {
    for (int j = from; j < to; j++) {
        const double *gap = f->gap + (ptrdiff_t)j * LANES_WIDTH;
        for (int i = 0; i < LANES_WIDTH; i += LANES_VECTOR) {
            lanes d;
            floors_delta(&f->group[j], i, gap, s->u, s->ground_u, &d);
            for (int lane = 0; lane < LANES_VECTOR; lane++) {
                gaps_note(&f->work->gaps, f->group[j].contact + i + lane, d[lane], s->time);
            }
        }
    }
}

// Negative if one of some groups of contacts is closed at the end of a step. Those that were
// nearest at its start are noted, as peaks are.
LANES_INLINE int64_t floors_approach(const struct flight *f, int from, int to,
                                     const struct state *now, const struct state *next) {
    const double *gap = f->gap + (ptrdiff_t)from * LANES_WIDTH, *nearest = f->work->gaps.nearest;
    const double *u0 = now->u, *u1 = next->u;
    lanes_bits closed = {0}, turned = {0};
    for (const struct gap_group *g = f->group + from; g < f->group + to; g++, gap += LANES_WIDTH) {
        for (int i = 0; i < LANES_WIDTH; i += LANES_VECTOR) {
            lanes d0, d1;
            floors_delta(g, i, gap, u0, now->ground_u, &d0);
            floors_delta(g, i, gap, u1, next->ground_u, &d1);
            closed |= (lanes_bits)(0.0 - d1);
            turned |= (lanes_bits)(FOUR(nearest + g->contact, i) - d0) & ~(lanes_bits)(d0 - d1);
        }
    }
    if (floors_any(&turned) < 0) {
        floors_note(f, from, to, now);
    }
    return floors_any(&closed);
}

#endif
