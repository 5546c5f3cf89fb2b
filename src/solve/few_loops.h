// SPDX-License-Identifier: GPL-3.0-or-later
// The loops of few_steps.h: those of floor_loops.h, operation by operation, so that the bits are
// the same, over all floors at once. Only the residuals are stored, as each floor wants those of
// its building. few_narrow.c and few_wide.c say what a vector is: few_lanes and few_bits,
// FEW_BELOW and FEW_ABOVE for BELOW and ABOVE, and few_any, whether one of few_bits is negative.
#ifndef JOSTLE_FEW_LOOPS_H
#define JOSTLE_FEW_LOOPS_H

#include <stdalign.h>

#include "solve/floor_loops.h"

enum {
    WIDTH = sizeof(few_lanes) / sizeof(double),
    VECTORS = FEW_MAX / WIDTH,
    PER_EIGHT = LANES_WIDTH / WIDTH,
};

// Vector j of an array.
#define PART(x, j) (*(const few_lanes *)((x) + (j)*WIDTH))

// Vector j of x where floors are joined, else 0.
#define JOINED(joint, j, x) ((few_lanes)((few_bits)PART(joint, j) & (few_bits)(x)))
#define FEW_BEYOND(x, limit) ((few_bits)(limit) - ((few_bits)(x)&INT64_MAX))

// For each vector of n, in loops that are unrolled, or they would not be in registers.
#define EACH_VECTOR(j, n) _Pragma("GCC unroll 4") for (ptrdiff_t j = 0; j < (n); j++)

// Vectors of a model, of which there are two numbers, so that loops over them can be unrolled.
LANES_INLINE bool is_low(const struct model *m) {
    return m->n_dof <= FEW_MAX / 2;
}

// All floors, at one instant; drifts and shears where storeys follow lines.
struct few_floors {
    few_lanes u[VECTORS], v[VECTORS], a[VECTORS], drift[VECTORS], shear[VECTORS];
};

struct few_works {
    few_lanes input[PER_EIGHT], damping[PER_EIGHT];
};

static const few_lanes none = {0.0};

// Numbers of Newmark's method, in a copy that no store to memory can change: struct work.
struct few_scheme {
    double h, half, b, g;
};

LANES_INLINE struct few_scheme few_scheme_of(const struct work *w) {
    return (struct few_scheme){.h = w->h, .half = w->h * w->h / 2.0, .b = w->b, .g = w->g};
}

// Drifts and shears at the displacements of s. `lines` NULL: storeys are elastic. *beyond gets
// negative where one is beyond its line.
LANES_INLINE void few_strain(const struct few_table *t, const struct floors_lines *lines, int n,
                             struct few_floors *s, few_bits *beyond) {
    EACH_VECTOR(j, n) {
        few_lanes below = j > 0 ? s->u[j - 1] : none;
        s->drift[j] = s->u[j] - JOINED(t->joint, j, FEW_BELOW(below, s->u[j]));
        if (lines) {
            few_lanes force = PART(t->spring, j) * (s->drift[j] - PART(t->rest, j));
            *beyond |= FEW_BEYOND(force, PART(t->limit, j));
            s->shear[j] = PART(t->back, j) * s->drift[j] + force;
        } else {
            s->shear[j] = PART(t->stiffness, j) * s->drift[j];
        }
    }
}

// residual = -m a_ground - M a - C v - storey shears at the trial.
LANES_INLINE void few_unbalance(const struct few_table *t, int n, const struct few_floors *now,
                                const struct few_floors *trial, double ground, double *residual) {
    EACH_VECTOR(j, n) {
        few_lanes v_below = j > 0 ? trial->v[j - 1] : none;
        few_lanes v_above = j + 1 < n ? trial->v[j + 1] : none;
        few_lanes shear_above = j + 1 < n ? trial->shear[j + 1] : none;
        few_lanes inertia = PART(t->inertia, j);
        few_lanes damping = PART(t->damping_below, j) * FEW_BELOW(v_below, trial->v[j]) +
                            PART(t->damping, j) * trial->v[j] +
                            PART(t->damping_above, j) * FEW_ABOVE(trial->v[j], v_above);
        *(few_lanes *)(residual + j * WIDTH) =
            inertia * ground + inertia * now->a[j] - damping - trial->shear[j] +
            JOINED(t->joint_above, j, FEW_ABOVE(trial->shear[j], shear_above));
    }
}

