// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/work.h"

#include "core/arena.h"

// Clusters beyond this size are left to sweeps: the block matrix is full.
enum { BLOCK_MAX = 400 };

static bool alloc_arrays(struct work *w, const struct model *m, struct arena *a) {
    size_t n_dof = (size_t)m->n_dof;
    size_t n_link = (size_t)m->n_link;
    size_t n_block = (size_t)w->block_max;
    struct {
        double **array;
        size_t n;
    } part[] = {
        {&w->u_predicted, n_dof}, {&w->v_predicted, n_dof},
        {&w->residual, n_dof},    {&w->kept_a, n_dof},
        {&w->kept_f, n_link},     {&w->vector, 2 * n_block},
        {&w->weight, n_block},    {&w->matrix, n_block * n_block},
    };
    for (size_t i = 0; i < sizeof part / sizeof part[0]; i++) {
        *part[i].array = arena_alloc(a, part[i].n, sizeof(double));
        if (!*part[i].array) {
            return false;
        }
    }
    w->active = arena_alloc(a, n_link, sizeof *w->active);
    w->is_active = arena_alloc(a, n_link, sizeof *w->is_active);
    w->branch = arena_alloc(a, n_link, sizeof *w->branch);
    return w->active && w->is_active && w->branch;
}

bool work_alloc(struct work *w, const struct model *m, struct totals *totals, struct arena *a) {
    *w = (struct work){
        .model = m,
        .totals = totals,
        .unresolved = -1,
        .held = -1,
        .block_max = m->n_link < BLOCK_MAX ? m->n_link : BLOCK_MAX,
    };
    size_t n = (size_t)m->n_building;
    w->effective = arena_alloc(a, n, sizeof *w->effective);
    w->settled = arena_alloc(a, n, sizeof *w->settled);
    if (!w->effective || !w->settled || !alloc_arrays(w, m, a)) {
        return false;
    }
    for (int k = 0; k < m->n_building; k++) {
        if (!effective_alloc(&w->effective[k], &m->building[k], a)) {
            return false;
        }
    }
    return true;
}

int work_factor(struct work *w, double h) {
    if (w->h == h) {
        return STATUS_OK;
    }
    w->h = 0.0;
    w->b = w->model->beta * h * h;
    w->g = w->model->gamma * h;
    for (int k = 0; k < w->model->n_building; k++) {
        int status = effective_factor(&w->effective[k], w->b, w->g);
        if (status != STATUS_OK) {
            return status;
        }
    }
    w->h = h;
    return STATUS_OK;
}
