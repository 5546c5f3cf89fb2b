// SPDX-License-Identifier: GPL-3.0-or-later
// Linear links in flight. Let q_0 = A^-1 r be the corrections without their forces, and y = k d + c
// v the forces at the end of the step that q_0 leads to. With D = diag(beta h^2 k + gamma h c) and
// the flexibility S = B A^-1 B' of contact.c the links' forces are
//     f = y - D S f,   hence   f = (I + D S)^-1 y   and   q = q_0 - A^-1 B' f.
#include "solve/newmark/newmark.h"

#include <gsl/gsl_linalg.h>
#include <math.h>
#include <string.h>

#include "core/arena.h"
#include "core/lanes.h"
#include "law/bilateral.h"
#include "solve/contact/contact.h"
#include "solve/forcing.h"

// Finds the runs of contacts that can be checked after each block of floors, as both ends are
// known.
static void flight_find_runs(struct flight *f) {
    const struct floor_block *block = f->work->floors.block;
    const struct gaps *gaps = &f->work->gaps;
    for (int i = 0, k = 0; k < f->work->floors.n_block; k++) {
        const int next = block[k].building + block[k].n_building;
        while (i < gaps->n_run && gaps->run[i].first < f->model->n_contact &&
               gaps->run[i].building[0] < next && gaps->run[i].building[1] < next) {
            i++;
        }
        f->run_end[k] = i;
    }
}

// More links than this are left to the iteration of contact.c, whose effort grows with their
// number, and not with its square.
enum { LINKS_MAX = 100 };

// Have all contacts a law of force, and floors at their ends? Are all links linear and few, all
// storeys of straight lines, and buildings with full matrices elastic? Floors of linked buildings
// must be in one block, as they are solved for together. Limits of drift are seen as ends of lines.
static bool flight_is_possible(const struct model *m, const struct floors *floors) {
    const int n_link = m->n_link - m->n_contact;
    bool possible = (m->elastic || !(m->chain.full_damping || m->chain.parts)) &&
                    !m->storeys_differ && n_link <= LINKS_MAX &&
                    (n_link == 0 || floors->n_block == 1) && !(m->collapse && state_is_linear(m));
    for (int k = 0; k < m->n_link; k++) {
        const struct link *l = &m->link[k];
        possible = possible && (l->bilateral ? bilateral_is_linear(l->law, l->constant)
                                             : !l->law->rebound && link_is_plain(l));
    }
    for (int i = 0; i < m->n_dof; i++) {
        // The shear of a line less P-delta would have other last bits.
        possible = possible && m->storey[i].law->branch && m->storey[i].pdelta == 0.0;
    }
    return possible;
}

// How far storey i may go on its line: not to its limit of drift, as seen from the rest of the
// line.
static double flight_limit(const struct model *m, int i, const struct storey_branch *b) {
    const double most = m->collapse ? m->collapse[i] : INFINITY;
    if (isinf(most)) {
        return b->limit;
    }
    return b->spring > 0.0 ? fmin(b->limit, b->spring * (most - fabs(b->rest))) : -1.0;
}

// Finds the lines that the storeys are on. Are the buildings factorised for them, and do low ones
// have their inverse?
static bool flight_find_lines(struct flight *f, const double *history) {
    bool factorised = true;
    for (int k = 0; k < f->model->n_body; k++) {
        const struct effective *e = &f->work->effective[k];
        const struct building *g = e->building;
        for (int i = 0; i < g->n_dof; i++) {
            const int at = g->first + i;
            const struct storey *s = &f->model->storey[at];
            const double *h = s->law->n_history > 0 ? history + s->history : NULL;
            const struct storey_branch b = s->law->branch(s->constant, h);
            f->back[at] = b.back;
            f->spring[at] = b.spring;
            f->rest[at] = b.rest;
            f->limit[at] = flight_limit(f->model, at, &b);
            factorised &= g->elastic || e->tangent[i] == b.back + b.spring;
        }
        factorised &= !effective_prefers_inverse(e) || effective_has_inverse(e);
    }
    return factorised;
}

bool flight_alloc(struct flight *f, struct work *w, struct impact_log *impacts, struct arena *a) {
    const struct model *m = w->model;
    *f = (struct flight){
        .model = m,
        .work = w,
        .account = &w->floors.account,
        .impacts = impacts,
        .possible = flight_is_possible(m, &w->floors),
        .on_lines = !state_is_linear(m),
        .uniform = state_is_uniform(m),
    };
    f->n_link = f->possible ? m->n_link - m->n_contact : 0;
    f->transfer = arena_alloc(a, (size_t)f->n_link * (size_t)f->n_link, sizeof *f->transfer);
    f->order = arena_alloc(a, (size_t)f->n_link, sizeof *f->order);
    f->force = arena_alloc(a, (size_t)f->n_link, sizeof *f->force);
    f->run_end = arena_alloc(a, (size_t)m->n_body, sizeof *f->run_end);
    f->back = lanes_array(a, m->n_dof);
    f->spring = lanes_array(a, m->n_dof);
    f->rest = lanes_array(a, m->n_dof);
    f->limit = lanes_array(a, m->n_dof);
    if (arena_failed(a)) {
        return false;
    }
    if (f->possible) {
        flight_find_runs(f);
    }
    return true;
}

