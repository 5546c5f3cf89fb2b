// SPDX-License-Identifier: GPL-3.0-or-later
// The step of floors.c, operation by operation, so that the bits are the same. Only the residuals
// are stored, as each floor wants those of its building, and the displacements, which the gaps
// want.
#include "solve/few.h"

#include <string.h>

#include "core/arena.h"
#include "solve/floor_loops.h"

enum { VECTORS = FEW_MAX / LANES_VECTOR };

// For each vector of n, in loops that are unrolled, or they would not be in registers.
#define EACH_VECTOR(j, n) _Pragma("GCC unroll 4") for (ptrdiff_t j = 0; j < (n); j++)

bool few_alloc(struct few *few, const struct flight *f, struct arena *a) {
    const struct model *m = f->model;
    few->possible = f->possible && f->uniform && m->n_dof <= FEW_MAX;
    few->inverse = lanes_array(a, few->possible ? FEW_MAX * FEW_MAX : 0);
    return few->inverse != NULL;
}

void few_factor(struct few *few, const struct work *w) {
    if (few->factors == w->factors) {
        return;
    }
    few->factors = w->factors;
    memset(few->rows, 0, sizeof few->rows);
    for (int k = 0; k < w->model->n_building; k++) {
        const struct building *g = &w->model->building[k];
        const int end = g->first + g->n_floor;
        for (int i = 0; i < g->n_floor; i++) {
            memcpy(few->inverse + (ptrdiff_t)(g->first + i) * FEW_MAX + g->first,
                   effective_column(&w->effective[k], i),
                   (size_t)g->n_floor * sizeof *few->inverse);
        }
        for (int j = g->first / LANES_VECTOR; j * LANES_VECTOR < end; j++) {
            struct few_rows *r = &few->rows[j];
            r->from = r->to == 0 ? g->first / LANES_VECTOR * LANES_VECTOR : r->from;
            r->to = (end + LANES_VECTOR - 1) / LANES_VECTOR * LANES_VECTOR;
        }
    }
}

// All floors, at one instant; drifts and shears where storeys follow lines.
struct few_floors {
    lanes u[VECTORS], v[VECTORS], a[VECTORS], drift[VECTORS], shear[VECTORS];
};

struct few_works {
    lanes input[2], damping[2];
};

static const lanes none = {0.0};

// Drifts and shears at the displacements of s. `lines` NULL: storeys are elastic. *beyond gets
// negative where one is beyond its line.
LANES_INLINE void few_strain(const struct chain *c, const struct floors_lines *lines, int n,
                             struct few_floors *s, lanes_bits *beyond) {
    EACH_VECTOR(j, n) {
        const ptrdiff_t i = j * LANES_VECTOR;
        lanes below = j > 0 ? s->u[j - 1] : none;
        s->drift[j] = s->u[j] - FOUR(c->joint, i) * BELOW(below, s->u[j]);
        floors_shear(c, lines, i, &s->drift[j], &s->shear[j], beyond);
    }
}

// residual = -m a_ground - M a - C v - storey shears at the trial.
LANES_INLINE void few_unbalance(const struct chain *c, int n, const struct few_floors *now,
                                const struct few_floors *trial, double ground, double *residual) {
    EACH_VECTOR(j, n) {
        const ptrdiff_t i = j * LANES_VECTOR;
        lanes v_below = j > 0 ? trial->v[j - 1] : none;
        lanes v_above = j + 1 < n ? trial->v[j + 1] : none;
        lanes shear_above = j + 1 < n ? trial->shear[j + 1] : none;
        lanes mass = FOUR(c->mass, i);
        lanes damping = FOUR(c->damping_below, i) * BELOW(v_below, trial->v[j]) +
                        FOUR(c->damping, i) * trial->v[j] +
                        FOUR(c->damping_below, i + 1) * ABOVE(trial->v[j], v_above);
        *(lanes *)(residual + i) = mass * -ground - mass * now->a[j] - damping - trial->shear[j] +
                                   FOUR(c->joint, i + 1) * ABOVE(trial->shear[j], shear_above);
    }
}

// The corrections of four floors.
LANES_INLINE void few_solve(const struct few *few, ptrdiff_t j, const double *residual, lanes *q) {
    const double *column = few->inverse + j * LANES_VECTOR;
    lanes sum = none;
    for (int i = few->rows[j].from; i < few->rows[j].to; i += LANES_VECTOR) {
        for (ptrdiff_t k = i; k < i + LANES_VECTOR; k++) {
            sum += residual[k] * FOUR(column, k * FEW_MAX);
        }
    }
    *q = sum;
}

