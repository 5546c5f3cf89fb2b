// SPDX-License-Identifier: GPL-3.0-or-later
// The step of floors.c, operation by operation, so that the bits are the same. Only the residuals
// are stored, as each floor wants those of its building, and the displacements, which the gaps
// want.
#include "solve/few.h"

#include <stdalign.h>
#include <string.h>

#include "core/arena.h"
#include "solve/floor_loops.h"

// Vector j of an array.
#define PART(x, j) FOUR(x, (j)*LANES_VECTOR)

enum { LINE = 64, VECTORS = FEW_MAX / LANES_VECTOR, PER_EIGHT = LANES_WIDTH / LANES_VECTOR };

// For each vector of n, in loops that are unrolled, or they would not be in registers.
#define EACH_VECTOR(j, n) _Pragma("GCC unroll 4") for (ptrdiff_t j = 0; j < (n); j++)

static void fill_table(struct few_table *t, const struct model *m) {
    const struct chain *c = &m->chain;
    size_t n = (size_t)m->n_dof * sizeof(double);
    memcpy(t->mass, c->mass, n);
    memcpy(t->stiffness, c->stiffness, n);
    memcpy(t->joint, c->joint, n);
    memcpy(t->joint_above, c->joint + 1, n);
    memcpy(t->damping_below, c->damping_below, n);
    memcpy(t->damping, c->damping, n);
    memcpy(t->damping_above, c->damping_above, n);
}

bool few_alloc(struct few *few, const struct flight *f, struct arena *a) {
    const struct model *m = f->model;
    few->possible = f->possible && f->uniform && m->n_dof <= FEW_MAX;
    few->table = lanes_wide_array(a, few->possible ? 1 : 0, sizeof *few->table);
    if (few->table && few->possible) {
        fill_table(few->table, m);
    }
    return few->table != NULL;
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
            memcpy(few->table->inverse[g->first + i] + g->first,
                   effective_column(&w->effective[k], i), (size_t)g->n_floor * sizeof(double));
        }
        for (int j = g->first / LANES_WIDTH; j * LANES_WIDTH < end; j++) {
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
    lanes input[PER_EIGHT], damping[PER_EIGHT];
};

static const lanes none = {0.0};

