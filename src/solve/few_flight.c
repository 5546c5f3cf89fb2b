// SPDX-License-Identifier: GPL-3.0-or-later
// Free flight of few floors. Between steps all is in registers but for the displacements, which the
// gaps want.
#include "solve/few_loops.h"

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
        const long ahead = step + 1 - w->ahead.from;
        few_step(w, lines, n, &now, w->ahead.ground[ahead], shown, &next, &beyond);
        few_compare(peak, lines, n, &next, w->ahead.ground[ahead], &news);
        few_look(f, shown, &news);
        news |= beyond;
        if (floors_any(&news) < 0 &&
            (floors_any(&beyond) < 0 ||
             !few_take_note(f, lines, n, &next, shown, w->ahead.time[ahead], w->ahead.ground[ahead],
                            s))) {
            break;
        }
        few_add_works(t, n, &now, &next, ground + w->ahead.ground[ahead], &works);
        if (lines) {
            few_add_storey_works(n, &now, &next, f->energy->storey_2x);
        }
        now = next;
        time = w->ahead.time[ahead];
        ground = w->ahead.ground[ahead];
    }
    few_store(&now, lines, n, s);
    few_store_works(&works, f->energy);
    s->time = time;
    s->ground_a[0] = ground;
    return step;
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