// *sign gets negative where a floor is beyond its peaks. Elastic shears are so only with drifts.
LANES_INLINE void few_compare(const struct floors_lines *lines, int n, const struct few_floors *s,
                              double ground, double *const peak[PEAK_COUNT], lanes_bits *sign) {
    EACH_VECTOR(j, n) {
        const ptrdiff_t i = j * LANES_VECTOR;
        lanes total = s->a[j] + ground;
        *sign |= BEYOND(s->u[j], FOUR(peak[PEAK_DISPLACEMENT], i)) |
                 BEYOND(s->v[j], FOUR(peak[PEAK_VELOCITY], i)) |
                 BEYOND(total, FOUR(peak[PEAK_ACCELERATION], i)) |
                 BEYOND(s->drift[j], FOUR(peak[PEAK_DRIFT], i));
        if (lines) {
            *sign |= BEYOND(s->shear[j], FOUR(lines->peak, i));
        }
    }
}

LANES_INLINE void few_add_works(const struct chain *c, int n, const struct few_floors *now,
                                const struct few_floors *next, double ground_2x,
                                struct few_works *w) {
    lanes sum[VECTORS];
    EACH_VECTOR(j, n) {
        sum[j] = now->v[j] + next->v[j];
    }
    EACH_VECTOR(j, n) {
        const ptrdiff_t i = j * LANES_VECTOR;
        lanes du = next->u[j] - now->u[j];
        lanes below = BELOW(j > 0 ? sum[j - 1] : none, sum[j]);
        lanes above = ABOVE(sum[j], j + 1 < n ? sum[j + 1] : none);
        w->input[j % 2] -= ground_2x * (FOUR(c->mass, i) * du);
        w->damping[j % 2] +=
            du * (FOUR(c->damping_below, i) * below + FOUR(c->damping, i) * sum[j] +
                  FOUR(c->damping_above, i) * above);
    }
}

// The state after a step, with its displacements in `shown` too.
LANES_INLINE void few_step(const struct few *few, const struct work *w, const struct chain *c,
                           const struct floors_lines *lines, int n, const struct few_floors *now,
                           double ground, double *shown, struct few_floors *next,
                           lanes_bits *beyond) {
    double residual[FEW_MAX];
    struct few_floors trial;
    const double h = w->h, half = h * h / 2.0;
    EACH_VECTOR(j, n) {
        trial.u[j] = now->u[j] + (h * now->v[j] + half * now->a[j]);
        trial.v[j] = now->v[j] + h * now->a[j];
    }
    few_strain(c, lines, n, &trial, beyond);
    few_unbalance(c, n, now, &trial, ground, residual);
    EACH_VECTOR(j, n) {
        lanes q;
        few_solve(few, j, residual, &q);
        next->u[j] = trial.u[j] + w->b * q;
        next->v[j] = trial.v[j] + w->g * q;
        next->a[j] = now->a[j] + q;
        *(lanes *)(shown + j * LANES_VECTOR) = next->u[j];
    }
    few_strain(c, lines, n, next, beyond);
}

LANES_INLINE void few_load(const struct state *s, const struct floors_lines *lines, int n,
                           struct few_floors *x) {
    EACH_VECTOR(j, n) {
        const ptrdiff_t i = j * LANES_VECTOR;
        x->u[j] = FOUR(s->u, i);
        x->v[j] = FOUR(s->v, i);
        x->a[j] = FOUR(s->a, i);
        x->drift[j] = lines ? FOUR(lines->drift, i) : none;
        x->shear[j] = lines ? FOUR(lines->shear, i) : none;
    }
}

LANES_INLINE void few_store(const struct few_floors *x, const struct floors_lines *lines, int n,
                            const struct state *s) {
    EACH_VECTOR(j, n) {
        const ptrdiff_t i = j * LANES_VECTOR;
        *(lanes *)(s->u + i) = x->u[j];
        *(lanes *)(s->v + i) = x->v[j];
        *(lanes *)(s->a + i) = x->a[j];
        if (lines) {
            *(lanes *)(lines->drift + i) = x->drift[j];
            *(lanes *)(lines->shear + i) = x->shear[j];
        }
    }
}

