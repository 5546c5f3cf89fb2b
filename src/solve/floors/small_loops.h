// SPDX-License-Identifier: GPL-3.0-or-later
// The loops of small_steps.h, made of the terms of floor_terms.h, over all floors at once and in
// registers. Only the residuals are stored, as each floor needs those of its whole building.
#ifndef JOSTLE_SMALL_LOOPS_H
#define JOSTLE_SMALL_LOOPS_H

#include <stdalign.h>

#include "solve/floors/floor_loops.h"

enum {
    VECTORS = SMALL_MAX / FLOORS_VECTOR,
};

// Vector j of an array.
#define PART(x, j) FLOORS_AT(x, (j)*FLOORS_VECTOR)

// Vector j of x where floors are joined, else 0.
#define JOINED(joint, j, x) ((floor_lanes)((floor_bits)PART(joint, j) & (floor_bits)(x)))

// For each vector of n, unrolled so that the vectors stay in registers.
#define EACH_VECTOR(j, n) _Pragma("GCC unroll 4") for (ptrdiff_t j = 0; j < (n); j++)

// Has the model half as many vectors as the largest? There are only these two numbers, constants,
// so that loops over them can be unrolled.
LANES_INLINE bool is_low(const struct model *m) {
    return m->n_dof <= SMALL_MAX / 2;
}

// All floors, at one instant; drifts and shears where storeys follow lines.
struct small_floors {
    floor_lanes u[VECTORS], v[VECTORS], a[VECTORS], drift[VECTORS], shear[VECTORS];
};

static const floor_lanes none = {0.0};

// Numbers of Newmark's method, in a copy that no store to memory can change: struct work.
struct small_scheme {
    double h, half, b, g;
};

LANES_INLINE struct small_scheme small_scheme_of(const struct work *w) {
    return (struct small_scheme){.h = w->h, .half = w->h * w->h / 2.0, .b = w->b, .g = w->g};
}

// Drifts and shears at the displacements of s. `lines` NULL: storeys are elastic. *beyond gets
// negative where one is beyond its line.
LANES_INLINE void small_strain(const struct small_table *t, const struct floors_lines *lines, int n,
                               struct small_floors *s, floor_bits *beyond) {
    EACH_VECTOR(j, n) {
        floor_lanes below = j > 0 ? s->u[j - 1] : none;
        s->drift[j] = s->u[j] - JOINED(t->joint, j, BELOW(below, s->u[j]));
        if (lines) {
            floor_lanes force = LINE_FORCE(PART(t->spring, j), PART(t->rest, j), s->drift[j]);
            *beyond |= BEYOND(force, PART(t->limit, j));
            s->shear[j] = LINE_SHEAR(PART(t->back, j), s->drift[j], force);
        } else {
            s->shear[j] = PART(t->stiffness, j) * s->drift[j];
        }
    }
}

// residual = -m a_ground - M a - C v - storey shears at the trial.
LANES_INLINE void small_unbalance(const struct small_table *t, int n,
                                  const struct small_floors *now, const struct small_floors *trial,
                                  double ground, double *residual) {
    EACH_VECTOR(j, n) {
        floor_lanes v_below = j > 0 ? trial->v[j - 1] : none;
        floor_lanes v_above = j + 1 < n ? trial->v[j + 1] : none;
        floor_lanes shear_above = j + 1 < n ? trial->shear[j + 1] : none;
        floor_lanes inertia = PART(t->inertia, j);
        floor_lanes damping =
            BANDS(PART(t->damping_below, j), BELOW(v_below, trial->v[j]), PART(t->damping, j),
                  trial->v[j], PART(t->damping_above, j), ABOVE(trial->v[j], v_above));
        *(floor_lanes *)(residual + j * FLOORS_VECTOR) =
            RESIDUAL(inertia * ground + inertia * now->a[j], damping, trial->shear[j],
                     JOINED(t->joint_above, j, ABOVE(trial->shear[j], shear_above)));
    }
}