// The corrections q of all floors, LANES_WIDTH at a time.
LANES_INLINE void few_solve(const struct few *few, int n, const double *residual, few_lanes *q) {
    EACH_VECTOR(j, n / PER_EIGHT) {
        const struct few_rows *rows = &few->rows[j];
        const double *row = few->table->inverse[rows->from] + j * LANES_WIDTH;
        few_lanes sum[PER_EIGHT];
        EACH_VECTOR(part, PER_EIGHT) {
            sum[part] = residual[rows->from] * PART(row, part);
        }
        row += FEW_MAX;
        _Pragma("GCC unroll 2") for (int k = rows->from + 1; k < rows->to; k++, row += FEW_MAX) {
            EACH_VECTOR(part, PER_EIGHT) {
                sum[part] += residual[k] * PART(row, part);
            }
        }
        EACH_VECTOR(part, PER_EIGHT) {
            q[j * PER_EIGHT + part] = sum[part];
        }
    }
}

// *sign gets negative where a floor is beyond its peaks. Elastic shears are so only with drifts.
LANES_INLINE void few_compare(double *const peak[PEAK_COUNT], const struct floors_lines *lines,
                              int n, const struct few_floors *s, double ground, few_bits *sign) {
    EACH_VECTOR(j, n) {
        few_lanes total = s->a[j] + ground;
        *sign |= FEW_BEYOND(s->u[j], PART(peak[PEAK_DISPLACEMENT], j)) |
                 FEW_BEYOND(s->v[j], PART(peak[PEAK_VELOCITY], j)) |
                 FEW_BEYOND(total, PART(peak[PEAK_ACCELERATION], j)) |
                 FEW_BEYOND(s->drift[j], PART(peak[PEAK_DRIFT], j));
        if (lines) {
            *sign |= FEW_BEYOND(s->shear[j], PART(peak[PEAK_SHEAR], j));
        }
    }
}

LANES_INLINE void few_add_works(const struct few_table *t, int n, const struct few_floors *now,
                                const struct few_floors *next, double ground_2x,
                                struct few_works *w) {
    few_lanes sum[VECTORS];
    EACH_VECTOR(j, n) {
        sum[j] = now->v[j] + next->v[j];
    }
    EACH_VECTOR(j, n) {
        few_lanes du = next->u[j] - now->u[j];
        few_lanes below = FEW_BELOW(j > 0 ? sum[j - 1] : none, sum[j]);
        few_lanes above = FEW_ABOVE(sum[j], j + 1 < n ? sum[j + 1] : none);
        w->input[j % PER_EIGHT] += ground_2x * (PART(t->inertia, j) * du);
        w->damping[j % PER_EIGHT] +=
            du * (PART(t->damping_below, j) * below + PART(t->damping, j) * sum[j] +
                  PART(t->damping_above, j) * above);
    }
}

// The trial and its residuals.
LANES_INLINE void few_try(const struct few_table *t, const struct few_scheme *c,
                          const struct floors_lines *lines, int n, const struct few_floors *now,
                          double ground, struct few_floors *trial, double *residual,
                          few_bits *beyond) {
    EACH_VECTOR(j, n) {
        trial->u[j] = now->u[j] + (c->h * now->v[j] + c->half * now->a[j]);
        trial->v[j] = now->v[j] + c->h * now->a[j];
    }
    few_strain(t, lines, n, trial, beyond);
    few_unbalance(t, n, now, trial, ground, residual);
}

// What the corrections q of the accelerations lead to.
LANES_INLINE void few_reach(const struct few_scheme *c, int n, const struct few_floors *now,
                            const struct few_floors *trial, const few_lanes *q,
                            struct few_floors *next) {
    EACH_VECTOR(j, n) {
        next->u[j] = trial->u[j] + c->b * q[j];
        next->v[j] = trial->v[j] + c->g * q[j];
        next->a[j] = now->a[j] + q[j];
    }
}

LANES_INLINE void few_put(const few_lanes *x, int n, double *array) {
    EACH_VECTOR(j, n) {
        *(few_lanes *)(array + j * WIDTH) = x[j];
    }
}

