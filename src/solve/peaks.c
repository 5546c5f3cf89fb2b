// SPDX-License-Identifier: GPL-3.0-or-later
// Envelopes over every computed step.
#include <math.h>

#include "core/arena.h"
#include "solve/account.h"

const char *const peak_names[] = {"displacement", "velocity", "acceleration", "drift",
                                  "storey_shear"};

bool peaks_alloc(struct results *r, const struct model *m, struct arena *a) {
    size_t n = (size_t)m->n_dof;
    for (int q = 0; q < PEAK_COUNT; q++) {
        r->peak[q] = arena_alloc(a, n, sizeof(double));
        r->peak_time[q] = arena_alloc(a, n, sizeof(double));
        if (!r->peak[q] || !r->peak_time[q]) {
            return false;
        }
    }
    r->link = arena_alloc(a, (size_t)m->n_link, sizeof *r->link);
    for (int k = 0; r->link && k < m->n_contact; k++) {
        r->link[k].penetration = -INFINITY;
    }
    return r->link != NULL;
}

static void floors_update(struct results *r, enum peak q, const double *value, int first, int n,
                          double shift, double time) {
    double *peak = r->peak[q];
    for (int i = first; i < first + n; i++) {
        double size = fabs(value[i] + shift);
        if (size > peak[i]) {
            peak[i] = size;
            r->peak_time[q][i] = time;
        }
    }
}

static void link_update(struct link_peak *p, double force, double delta, double time) {
    if (force > p->force) {
        p->force = force;
        p->force_time = time;
    }
    if (delta > p->penetration) {
        p->penetration = delta;
        p->penetration_time = time;
    }
}

void peaks_update(struct results *r, const struct model *m, const struct state *s) {
    floors_update(r, PEAK_DISPLACEMENT, s->u, 0, m->n_dof, 0.0, s->time);
    floors_update(r, PEAK_VELOCITY, s->v, 0, m->n_dof, 0.0, s->time);
    floors_update(r, PEAK_DRIFT, s->drift, 0, m->n_dof, 0.0, s->time);
    floors_update(r, PEAK_SHEAR, s->shear, 0, m->n_dof, 0.0, s->time);
    for (int k = 0; k < m->n_building; k++) {
        const struct building *g = &m->building[k];
        floors_update(r, PEAK_ACCELERATION, s->a, g->first, g->n_floor, s->ground_a[g->ground],
                      s->time);
    }
    for (int k = 0; k < m->n_contact; k++) {
        link_update(&r->link[k], s->force[k], s->delta[k], s->time);
    }
    for (int k = m->n_contact; k < m->n_link; k++) {
        link_update(&r->link[k], fabs(s->force[k]), fabs(s->delta[k]), s->time);
    }
}
