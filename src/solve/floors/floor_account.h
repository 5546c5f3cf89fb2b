// SPDX-License-Identifier: GPL-3.0-or-later
// The loops over floors that take steps into works and peaks; see floor_loops.h.
#ifndef JOSTLE_FLOOR_ACCOUNT_H
#define JOSTLE_FLOOR_ACCOUNT_H

#include "solve/floors/floor_loops.h"

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

// Which of eight floors are asked for each peak of motion, and for that of drifts: negative ones.
struct floors_asked {
    lanes_wide_bits u, v, a, drift;
};

// Where |x| of eight values from i on is beyond its peak, the peak and its time.
LANES_INLINE void floors_raise(const struct floors_peaks *p, int quantity, int i, double time,
                               const lanes_wide *x, const lanes_wide_bits *asked) {
    double *peak = p->peak[quantity] + i, *when = p->time[quantity] + i;
    lanes_wide_bits beyond = (BEYOND_WIDE(*x, LANES_AT(peak, 0)) & *asked) >> 63;
    if (floors_any_wide(&beyond)) {
        *(lanes_wide *)peak = CHOOSE_WIDE(beyond, ABSOLUTE_WIDE(*x), LANES_AT(peak, 0));
        *(lanes_wide *)when = CHOOSE_WIDE(beyond, time - (lanes_wide){0.0}, LANES_AT(when, 0));
    }
}

// Takes the motion of eight floors into the peaks.
LANES_INLINE void floors_raise_motion(const struct floors_peaks *p, const struct floors_moment *s,
                                      int i, const struct floors_asked *asked) {
    lanes_wide u = LANES_AT(s->u, i), v = LANES_AT(s->v, i);
    lanes_wide total = LANES_AT(s->a, i) + s->ground;
    if (s->base) {
        total = LANES_AT(s->a, i) + LANES_AT(s->base, i);
    }
    floors_raise(p, PEAK_DISPLACEMENT, i, s->time, &u, &asked->u);
    floors_raise(p, PEAK_VELOCITY, i, s->time, &v, &asked->v);
    floors_raise(p, PEAK_ACCELERATION, i, s->time, &total, &asked->a);
}

LANES_INLINE void floors_drift(const struct chain *c, const double *u, int i, lanes_wide *drift) {
    *drift = LANES_AT(u, i) - LANES_AT(c->joint, i) * LANES_AT(u, i - 1);
}

// The same of drifts and shears. An elastic shear is beyond its peak only with its drift: k |drift|
// is rounded to no less for a greater drift.
LANES_INLINE void floors_raise_drifts(const struct floors_peaks *p, const struct chain *c,
                                      const struct floors_moment *s, int i,
                                      const struct floors_asked *asked) {
    lanes_wide drift;
    floors_drift(c, s->u, i, &drift);
    lanes_wide shear = LANES_AT(c->stiffness, i) * drift;
    if (s->shear) {
        shear = LANES_AT(s->shear, i);
    }
    floors_raise(p, PEAK_DRIFT, i, s->time, &drift, &asked->drift);
    floors_raise(p, PEAK_SHEAR, i, s->time, &shear, &asked->drift);
}

// A peak is the last of values that grow, so that it is stored once: negative where |x0| > peak and
// then |x1| <= |x0|.
#define TURNED_WIDE(x0, x1, peak) (BEYOND_WIDE(x0, peak) & ~BEYOND_WIDE(x1, ABSOLUTE_WIDE(x0)))

// Whether anything is beyond its peak is asked for so many floors at once, and what turns there
// only if something is.
enum { FLOORS_ASKED = 64 };

LANES_INLINE int floors_part(int i, int end) {
    return i + FLOORS_ASKED < end ? i + FLOORS_ASKED : end;
}

// Which displacements, velocities, total accelerations and drifts of eight floors turned in the
// step from s0 to s1.
LANES_INLINE void floors_turned(const struct chain *c, const struct floors_moment *s0,
                                const struct floors_moment *s1, const struct floors_peaks *p, int i,
                                struct floors_asked *turned) {
    lanes_wide a0 = LANES_AT(s0->a, i) + s0->ground, a1 = LANES_AT(s1->a, i) + s1->ground, d0, d1;
    floors_drift(c, s0->u, i, &d0);
    floors_drift(c, s1->u, i, &d1);
    turned->u = TURNED_WIDE(LANES_AT(s0->u, i), LANES_AT(s1->u, i),
                            LANES_AT(p->peak[PEAK_DISPLACEMENT], i));
    turned->v =
        TURNED_WIDE(LANES_AT(s0->v, i), LANES_AT(s1->v, i), LANES_AT(p->peak[PEAK_VELOCITY], i));
    turned->a = TURNED_WIDE(a0, a1, LANES_AT(p->peak[PEAK_ACCELERATION], i));
    turned->drift = TURNED_WIDE(d0, d1, LANES_AT(p->peak[PEAK_DRIFT], i));
}