LANES_INLINE void few_load(const struct state *s, const struct floors_lines *lines, int n,
                           struct few_floors *x) {
    EACH_VECTOR(j, n) {
        x->u[j] = PART(s->u, j);
        x->v[j] = PART(s->v, j);
        x->a[j] = PART(s->a, j);
        x->drift[j] = lines ? PART(lines->drift, j) : none;
        x->shear[j] = lines ? PART(lines->shear, j) : none;
    }
}

LANES_INLINE void few_store(const struct few_floors *x, const struct floors_lines *lines, int n,
                            const struct state *s) {
    few_put(x->u, n, s->u);
    few_put(x->v, n, s->v);
    few_put(x->a, n, s->a);
    if (lines) {
        few_put(x->drift, n, lines->drift);
        few_put(x->shear, n, lines->shear);
    }
}

LANES_INLINE void few_load_works(const struct energy_account *a, struct few_works *w) {
    EACH_VECTOR(j, PER_EIGHT) {
        w->input[j] = PART(a->input_2x, j);
        w->damping[j] = PART(a->damping_2x, j);
    }
}

LANES_INLINE void few_store_works(const struct few_works *w, struct energy_account *a) {
    EACH_VECTOR(j, PER_EIGHT) {
        *(few_lanes *)(a->input_2x + j * WIDTH) = w->input[j];
        *(few_lanes *)(a->damping_2x + j * WIDTH) = w->damping[j];
    }
}

// peak_raise of all floors.
LANES_INLINE void few_raise_peak(const struct results *r, enum peak kind, int n, const few_lanes *x,
                                 double time) {
    double *peak = r->peak[kind], *when = r->peak_time[kind];
    EACH_VECTOR(j, n) {
        few_bits more = FEW_BEYOND(x[j], PART(peak, j)) >> 63;
        few_bits own = (few_bits)x[j] & INT64_MAX, now = (few_bits)(time + none);
        few_bits old = (few_bits)PART(peak, j), then = (few_bits)PART(when, j);
        *(few_lanes *)(peak + j * WIDTH) = (few_lanes)((own & more) | (old & ~more));
        *(few_lanes *)(when + j * WIDTH) = (few_lanes)((now & more) | (then & ~more));
    }
}

// *sign gets negative where floors are not finite.
LANES_INLINE void few_weigh(int n, const struct few_floors *s, few_bits *sign) {
    EACH_VECTOR(j, n) {
        few_lanes size = s->u[j] + s->v[j] + s->a[j];
        *sign |= FEW_BEYOND(size, DBL_MAX + none);
    }
}

// Takes floors into the peaks. False: they are not finite.
LANES_INLINE bool few_raise(const struct results *r, int n, const struct few_floors *s, double time,
                            double ground) {
    few_bits sign = {0};
    few_lanes total[VECTORS];
    few_weigh(n, s, &sign);
    EACH_VECTOR(j, n) {
        total[j] = s->a[j] + ground;
    }
    few_raise_peak(r, PEAK_DISPLACEMENT, n, s->u, time);
    few_raise_peak(r, PEAK_VELOCITY, n, s->v, time);
    few_raise_peak(r, PEAK_ACCELERATION, n, total, time);
    few_raise_peak(r, PEAK_DRIFT, n, s->drift, time);
    few_raise_peak(r, PEAK_SHEAR, n, s->shear, time);
    return !few_any(&sign);
}

// How near contacts have come.
enum nearness {
    NEARNESS_FAR,
    NEARNESS_DEEPEST,  // nearer than ever
    NEARNESS_CLOSED,
};

// That of the contacts of all groups at the displacements u.
LANES_INLINE enum nearness few_nearness(const struct flight *f, const double *u,
                                        const double *ground) {
    const double *gap = f->gap;
    lanes_bits closed = {0}, nearer = {0};
    for (const struct gap_group *g = f->group; g < f->group + f->n_group; g++, gap += LANES_WIDTH) {
        const double *nearest = f->work->gaps.nearest + g->contact;
        for (int i = 0; i < LANES_WIDTH; i += LANES_VECTOR) {
            lanes delta;
            floors_delta(g, i, gap, u, ground, &delta);
            closed |= (lanes_bits)(0.0 - delta);
            nearer |= (lanes_bits)(FOUR(nearest, i) - delta);
        }
    }
    lanes_bits near = closed | nearer;
    if (floors_any(&near) >= 0) {
        return NEARNESS_FAR;
    }
    return floors_any(&closed) < 0 ? NEARNESS_CLOSED : NEARNESS_DEEPEST;
}

#endif