LANES_INLINE void few_load_works(const struct energy_account *a, struct few_works *w) {
    EACH_VECTOR(j, 2) {
        w->input[j] = FOUR(a->input_2x, j * LANES_VECTOR);
        w->damping[j] = FOUR(a->damping_2x, j * LANES_VECTOR);
    }
}

LANES_INLINE void few_store_works(const struct few_works *w, struct energy_account *a) {
    EACH_VECTOR(j, 2) {
        *(lanes *)(a->input_2x + j * LANES_VECTOR) = w->input[j];
        *(lanes *)(a->damping_2x + j * LANES_VECTOR) = w->damping[j];
    }
}

LANES_INLINE void few_add_storey_works(int n, const struct few_floors *now,
                                       const struct few_floors *next, double *work) {
    EACH_VECTOR(j, n) {
        *(lanes *)(work + j * LANES_VECTOR) +=
            (now->shear[j] + next->shear[j]) * (next->drift[j] - now->drift[j]);
    }
}

// Stores the step to `time` and takes it into the peaks. False: it is none, as it is not finite.
LANES_INLINE bool few_raise(const struct flight *f, const struct floors_lines *lines, int n,
                            const struct few_floors *next, double time, double ground,
                            enum nearness near, struct state *s) {
    few_store(next, lines, n, s);
    s->time = time;
    s->ground_a[0] = ground;
    return flight_raise(f, near, s);
}

// Takes steps of a model of n vectors from number `from` to number `end`, or until one is none in
// free flight; returns the one reached. Between steps all is in registers.
LANES_INLINE long few_fly(const struct flight *f, const struct floors_lines *lines, int n,
                          struct state *s, long from, long end) {
    const struct work *w = f->work;
    const struct chain c = w->model->chain;
    double shown[FEW_MAX + 2 * LANES_WIDTH] = {0.0};
    struct few_floors now;
    struct few_works works;
    double time = s->time, ground = s->ground_a[0];
    few_load(s, lines, n, &now);
    few_load_works(f->energy, &works);
    long step = from;
    for (; step < end; step++) {
        struct few_floors next;
        lanes_bits beyond = {0}, higher = {0};
        const long ahead = step + 1 - f->ahead_from;
        few_step(&f->few, w, &c, lines, n, &now, f->ground[ahead], shown, &next, &beyond);
        few_compare(lines, n, &next, f->ground[ahead], f->results->peak, &higher);
        enum nearness near = floors_look(f, 0, f->n_group, shown, s->ground_u);
        bool refused = floors_any(&beyond) < 0 || near == NEARNESS_CLOSED;
        bool news = floors_any(&higher) < 0 || near == NEARNESS_DEEPEST;
        if (refused ||
            (news && !few_raise(f, lines, n, &next, f->time[ahead], f->ground[ahead], near, s))) {
            break;
        }
        few_add_works(&c, n, &now, &next, ground + f->ground[ahead], &works);
        if (lines) {
            few_add_storey_works(n, &now, &next, f->energy->storey_2x);
        }
        now = next;
        time = f->time[ahead];
        ground = f->ground[ahead];
    }
    few_store(&now, lines, n, s);
    few_store_works(&works, f->energy);
    s->time = time;
    s->ground_a[0] = ground;
    return step;
}

LANES static long fly_low(const struct flight *f, struct state *s, long n, long end) {
    return few_fly(f, NULL, VECTORS / 2, s, n, end);
}

LANES static long fly_high(const struct flight *f, struct state *s, long n, long end) {
    return few_fly(f, NULL, VECTORS, s, n, end);
}

LANES static long fly_low_on_lines(const struct flight *f, struct state *s, long n, long end) {
    const struct floors_lines lines = floors_lines_of(f, s);
    return few_fly(f, &lines, VECTORS / 2, s, n, end);
}

LANES static long fly_high_on_lines(const struct flight *f, struct state *s, long n, long end) {
    const struct floors_lines lines = floors_lines_of(f, s);
    return few_fly(f, &lines, VECTORS, s, n, end);
}

long few_take(const struct flight *f, struct state *s, long n, long end) {
    bool low = f->model->n_dof <= FEW_MAX / 2;
    return f->yields ? (low ? fly_low_on_lines : fly_high_on_lines)(f, s, n, end)
                     : (low ? fly_low : fly_high)(f, s, n, end);
}
