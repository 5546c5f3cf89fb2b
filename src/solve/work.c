// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/work.h"

#include <assert.h>
#include <math.h>
#include <string.h>

#include "core/arena.h"
#include "core/lanes.h"
#include "solve/contact/contact.h"

static bool work_alloc_floors(struct work *w, const struct model *m, struct arena *a) {
    struct storeys *s = &w->storeys;
    w->u_trial = lanes_array(a, m->n_dof);
    w->v_trial = lanes_array(a, m->n_dof);
    w->correction = lanes_array(a, m->n_dof);
    s->drift = lanes_array(a, m->n_dof);
    s->shear = lanes_array(a, m->n_dof);
    s->rate = lanes_array(a, m->n_dof);
    return floors_alloc(w, a);
}

static bool work_alloc_links(struct work *w, const struct model *m, const struct results *r,
                             struct arena *a) {
    size_t n_link = (size_t)m->n_link;
    w->link = lanes_lines(a, n_link, sizeof *w->link);
    w->acting = arena_alloc(a, n_link, sizeof(void *));
    w->rigid = arena_alloc(a, n_link, sizeof *w->rigid);
    w->toggled = arena_alloc(a, n_link, sizeof *w->toggled);
    return gaps_alloc(&w->gaps, m, r, a) && cluster_alloc(&w->clusters, m, a);
}

// The most links with a force law at any floor, by their weights, counted in `count` (n_dof), which
// is 0 before and after.
static double work_most_links(const struct model *m, double *count) {
    double most = 1.0;
    for (int i = 0; i < 2 * m->n_link; i++) {
        const struct link *l = &m->link[i / 2];
        for (int j = 0, n = l->law->force ? link_entries(l, i % 2) : 0; j < n; j++) {
            const struct link_entry e = link_entry(l, i % 2, j);
            count[e.dof] += fabs(e.weight);
            most = fmax(most, count[e.dof]);
        }
    }
    memset(count, 0, (size_t)m->n_dof * sizeof *count);
    return most;
}

static void work_fill_links(struct work *w, const struct model *m, struct arena *a) {
    for (int k = 0; k < m->n_link && sweep_init(&w->link[k], m, k, a); k++) {
        w->link[k].resolved = &w->memory->resolved[k];
        w->commits |= m->link[k].law->commit != NULL;
        if (m->link[k].law->rebound) {
            w->rigid[w->n_rigid++] = k;
        }
    }
}

bool work_alloc(struct work *w, const struct model *m, struct results *r, struct memory *memory,
                struct arena *a) {
    *w = (struct work){
        .model = m,
        .totals = &r->totals,
        .memory = memory,
        .ahead.from = -FORCING_AHEAD,
        .held = -1,
        .lost = -1,
    };
    size_t n = (size_t)m->n_body;
    w->home = arena_alloc(a, n, sizeof *w->home);
    w->other = arena_alloc(a, n, sizeof *w->other);
    w->effective = w->home;
    if (!work_alloc_floors(w, m, a) || !work_alloc_links(w, m, r, a)) {
        return false;
    }
    work_fill_links(w, m, a);
    w->most_links = work_most_links(m, w->correction);
    return effective_alloc(w->home, m->building, m->n_body, EFFECTIVE_LONG, a) &&
           effective_alloc(w->other, m->building, m->n_body, EFFECTIVE_BRIEFLY, a);
}

// Factorises building k of `e` unless it is there for b, g and the tangents last used. Parts that
// are not linear have others in every step, which factorises by itself.
static int work_refactor(struct work *w, struct effective *e, int k) {
    const struct building *g = e[k].building;
    const double *tangent = w->memory->tangent + g->first;
    size_t size = (size_t)g->n_dof * sizeof *tangent;
    if (g->n_part > 0 && g->smooth) {
        return STATUS_OK;
    }
    const double *parts = w->memory->part_tangent + g->part_tangent;
    const size_t parts_size =
        g->predictable ? (size_t)(building_n_tangent(g) - g->n_dof) * sizeof *parts : 0;
    double *own_parts = e[k].tangent + g->n_dof;
    bool same = g->elastic || (memcmp(e[k].tangent, tangent, size) == 0 &&
                               memcmp(own_parts, parts, parts_size) == 0);
    if (same && e[k].b == w->b && e[k].g == w->g) {
        return STATUS_OK;
    }
    memmove(e[k].tangent, tangent, size);
    memmove(own_parts, parts, parts_size);
    return effective_factor(&e[k], w->b, w->g);
}

void work_resume(struct work *w) {
    lanes_assert(w->u_trial, w->model->n_dof);
    lanes_assert(w->v_trial, w->model->n_dof);
    lanes_assert(w->correction, w->model->n_dof);
    const double h = w->h;
    const long factors = w->factors;
    for (int k = 0; k < w->model->n_body; k++) {
        effective_resume(&w->home[k]);
    }
    for (int k = 0; k < w->model->n_link; k++) {
        w->link[k].factors = 0;
    }
    w->h = 0.0;
    if (h > 0.0) {
        (void)work_factor(w, h);  // it has been possible before
    }
    w->factors = factors;
    gaps_resume(&w->gaps);
}

int work_factor(struct work *w, double h) {
    if (w->h == h) {
        return STATUS_OK;
    }
    assert(h > 0.0);
    struct effective *e = h == w->model->dt ? w->home : w->other;
    w->h = 0.0;
    w->factors++;
    w->b = w->model->beta * h * h;
    w->g = w->model->gamma * h;
    w->per_b = 1.0 / w->b;
    w->per_g = 1.0 / w->g;
    for (int k = 0; k < w->model->n_body; k++) {
        int status = work_refactor(w, e, k);
        if (status != STATUS_OK) {
            return status;
        }
    }
    w->effective = e;
    w->h = h;
    return STATUS_OK;
}