// Drifts and shears at the displacements of s. `lines` NULL: storeys are elastic. *beyond gets
// negative where one is beyond its line.
LANES_INLINE void few_strain(const struct few_table *t, const struct floors_lines *lines, int n,
                             struct few_floors *s, lanes_bits *beyond) {
    EACH_VECTOR(j, n) {
        lanes below = j > 0 ? s->u[j - 1] : none;
        s->drift[j] = s->u[j] - PART(t->joint, j) * BELOW(below, s->u[j]);
        if (lines) {
            lanes force = PART(t->spring, j) * (s->drift[j] - PART(t->rest, j));
            *beyond |= BEYOND(force, PART(t->limit, j));
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
        lanes v_below = j > 0 ? trial->v[j - 1] : none;
        lanes v_above = j + 1 < n ? trial->v[j + 1] : none;
        lanes shear_above = j + 1 < n ? trial->shear[j + 1] : none;
        lanes mass = PART(t->mass, j);
        lanes damping = PART(t->damping_below, j) * BELOW(v_below, trial->v[j]) +
                        PART(t->damping, j) * trial->v[j] +
                        PART(t->damping_above, j) * ABOVE(trial->v[j], v_above);
        *(lanes *)(residual + j * LANES_VECTOR) =
            mass * -ground - mass * now->a[j] - damping - trial->shear[j] +
            PART(t->joint_above, j) * ABOVE(trial->shear[j], shear_above);
    }
}

// The corrections of LANES_WIDTH floors.
LANES_INLINE void few_solve(const struct few *few, ptrdiff_t j, const double *residual, lanes *q) {
    lanes sum[PER_EIGHT] = {{0.0}};
    const double *row = few->table->inverse[few->rows[j].from] + j * LANES_WIDTH;
    for (const double *r = residual + few->rows[j].from, *end = residual + few->rows[j].to; r < end;
         r += LANES_VECTOR) {
        _Pragma("GCC unroll 4") for (ptrdiff_t k = 0; k < LANES_VECTOR; k++, row += FEW_MAX) {
            EACH_VECTOR(i, PER_EIGHT) {
                sum[i] += r[k] * PART(row, i);
            }
        }
    }
    EACH_VECTOR(i, PER_EIGHT) {
        q[j * PER_EIGHT + i] = sum[i];
    }
}

// *sign gets negative where a floor is beyond its peaks. Elastic shears are so only with drifts.
LANES_INLINE void few_compare(const struct few_table *t, const struct floors_lines *lines, int n,
                              const struct few_floors *s, double ground, lanes_bits *sign) {
    EACH_VECTOR(j, n) {
        lanes total = s->a[j] + ground;
        *sign |= BEYOND(s->u[j], PART(t->peak[PEAK_DISPLACEMENT], j)) |
                 BEYOND(s->v[j], PART(t->peak[PEAK_VELOCITY], j)) |
                 BEYOND(total, PART(t->peak[PEAK_ACCELERATION], j)) |
                 BEYOND(s->drift[j], PART(t->peak[PEAK_DRIFT], j));
        if (lines) {
            *sign |= BEYOND(s->shear[j], PART(t->peak[PEAK_SHEAR], j));
        }
    }
}

// *sign gets negative where a contact closes or is nearer than ever.
LANES_INLINE void few_look(const struct flight *f, const double *u, lanes_bits *sign) {
    const double *gap = f->gap;
    for (const struct gap_group *g = f->group; g < f->group + f->n_group; g++) {
        const double *left = u + g->dof[0], *right = u + g->dof[1];
        const double *limit = f->work->gaps.limit + g->contact;
        EACH_VECTOR(i, PER_EIGHT) {
            lanes delta = PART(left, i) - PART(right, i) - PART(gap, i);
            *sign |= (lanes_bits)(PART(limit, i) - delta);
        }
        gap += LANES_WIDTH;
    }
}

LANES_INLINE void few_add_works(const struct few_table *t, int n, const struct few_floors *now,
                                const struct few_floors *next, double ground_2x,
                                struct few_works *w) {
    lanes sum[VECTORS];
    EACH_VECTOR(j, n) {
        sum[j] = now->v[j] + next->v[j];
    }
    EACH_VECTOR(j, n) {
        lanes du = next->u[j] - now->u[j];
        lanes below = BELOW(j > 0 ? sum[j - 1] : none, sum[j]);
        lanes above = ABOVE(sum[j], j + 1 < n ? sum[j + 1] : none);
        w->input[j % PER_EIGHT] -= ground_2x * (PART(t->mass, j) * du);
        w->damping[j % PER_EIGHT] +=
            du * (PART(t->damping_below, j) * below + PART(t->damping, j) * sum[j] +
                  PART(t->damping_above, j) * above);
    }
}

// The state after a step, with its displacements in `shown` too.
LANES_INLINE void few_step(const struct few *few, const struct work *w,
                           const struct floors_lines *lines, int n, const struct few_floors *now,
                           double ground, double *shown, struct few_floors *next,
                           lanes_bits *beyond) {
    alignas(LINE) double residual[FEW_MAX];
    struct few_floors trial;
    lanes q[VECTORS];
    const double h = w->h, half = h * h / 2.0;
    EACH_VECTOR(j, n) {
        trial.u[j] = now->u[j] + (h * now->v[j] + half * now->a[j]);
        trial.v[j] = now->v[j] + h * now->a[j];
    }
    few_strain(few->table, lines, n, &trial, beyond);
    few_unbalance(few->table, n, now, &trial, ground, residual);
    EACH_VECTOR(j, n / PER_EIGHT) {
        few_solve(few, j, residual, q);
    }
    EACH_VECTOR(j, n) {
        next->u[j] = trial.u[j] + w->b * q[j];
        next->v[j] = trial.v[j] + w->g * q[j];
        next->a[j] = now->a[j] + q[j];
        *(lanes *)(shown + j * LANES_VECTOR) = next->u[j];
    }
    few_strain(few->table, lines, n, next, beyond);
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
    EACH_VECTOR(j, PER_EIGHT) {
        w->input[j] = PART(a->input_2x, j);
        w->damping[j] = PART(a->damping_2x, j);
    }
}

LANES_INLINE void few_store_works(const struct few_works *w, struct energy_account *a) {
    EACH_VECTOR(j, PER_EIGHT) {
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

LANES_INLINE void few_load_peaks(struct few_table *t, const struct results *r, int n) {
    for (int q = 0; q < PEAK_COUNT; q++) {
        EACH_VECTOR(j, n) {
            *(lanes *)(t->peak[q] + j * LANES_VECTOR) = PART(r->peak[q], j);
        }
    }
}

LANES_INLINE void few_load_lines(struct few_table *t, const struct floors_lines *lines, int n) {
    EACH_VECTOR(j, n) {
        *(lanes *)(t->back + j * LANES_VECTOR) = PART(lines->back, j);
        *(lanes *)(t->spring + j * LANES_VECTOR) = PART(lines->spring, j);
        *(lanes *)(t->rest + j * LANES_VECTOR) = PART(lines->rest, j);
        *(lanes *)(t->limit + j * LANES_VECTOR) = PART(lines->limit, j);
    }
}

// Stores the step to `time` and takes it into the peaks. False: it is none, as it is not finite.
LANES_INLINE bool few_raise(const struct flight *f, const struct floors_lines *lines, int n,
                            const struct few_floors *next, double time, double ground,
                            enum nearness near, struct state *s) {
    few_store(next, lines, n, s);
    s->time = time;
    s->ground_a[0] = ground;
    bool good = flight_raise(f, near, s);
    few_load_peaks(f->few.table, f->results, n);
    return good;
}

// Takes steps of a model of n vectors from number `from` to number `end`, or until one is none in
// free flight; returns the one reached. Between steps all is in registers.
LANES_INLINE long few_fly(const struct flight *f, const struct floors_lines *lines, int n,
                          struct state *s, long from, long end) {
    struct few_table *t = f->few.table;
    alignas(LINE) double shown[FEW_MAX + 2 * LANES_WIDTH] = {0.0};
    struct few_floors now;
    struct few_works works;
    double time = s->time, ground = s->ground_a[0];
    few_load(s, lines, n, &now);
    few_load_works(f->energy, &works);
    few_load_peaks(t, f->results, n);
    if (lines) {
        few_load_lines(t, lines, n);
    }
    long step = from;
    for (; step < end; step++) {
        struct few_floors next;
        lanes_bits beyond = {0}, news = {0};
        const long ahead = step + 1 - f->ahead_from;
        few_step(&f->few, f->work, lines, n, &now, f->ground[ahead], shown, &next, &beyond);
        few_compare(t, lines, n, &next, f->ground[ahead], &news);
        few_look(f, shown, &news);
        news |= beyond;
        if (floors_any(&news) < 0) {
            enum nearness near = floors_look(f, 0, f->n_group, shown, s->ground_u);
            if (floors_any(&beyond) < 0 || near == NEARNESS_CLOSED ||
                !few_raise(f, lines, n, &next, f->time[ahead], f->ground[ahead], near, s)) {
                break;
            }
        }
        few_add_works(t, n, &now, &next, ground + f->ground[ahead], &works);
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
