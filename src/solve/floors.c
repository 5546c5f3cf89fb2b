// SPDX-License-Identifier: GPL-3.0-or-later
// One step of Newmark's method, where all is linear but for the links, whose forces f are given:
// the blocks that floors are taken in, and what links bring to them. The loops are in
// floor_steps.h.
#include "solve/floors.h"

#include <math.h>
#include <string.h>

#include "core/arena.h"
#include "core/number.h"
#include "solve/contact.h"
#include "solve/flight.h"

// So many floors make a block, and what is solved together.
enum { FLOORS_LEAST = 192 };

// Buildings from k on that make up a block.
static int block_size(const struct model *m, int k) {
    int n = 0;
    int floors = 0;
    while (k + n < m->n_building && floors < FLOORS_LEAST) {
        const struct building *b = &m->building[k + n];
        int alike = effective_alike(b, m->n_building - k - n);
        floors += alike * b->n_floor;
        n += alike;
    }
    return n;
}

static struct floor_block block_from(const struct model *m, int k, int first) {
    struct floor_block b = {.building = k, .n_building = block_size(m, k), .first = first};
    const struct building *last = &m->building[k + b.n_building - 1];
    int end = last->first + last->n_floor;
    b.n = lanes_whole(end) - first;
    b.end = k + b.n_building < m->n_building ? end / LANES_WIDTH * LANES_WIDTH : lanes_whole(end);
    return b;
}

bool floors_alloc(struct floors *f, const struct model *m, struct arena *a) {
    int most = 0;
    *f = (struct floors){
        .block = arena_alloc(a, (size_t)m->n_building, sizeof *f->block),
        .first_end = arena_alloc(a, (size_t)m->n_building, sizeof *f->first_end),
        .following_end = arena_alloc(a, 2 * (size_t)m->n_link, sizeof *f->following_end),
    };
    if (!f->block || !f->first_end || !f->following_end) {
        return false;
    }
    for (int k = 0, first = 0; k < m->n_building; f->n_block++) {
        struct floor_block b = block_from(m, k, first);
        f->block[f->n_block] = b;
        most = b.n > most ? b.n : most;
        first = b.end;
        k += b.n_building;
    }
    for (int k = 0; k < m->n_building; k++) {
        f->first_end[k] = -1;
    }
    f->residual = lanes_array(a, most + 2 * LANES_WIDTH);
    f->u_trial = lanes_array(a, most);
    f->v_trial = lanes_array(a, most);
    return f->residual && f->u_trial && f->v_trial;
}

// Lists the ends of live links by building, in the order of the links.
static void list_ends(struct floors *f, const struct gaps *gaps, const struct state *s) {
    for (int i = s->n_live - 1; i >= 0; i--) {
        const struct gap_run *run = &gaps->run[gaps->run_of[s->live[i]]];
        for (int side = 1; side >= 0; side--) {
            int end = 2 * s->live[i] + side;
            int k = run->building[side];
            if (k != WALL) {
                f->following_end[end] = f->first_end[k];
                f->first_end[k] = end;
            }
        }
    }
}

// Takes the forces of live links into the residual of a block, and the trial of their buildings for
// the contact iteration. The lists are used up.
void floors_push(struct work *w, const struct state *now, const struct state *next,
                 const struct floor_block *b) {
    const struct model *m = w->model;
    struct floors *f = &w->floors;
    for (int k = b->building; k < b->building + b->n_building; k++) {
        if (f->first_end[k] >= 0) {
            floors_trial(w, now, k);
        }
        for (int end = f->first_end[k]; end >= 0; end = f->following_end[end]) {
            double force = next->link[end / 2].force;
            f->residual[m->link[end / 2].dof[end % 2] - b->first] += end % 2 == 0 ? -force : force;
        }
        f->first_end[k] = -1;
    }
}

void floors_trial(struct work *w, const struct state *now, int k) {
    const struct building *g = &w->model->building[k];
    const struct chain part = {.n = lanes_whole(g->n_floor)};
    const int i = g->first;
    chain_trial(&part, w->h, now->u + i, now->v + i, now->a + i, w->u_trial + i, w->v_trial + i);
}

void floors_defer(struct floors_late *late, const struct state *now) {
    late->due = true;
    late->time = now->time;
    late->ground_a = now->ground_a[0];
}

// Those with the widest vectors that the processor has registers for.
static const struct floors_steps *steps(void) {
    return LANES_WIDEST_OF(&floors_wide, &floors_narrow);
}

void floors_settle(struct floors_late *late, const struct model *m, const struct state *old,
                   const struct state *now) {
    if (late->possible) {
        steps()->settle(late, m, old, now);
        peaks_speed(late->results, 0, m->n_dof);
    }
}

double floors_speed(const struct work *w, const struct state *now) {
    const struct floors_late *late = &w->floors.late;
    double speed = w->totals->speed;
    for (int i = 0, n = late->possible ? w->model->n_dof : 0; i < n; i++) {
        double peak = late->results->peak[PEAK_VELOCITY][i];
        speed = number_max(speed, number_max(peak, fabs(now->v[i])));
    }
    return speed;
}

void floors_account(struct energy_account *a, struct results *r, const struct model *m,
                    const struct state *now, const struct state *next) {
    energy_step(a, m, now, next);
    steps()->raise(r, m, next);
    peaks_speed(r, 0, m->n_dof);
}

bool floors_move(struct work *w, const struct state *now, struct state *next) {
    list_ends(&w->floors, &w->gaps, next);
    return steps()->move(w, now, next);
}

bool floors_fly(const struct flight *f, const struct state *now, struct state *next) {
    return steps()->fly(f, now, next);
}

bool floors_fly_on_lines(const struct flight *f, const struct state *now, struct state *next) {
    return steps()->fly_on_lines(f, now, next);
}