// Takes what turned into the peaks, of FLOORS_ASKED floors at most. Often nothing has: what is
// beyond a peak is on its way to a higher one.
LANES_INLINE void floors_turn(const struct chain *c, int first, int end,
                              const struct floors_moment *s0, const struct floors_moment *s1,
                              const struct floors_peaks *p) {
    lanes_wide_bits any = {0}, either[FLOORS_ASKED / LANES_WIDTH];
    struct floors_asked turned;
    for (int i = first, k = 0; i < end; i += LANES_WIDTH, k++) {
        floors_turned(c, s0, s1, p, i, &turned);
        either[k] = turned.u | turned.v | turned.a | turned.drift;
        any |= either[k];
    }
    for (int i = first, k = 0; floors_any_wide(&any) && i < end; i += LANES_WIDTH, k++) {
        if (floors_any_wide(&either[k])) {
            floors_turned(c, s0, s1, p, i, &turned);
            floors_raise_motion(p, s0, i, &turned);
            floors_raise_drifts(p, c, s0, i, &turned);
        }
    }
}

// Takes what turned into the peaks of shears of storeys that may yield.
LANES_INLINE void floors_add_shears(int first, int end, const struct floors_moment *s0,
                                    const struct floors_moment *s1, const struct floors_peaks *p) {
    const double *peak = p->peak[PEAK_SHEAR];
    for (int i = first; i < end; i += LANES_WIDTH) {
        lanes_wide shear = LANES_AT(s0->shear, i);
        lanes_wide_bits turned = TURNED_WIDE(shear, LANES_AT(s1->shear, i), LANES_AT(peak, i));
        floors_raise(p, PEAK_SHEAR, i, s0->time, &shear, &turned);
    }
}

// The floors of a step under one ground, in copies of pointers.
struct floors_step {
    const double *u0, *v0, *a0, *u1, *v1;
    const double *peak_u, *peak_v, *peak_a, *peak_drift;
    double ground, ground_2x;
};

// What the works of a vector of floors need of the one below it and of itself.
struct floors_pair {
    floor_lanes u_under, v_under, v_own;  // twice the mean velocities
};

// Adds the works of vector j of whole lanes, from floor i on. *higher gets negative where something
// was beyond its peak when the step began.
LANES_INLINE void floors_add_vector(const struct chain *c, const struct floors_step *s, ptrdiff_t i,
                                    ptrdiff_t j, struct floors_pair *p, struct floors_works *works,
                                    floor_bits *higher) {
    const floor_lanes u = FLOORS_AT(s->u0, i), moved = FLOORS_AT(s->u1, i) - u;
    const floor_lanes v_over =
        FLOORS_AT(s->v0, i + FLOORS_VECTOR) + FLOORS_AT(s->v1, i + FLOORS_VECTOR);
    works->input[j] -= WORK_OF_GROUND(s->ground_2x, FLOORS_AT(c->mass, i), moved);
    works->damping[j] +=
        WORK_OF_DAMPING(moved, BANDS(FLOORS_AT(c->damping_below, i), BELOW(p->v_under, p->v_own),
                                     FLOORS_AT(c->damping, i), p->v_own,
                                     FLOORS_AT(c->damping_below, i + 1), ABOVE(p->v_own, v_over)));
    const floor_lanes drift = u - FLOORS_AT(c->joint, i) * BELOW(p->u_under, u);
    *higher |= BEYOND(u, FLOORS_AT(s->peak_u, i)) |
               BEYOND(FLOORS_AT(s->v0, i), FLOORS_AT(s->peak_v, i)) |
               BEYOND(FLOORS_AT(s->a0, i) + s->ground, FLOORS_AT(s->peak_a, i)) |
               BEYOND(drift, FLOORS_AT(s->peak_drift, i));
    *p = (struct floors_pair){u, p->v_own, v_over};
}

// Adds the works of the floors from `first` to `end`, and takes what was highest at the start of
// the step from s0 to s1, under one ground, into the peaks.
LANES_INLINE void floors_add(const struct chain *c, int first, int end,
                             const struct floors_moment *s0, const struct floors_moment *s1,
                             const struct floors_peaks *p, struct energy_account *account) {
    const struct floors_step s = {s0->u,
                                  s0->v,
                                  s0->a,
                                  s1->u,
                                  s1->v,
                                  p->peak[PEAK_DISPLACEMENT],
                                  p->peak[PEAK_VELOCITY],
                                  p->peak[PEAK_ACCELERATION],
                                  p->peak[PEAK_DRIFT],
                                  s0->ground,
                                  s0->ground + s1->ground};
    const int under = first - FLOORS_VECTOR;
    struct floors_pair pair = {FLOORS_AT(s.u0, under),
                               FLOORS_AT(s.v0, under) + FLOORS_AT(s.v1, under),
                               FLOORS_AT(s.v0, first) + FLOORS_AT(s.v1, first)};
    struct floors_works works;
    floors_load_works(account, &works);
    for (int part = first; part < end; part = floors_part(part, end)) {
        floor_bits higher = {0};
        for (int i = part; i < floors_part(part, end); i += LANES_WIDTH) {
            EACH_OF_LANES(j) {
                floors_add_vector(c, &s, i + j * FLOORS_VECTOR, j, &pair, &works, &higher);
            }
        }
        if (floors_any(&higher)) {
            floors_turn(c, part, floors_part(part, end), s0, s1, p);
        }
    }
    floors_store_works(&works, account);
}

#endif