// Finds (I + D S)^-1 for the factors at hand. Column i of S is what links see of the accelerations
// that a unit force of link i causes. The matrix is similar to a positive definite one.
static void flight_find_transfer(struct flight *f) {
    struct work *w = f->work;
    struct link_scratch *link = w->link + f->model->n_contact;
    const double unit = -1.0;
    double *entry = f->transfer;
    for (int i = 0; i < f->n_link; i++) {
        memset(w->correction, 0, (size_t)f->model->n_dof * sizeof *w->correction);
        sweep_find_columns(w, &link[i]);
        sweep_push(w, &link[i], &unit);
        for (int j = 0; j < f->n_link; j++, entry++) {
            const double *c = link[j].constant;
            const double d = w->b * c[BILATERAL_STIFFNESS] + w->g * c[BILATERAL_DASHPOT];
            *entry = (i == j) + d * sweep_across(&link[j], w->correction);
        }
    }
    const size_t n = (size_t)f->n_link;
    gsl_matrix_view matrix = gsl_matrix_view_array(f->transfer, n, n);
    gsl_permutation order = {.size = n, .data = f->order};
    int sign;
    (void)gsl_linalg_LU_decomp(&matrix.matrix, &order, &sign);
    (void)gsl_linalg_LU_invx(&matrix.matrix, &order);
    f->factors = w->factors;
}

LANES void flight_join(const struct flight *f, const struct state *now, struct state *next) {
    struct work *w = f->work;
    const int first = f->model->n_contact, n = f->n_link;
    const double *column = f->transfer;
    double *restrict force = f->force;
    memset(force, 0, (size_t)n * sizeof *force);
    for (int i = 0; i < n; i++, column += n) {
        struct link_scratch *p = &w->link[first + i];
        sweep_prepare(w, next, p);
        const double q = sweep_across(p, w->correction);
        const double y = p->constant[BILATERAL_STIFFNESS] * (p->d_trial + w->b * q) +
                         p->constant[BILATERAL_DASHPOT] * (p->v_trial + w->g * q);
        for (int j = 0; j < n; j++) {
            force[j] += y * column[j];
        }
    }
    for (int i = 0; i < n; i++) {
        next->link[first + i] = state_carry_on(&now->link[first + i], PAST_STEPS);
        next->link[first + i].force = force[i];
        sweep_push(w, &w->link[first + i], &force[i]);
    }
}

void flight_account_links(const struct flight *f, const struct state *now, struct state *next) {
    for (int k = f->model->n_contact; k < f->model->n_link; k++) {
        next->delta[k] = state_penetration(next, f->model, k);
    }
    (void)impacts_step(f->impacts, now, next, NULL);  // none opens, which alone can fail
    peaks_columns(f->account->results, f->model, next);
}

// A storey that has left its line in the last step most likely will again in the next.
bool flight_is_on_lines(struct flight *f, const struct state *before, const struct state *s) {
    const size_t histories = (size_t)f->model->n_storey_history * sizeof *s->storey_history;
    return memcmp(before->storey_history, s->storey_history, histories) == 0 &&
           (!f->on_lines || flight_find_lines(f, s->storey_history));
}

static bool flight_may_start(struct flight *f, const struct state *before, const struct state *s) {
    return f->possible && s->n_live <= f->n_link && f->work->h == f->model->dt &&
           flight_is_on_lines(f, before, s);
}

long flight_take(struct flight *f, struct state **now, struct state **next, long n, long end) {
    const struct model *m = f->model;
    struct work *w = f->work;
    const long first = n;
    if (f->uniform) {
        forcing_foresee(&w->ahead, m, n + 1);
    }
    if (!flight_may_start(f, *next, *now)) {
        return n;
    }
    contact_begin(w, *now, *next);
    memcpy((*next)->storey_history, (*now)->storey_history,
           (size_t)m->n_storey_history * sizeof *(*now)->storey_history);
    if (f->n_link > 0 && f->factors != w->factors) {
        flight_find_transfer(f);
    }
    n = floors_fly(f, now, next, n, end < m->n_step ? end : m->n_step - 1);  // it may be shorter
    if (n == first) {
        return n;
    }
    // Accounts for these steps.
    struct state *s = *now;
    if (f->on_lines) {
        floors_catch_up(w, *next, s);
    }
    gaps_update(&w->gaps, s, NULL);
    gaps_peaks(&w->gaps, s);
    w->totals->steps += n - first;
    w->totals->iterations += n - first;
    return n;
}
