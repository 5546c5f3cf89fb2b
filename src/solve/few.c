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

#define ABSOLUTE(x) ((lanes)((lanes_bits)(x)&INT64_MAX))

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

bool few_alloc(struct few *few, const struct model *m, struct arena *a) {
    few->possible = state_is_uniform(m) && !m->chain.full_damping && m->n_dof <= FEW_MAX;
    if (few->possible) {
        few->table = (void *)lanes_array(a, sizeof *few->table / sizeof(double));
        if (few->table) {
            fill_table(few->table, m);
        }
    }
    return !few->possible || few->table;
}

void few_factor(struct few *few, const struct work *w) {
    bool kept = few->factors > 0 && w->model->n_storey_history == 0;
    if (few->factors == w->factors || kept) {
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

// The corrections q of all floors, LANES_WIDTH at a time.
LANES_INLINE void few_solve(const struct few *few, int n, const double *residual, lanes *q) {
    EACH_VECTOR(j, n / PER_EIGHT) {
        const struct few_rows *rows = &few->rows[j];
        const double *row = few->table->inverse[rows->from] + j * LANES_WIDTH;
        lanes sum[PER_EIGHT] = {{0.0}};
        for (int i = rows->from; i < rows->to; i += LANES_VECTOR) {
            _Pragma("GCC unroll 4") for (int k = i; k < i + LANES_VECTOR; k++, row += FEW_MAX) {
                EACH_VECTOR(part, PER_EIGHT) {
                    sum[part] += residual[k] * PART(row, part);
                }
            }
        }
        EACH_VECTOR(part, PER_EIGHT) {
            q[j * PER_EIGHT + part] = sum[part];
        }
    }
}

// *sign gets negative where a floor is beyond its peaks. Elastic shears are so only with drifts.
LANES_INLINE void few_compare(double *const peak[PEAK_COUNT], const struct floors_lines *lines,
                              int n, const struct few_floors *s, double ground, lanes_bits *sign) {
    EACH_VECTOR(j, n) {
        lanes total = s->a[j] + ground;
        *sign |= BEYOND(s->u[j], PART(peak[PEAK_DISPLACEMENT], j)) |
                 BEYOND(s->v[j], PART(peak[PEAK_VELOCITY], j)) |
                 BEYOND(total, PART(peak[PEAK_ACCELERATION], j)) |
                 BEYOND(s->drift[j], PART(peak[PEAK_DRIFT], j));
        if (lines) {
            *sign |= BEYOND(s->shear[j], PART(peak[PEAK_SHEAR], j));
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

// The trial and its residuals.
LANES_INLINE void few_try(const struct work *w, const struct floors_lines *lines, int n,
                          const struct few_floors *now, double ground, struct few_floors *trial,
                          double *residual, lanes_bits *beyond) {
    const double h = w->h, half = h * h / 2.0;
    EACH_VECTOR(j, n) {
        trial->u[j] = now->u[j] + (h * now->v[j] + half * now->a[j]);
        trial->v[j] = now->v[j] + h * now->a[j];
    }
    few_strain(w->few.table, lines, n, trial, beyond);
    few_unbalance(w->few.table, n, now, trial, ground, residual);
}

// What the corrections q of the accelerations lead to.
LANES_INLINE void few_reach(const struct work *w, int n, const struct few_floors *now,
                            const struct few_floors *trial, const lanes *q,
                            struct few_floors *next) {
    EACH_VECTOR(j, n) {
        next->u[j] = trial->u[j] + w->b * q[j];
        next->v[j] = trial->v[j] + w->g * q[j];
        next->a[j] = now->a[j] + q[j];
    }
}

LANES_INLINE void few_put(const lanes *x, int n, double *array) {
    EACH_VECTOR(j, n) {
        *(lanes *)(array + j * LANES_VECTOR) = x[j];
    }
}

// The state after a step, with its displacements in `shown` too.
LANES_INLINE void few_step(const struct work *w, const struct floors_lines *lines, int n,
                           const struct few_floors *now, double ground, double *shown,
                           struct few_floors *next, lanes_bits *beyond) {
    alignas(LINE) double residual[FEW_MAX];
    struct few_floors trial;
    lanes q[VECTORS];
    few_try(w, lines, n, now, ground, &trial, residual, beyond);
    few_solve(&w->few, n, residual, q);
    few_reach(w, n, now, &trial, q, next);
    few_put(next->u, n, shown);
    few_strain(w->few.table, lines, n, next, beyond);
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

LANES_INLINE void few_get(double *x, const double *from, int n) {
    EACH_VECTOR(j, n) {
        *(lanes *)(x + j * LANES_VECTOR) = PART(from, j);
    }
}

LANES_INLINE void few_get_peaks(struct few_table *t, const struct results *r, int n) {
    for (int q = 0; q < PEAK_COUNT; q++) {
        few_get(t->peak[q], r->peak[q], n);
    }
}

LANES_INLINE void few_get_lines(struct few_table *t, const struct floors_lines *lines, int n) {
    few_get(t->back, lines->back, n);
    few_get(t->spring, lines->spring, n);
    few_get(t->rest, lines->rest, n);
    few_get(t->limit, lines->limit, n);
}

// peak_raise of all floors.
LANES_INLINE void few_raise_peak(const struct results *r, enum peak kind, int n, const lanes *x,
                                 double time) {
    double *peak = r->peak[kind], *when = r->peak_time[kind];
    EACH_VECTOR(j, n) {
        lanes_bits more = BEYOND(x[j], PART(peak, j)) >> 63;
        lanes_bits own = (lanes_bits)x[j] & INT64_MAX, now = (lanes_bits)(time + none);
        lanes_bits old = (lanes_bits)PART(peak, j), then = (lanes_bits)PART(when, j);
        *(lanes *)(peak + j * LANES_VECTOR) = (lanes)((own & more) | (old & ~more));
        *(lanes *)(when + j * LANES_VECTOR) = (lanes)((now & more) | (then & ~more));
    }
}

// Takes floors into the peaks. False: they are not finite.
LANES_INLINE bool few_raise(const struct results *r, int n, const struct few_floors *s, double time,
                            double ground) {
    lanes_bits sign = {0};
    lanes total[VECTORS];
    EACH_VECTOR(j, n) {
        lanes size = ABSOLUTE(s->u[j]) + ABSOLUTE(s->v[j]) + ABSOLUTE(s->a[j]);
        sign |= BEYOND(size, DBL_MAX + none);
        total[j] = s->a[j] + ground;
    }
    few_raise_peak(r, PEAK_DISPLACEMENT, n, s->u, time);
    few_raise_peak(r, PEAK_VELOCITY, n, s->v, time);
    few_raise_peak(r, PEAK_ACCELERATION, n, total, time);
    few_raise_peak(r, PEAK_DRIFT, n, s->drift, time);
    few_raise_peak(r, PEAK_SHEAR, n, s->shear, time);
    return floors_any(&sign) >= 0;
}

// Takes a step in flight to `time` into the peaks. False: it is none.
LANES_INLINE bool few_take_note(const struct flight *f, const struct floors_lines *lines, int n,
                                const struct few_floors *next, const double *shown, double time,
                                double ground, struct state *s) {
    enum nearness near = floors_look(f, 0, f->n_group, shown, s->ground_u);
    if (near == NEARNESS_CLOSED || !few_raise(f->results, n, next, time, ground)) {
        return false;
    }
    few_get_peaks(f->work->few.table, f->results, n);
    if (near == NEARNESS_DEEPEST) {
        few_store(next, lines, n, s);
        s->time = time;
        flight_deepen(f, s);
    }
    return true;
}

// Takes steps of a model of n vectors from number `from` to number `end`, or until one is none in
// free flight; returns the one reached. Between steps all is in registers.
LANES_INLINE long few_fly(const struct flight *f, const struct floors_lines *lines, int n,
                          struct state *s, long from, long end) {
    const struct work *w = f->work;
    struct few_table *t = w->few.table;
    double *const peak[PEAK_COUNT] = {t->peak[0], t->peak[1], t->peak[2], t->peak[3], t->peak[4]};
    alignas(LINE) double shown[FEW_MAX + 2 * LANES_WIDTH] = {0.0};
    struct few_floors now;
    struct few_works works;
    double time = s->time, ground = s->ground_a[0];
    few_load(s, lines, n, &now);
    few_load_works(f->energy, &works);
    few_get_peaks(t, f->results, n);
    if (lines) {
        few_get_lines(t, lines, n);
    }
    long step = from;
    for (; step < end; step++) {
        struct few_floors next;
        lanes_bits beyond = {0}, news = {0};
        const long ahead = step + 1 - f->ahead_from;
        few_step(w, lines, n, &now, f->ground[ahead], shown, &next, &beyond);
        few_compare(peak, lines, n, &next, f->ground[ahead], &news);
        few_look(f, shown, &news);
        news |= beyond;
        if (floors_any(&news) < 0 &&
            (floors_any(&beyond) < 0 ||
             !few_take_note(f, lines, n, &next, shown, f->time[ahead], f->ground[ahead], s))) {
            break;
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

// Vectors of a model, of which there are two numbers, so that loops over them can be unrolled.
LANES_INLINE bool is_low(const struct model *m) {
    return m->n_dof <= FEW_MAX / 2;
}

LANES static long fly(const struct flight *f, struct state *s, long n, long end) {
    return is_low(f->model) ? few_fly(f, NULL, VECTORS / 2, s, n, end)
                            : few_fly(f, NULL, VECTORS, s, n, end);
}

LANES static long fly_on_lines(const struct flight *f, struct state *s, long n, long end) {
    const struct floors_lines lines = floors_lines_of(f, s);
    return is_low(f->model) ? few_fly(f, &lines, VECTORS / 2, s, n, end)
                            : few_fly(f, &lines, VECTORS, s, n, end);
}

long few_take(const struct flight *f, struct state *s, long n, long end) {
    return f->yields ? fly_on_lines(f, s, n, end) : fly(f, s, n, end);
}

bool few_serves(const struct work *w) {
    return w->few.possible && w->model->n_storey_history == 0 && w->effective == w->home &&
           w->h == w->model->dt;
}

// Takes the forces of live links into the residuals.
static void push(const struct model *m, const struct state *s, double *residual) {
    for (int i = 0; i < s->n_live; i++) {
        int k = s->live[i];
        const int *dof = m->link[k].dof;
        if (dof[0] != WALL) {
            residual[dof[0]] -= s->link[k].force;
        }
        if (dof[1] != WALL) {
            residual[dof[1]] += s->link[k].force;
        }
    }
}

LANES_INLINE bool move(struct work *w, const struct state *now, struct state *next, int n) {
    alignas(LINE) double residual[FEW_MAX];
    struct few_floors start, trial, end;
    lanes q[VECTORS];
    lanes_bits sign = {0};
    few_load(now, NULL, n, &start);
    few_try(w, NULL, n, &start, next->ground_a[0], &trial, residual, &sign);
    push(w->model, next, residual);
    few_solve(&w->few, n, residual, q);
    few_reach(w, n, &start, &trial, q, &end);
    few_put(trial.u, n, w->u_trial);
    few_put(trial.v, n, w->v_trial);
    few_put(q, n, w->correction);
    few_store(&end, NULL, n, next);
    EACH_VECTOR(j, n) {
        lanes size = ABSOLUTE(end.u[j]) + ABSOLUTE(end.v[j]) + ABSOLUTE(end.a[j]);
        sign |= BEYOND(size, DBL_MAX + none);
    }
    return floors_any(&sign) >= 0;
}

LANES bool few_move(struct work *w, const struct state *now, struct state *next) {
    few_factor(&w->few, w);
    return is_low(w->model) ? move(w, now, next, VECTORS / 2) : move(w, now, next, VECTORS);
}

LANES_INLINE void correct(const struct work *w, const struct state *now, struct state *next,
                          int n) {
    struct few_floors start, trial, end;
    lanes q[VECTORS];
    EACH_VECTOR(j, n) {
        start.a[j] = PART(now->a, j);
        trial.u[j] = PART(w->u_trial, j);
        trial.v[j] = PART(w->v_trial, j);
        q[j] = PART(w->correction, j);
    }
    few_reach(w, n, &start, &trial, q, &end);
    few_store(&end, NULL, n, next);
}

LANES void few_correct(const struct work *w, const struct state *now, struct state *next) {
    is_low(w->model) ? correct(w, now, next, VECTORS / 2) : correct(w, now, next, VECTORS);
}

LANES_INLINE void account(const struct few_table *t, struct energy_account *a, struct results *r,
                          const struct state *now, const struct state *next, int n) {
    struct few_floors start, end;
    struct few_works works;
    lanes_bits sign = {0};
    few_load(now, NULL, n, &start);
    few_load(next, NULL, n, &end);
    few_strain(t, NULL, n, &end, &sign);
    few_load_works(a, &works);
    few_add_works(t, n, &start, &end, now->ground_a[0] + next->ground_a[0], &works);
    few_store_works(&works, a);
    few_compare(r->peak, NULL, n, &end, next->ground_a[0], &sign);
    if (floors_any(&sign) < 0) {
        (void)few_raise(r, n, &end, next->time, next->ground_a[0]);
        peaks_speed(r, 0, n * LANES_VECTOR);
    }
}

LANES void few_account(const struct few *few, struct energy_account *a, struct results *r,
                       const struct model *m, const struct state *now, const struct state *next) {
    is_low(m) ? account(few->table, a, r, now, next, VECTORS / 2)
              : account(few->table, a, r, now, next, VECTORS);
}