// The corrections q of all floors, LANES_WIDTH at a time.
LANES_INLINE void small_solve(const struct small_model *small, int n, const double *residual,
                              floor_lanes *q) {
    EACH_VECTOR(j, n / FLOORS_VECTORS) {
        const struct small_rows *rows = &small->rows[j];
        const double *row = small->table->inverse[rows->from] + j * LANES_WIDTH;
        floor_lanes sum[FLOORS_VECTORS];
        EACH_VECTOR(part, FLOORS_VECTORS) {
            sum[part] = residual[rows->from] * PART(row, part);
        }
        row += SMALL_MAX;
        _Pragma("GCC unroll 2") for (int k = rows->from + 1; k < rows->to; k++, row += SMALL_MAX) {
            EACH_VECTOR(part, FLOORS_VECTORS) {
                sum[part] += residual[k] * PART(row, part);
            }
        }
        EACH_VECTOR(part, FLOORS_VECTORS) {
            q[j * FLOORS_VECTORS + part] = sum[part];
        }
    }
}

// *sign gets negative where a floor is beyond its peaks. Elastic shears are so only with drifts.
LANES_INLINE void small_compare(double *const peak[PEAK_COUNT], const struct floors_lines *lines,
                                int n, const struct small_floors *s, double ground,
                                floor_bits *sign) {
    EACH_VECTOR(j, n) {
        floor_lanes total = s->a[j] + ground;
        *sign |= BEYOND(s->u[j], PART(peak[PEAK_DISPLACEMENT], j)) |
                 BEYOND(s->v[j], PART(peak[PEAK_VELOCITY], j)) |
                 BEYOND(total, PART(peak[PEAK_ACCELERATION], j)) |
                 BEYOND(s->drift[j], PART(peak[PEAK_DRIFT], j));
        if (lines) {
            *sign |= BEYOND(s->shear[j], PART(peak[PEAK_SHEAR], j));
        }
    }
}

LANES_INLINE void small_add_works(const struct small_table *t, int n,
                                  const struct small_floors *now, const struct small_floors *next,
                                  double ground_2x, struct floors_works *w) {
    floor_lanes sum[VECTORS];
    EACH_VECTOR(j, n) {
        sum[j] = now->v[j] + next->v[j];
    }
    EACH_VECTOR(j, n) {
        floor_lanes du = next->u[j] - now->u[j];
        floor_lanes below = BELOW(j > 0 ? sum[j - 1] : none, sum[j]);
        floor_lanes above = ABOVE(sum[j], j + 1 < n ? sum[j + 1] : none);
        w->input[j % FLOORS_VECTORS] += WORK_OF_GROUND(ground_2x, PART(t->inertia, j), du);
        w->damping[j % FLOORS_VECTORS] +=
            WORK_OF_DAMPING(du, BANDS(PART(t->damping_below, j), below, PART(t->damping, j), sum[j],
                                      PART(t->damping_above, j), above));
    }
}

// The trial and its residuals.
LANES_INLINE void small_try(const struct small_table *t, const struct small_scheme *c,
                            const struct floors_lines *lines, int n, const struct small_floors *now,
                            double ground, struct small_floors *trial, double *residual,
                            floor_bits *beyond) {
    EACH_VECTOR(j, n) {
        trial->u[j] = TRIAL_U(now->u[j], now->v[j], now->a[j], c->h, c->half);
        trial->v[j] = TRIAL_V(now->v[j], now->a[j], c->h);
    }
    small_strain(t, lines, n, trial, beyond);
    small_unbalance(t, n, now, trial, ground, residual);
}

// What the corrections q of the accelerations lead to.
LANES_INLINE void small_reach(const struct small_scheme *c, int n, const struct small_floors *now,
                              const struct small_floors *trial, const floor_lanes *q,
                              struct small_floors *next) {
    EACH_VECTOR(j, n) {
        next->u[j] = END(trial->u[j], c->b, q[j]);
        next->v[j] = END(trial->v[j], c->g, q[j]);
        next->a[j] = now->a[j] + q[j];
    }
}

LANES_INLINE void small_put(const floor_lanes *x, int n, double *array) {
    EACH_VECTOR(j, n) {
        *(floor_lanes *)(array + j * FLOORS_VECTOR) = x[j];
    }
}

