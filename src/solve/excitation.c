// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/excitation.h"

#include <string.h>

#include "solve/floors/chain.h"

// With one ground under all, nothing depends on its velocity and displacement.
static void excitation_grounds(struct state *s, const struct model *m, double t) {
    for (int k = 0; k < m->n_ground; k++) {
        const struct ground *g = &m->ground[k];
        s->ground_a[k] = s->ground_v[k] = s->ground_u[k] = 0.0;
        for (int i = 0; i < g->n_signal; i++) {
            s->ground_a[k] += signal_value(&g->signal[i], t);
        }
    }
    if (m->n_ground > 1) {
        forcing_integrals(m, t, &(struct forcing_values){.v = s->ground_v, .u = s->ground_u});
    }
}

static void excitation_fill(double *x, int n, double value) {
    for (int i = 0; i < n; i++) {
        x[i] = value;
    }
}

// The ground's accelerations under the floors, and their inertia.
static void excitation_base_and_inertia(struct state *s, const struct model *m) {
    if (m->n_ground == 1) {
        excitation_fill(s->base, m->n_dof, s->ground_a[0]);
    } else {
        for (int k = 0; k < m->n_building; k++) {
            const struct building *g = &m->building[k];
            excitation_fill(s->base + g->first, g->n_floor, s->ground_a[g->ground]);
        }
    }
    chain_inertia(&m->chain, s->base, s->external);
}

void excitation_floors(struct state *s, const struct model *m, double t) {
    excitation_base_and_inertia(s, m);
    for (int k = 0; k < m->n_load; k++) {
        s->external[m->load[k].dof] += signal_value(&m->load[k].signal, t);
    }
}

void excitation_at(struct state *s, const struct model *m, double t) {
    excitation_grounds(s, m, t);
    excitation_floors(s, m, t);
}

void excitation_of_pieces(struct state *s, const struct forcing *f, double t) {
    const struct model *m = f->model;
    struct forcing_values ground = {.a = s->ground_a, .v = s->ground_v, .u = s->ground_u};
    forcing_ground(f, t, &ground);
    excitation_base_and_inertia(s, m);
    for (int k = 0; k < m->n_load; k++) {
        s->external[m->load[k].dof] += forcing_load(f, k, t);
    }
}

static void excitation_compute_ahead(struct excitation_ahead *x, const struct model *m, long n) {
    x->from = n;
    model_times(m, n, EXCITATION_AHEAD, x->time);
    memset(x->ground, 0, sizeof x->ground);
    const struct ground *g = &m->ground[0];
    for (int i = 0; state_is_uniform(m) && i < g->n_signal; i++) {
        signal_add_values(&g->signal[i], EXCITATION_AHEAD, x->time, x->ground);
    }
}

void excitation_foresee(struct excitation_ahead *x, const struct model *m, long n) {
    if (n < x->from || n >= x->from + EXCITATION_AHEAD) {
        excitation_compute_ahead(x, m, n);
    }
    x->sought = n - x->from;
}

void excitation_grounds_known(const struct excitation_ahead *x, struct state *s,
                              const struct model *m, double t) {
    if (state_is_uniform(m) && x->time[x->sought] == t) {
        s->ground_a[0] = x->ground[x->sought];
    } else {
        excitation_grounds(s, m, t);
    }
}