LANES_INLINE void small_load(const struct state *s, const struct floors_lines *lines, int n,
                             struct small_floors *x) {
    EACH_VECTOR(j, n) {
        x->u[j] = PART(s->u, j);
        x->v[j] = PART(s->v, j);
        x->a[j] = PART(s->a, j);
        x->drift[j] = lines ? PART(lines->drift, j) : none;
        x->shear[j] = lines ? PART(lines->shear, j) : none;
    }
}

LANES_INLINE void small_store(const struct small_floors *x, const struct floors_lines *lines, int n,
                              const struct state *s) {
    small_put(x->u, n, s->u);
    small_put(x->v, n, s->v);
    small_put(x->a, n, s->a);
    if (lines) {
        small_put(x->drift, n, lines->drift);
        small_put(x->shear, n, lines->shear);
    }
}

// peak_raise of all floors.
LANES_INLINE void small_raise_peak(const struct results *r, enum peak kind, int n,
                                   const floor_lanes *x, double time) {
    double *peak = r->peak[kind], *when = r->peak_time[kind];
    EACH_VECTOR(j, n) {
        floor_bits more = BEYOND(x[j], PART(peak, j)) >> 63;
        floor_bits own = (floor_bits)x[j] & INT64_MAX, now = (floor_bits)(time + none);
        floor_bits old = (floor_bits)PART(peak, j), then = (floor_bits)PART(when, j);
        *(floor_lanes *)(peak + j * FLOORS_VECTOR) = (floor_lanes)((own & more) | (old & ~more));
        *(floor_lanes *)(when + j * FLOORS_VECTOR) = (floor_lanes)((now & more) | (then & ~more));
    }
}

// *sign gets negative where floors are not finite.
LANES_INLINE void small_weigh(int n, const struct small_floors *s, floor_bits *sign) {
    EACH_VECTOR(j, n) {
        floor_lanes size = s->u[j] + s->v[j] + s->a[j];
        *sign |= BEYOND(size, DBL_MAX + none);
    }
}

// Takes floors into the peaks. False: they are not finite.
LANES_INLINE bool small_raise(const struct results *r, int n, const struct small_floors *s,
                              double time, double ground) {
    floor_bits sign = {0};
    floor_lanes total[VECTORS];
    small_weigh(n, s, &sign);
    EACH_VECTOR(j, n) {
        total[j] = s->a[j] + ground;
    }
    small_raise_peak(r, PEAK_DISPLACEMENT, n, s->u, time);
    small_raise_peak(r, PEAK_VELOCITY, n, s->v, time);
    small_raise_peak(r, PEAK_ACCELERATION, n, total, time);
    small_raise_peak(r, PEAK_DRIFT, n, s->drift, time);
    small_raise_peak(r, PEAK_SHEAR, n, s->shear, time);
    return !floors_any(&sign);
}

// How near contacts have come.
enum nearness {
    NEARNESS_FAR,
    NEARNESS_DEEPEST,  // nearer than ever
    NEARNESS_CLOSED,
};

// That of the contacts of all groups at the displacements u.
LANES_INLINE enum nearness small_nearness(const struct flight *f, const double *u,
                                          const double *ground) {
    const double *gap = f->gap;
    floor_bits closed = {0}, nearer = {0};
    for (const struct gap_group *g = f->group; g < f->group + f->n_group; g++, gap += LANES_WIDTH) {
        const double *nearest = f->work->gaps.nearest + g->contact;
        for (int i = 0; i < LANES_WIDTH; i += FLOORS_VECTOR) {
            floor_lanes delta;
            floors_delta(g, i, gap, u, ground, &delta);
            closed |= (floor_bits)(0.0 - delta);
            nearer |= (floor_bits)(FLOORS_AT(nearest, i) - delta);
        }
    }
    const floor_bits near = closed | nearer;
    if (!floors_any(&near)) {
        return NEARNESS_FAR;
    }
    return floors_any(&closed) ? NEARNESS_CLOSED : NEARNESS_DEEPEST;
}

#endif
