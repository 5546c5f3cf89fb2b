// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/scale.h"

#include <math.h>

#include "core/arena.h"
#include "core/lanes.h"

// Share of the expected motion that counts as its size from the start.
static const double EXPECTED = 1e-2;

// A building that has hardly moved yet is measured by a hundredth of the largest motion of any:
// otherwise the first touch of a building at rest would take steps without end.
static const double SHARE = 1e-2;

bool scale_alloc(struct scales *s, const struct model *m, struct arena *a) {
    s->over_u = lanes_array(a, m->n_dof);
    s->over_v = lanes_array(a, m->n_dof);
    return !arena_failed(a);
}

void scale_expect(struct scales *s, const struct model *m) {
    double acceleration = 0.0;
    double time = m->duration;
    for (int k = 0; k < m->n_ground; k++) {
        for (int i = 0; i < m->ground[k].n_signal; i++) {
            acceleration = fmax(acceleration, signal_peak(&m->ground[k].signal[i]));
        }
    }
    for (int k = 0; k < m->n_load; k++) {
        acceleration =
            fmax(acceleration, signal_peak(&m->load[k].signal) / m->mass[m->load[k].dof]);
    }
    for (int k = 0; k < m->n_building; k++) {
        time = fmin(time, 1.0 / m->building[k].omega[0]);
    }
    s->most_v = EXPECTED * acceleration * time;
    s->most_u = s->most_v * time;
}

static double largest_of(const double *x, const struct building *g) {
    double largest = 0.0;
    for (int i = g->first; i < g->first + g->n_floor; i++) {
        largest = x[i] > largest ? x[i] : largest;
    }
    return largest;
}

// Where nothing moves, nothing is expected to and nothing is wrong.
static double over(double size) {
    return size > 0.0 ? 1.0 / size : 0.0;
}

void scale_update(struct scales *s, const struct model *m, const struct results *r) {
    const double *u = r->peak[PEAK_DISPLACEMENT];
    const double *v = r->peak[PEAK_VELOCITY];
    for (int i = 0; i < m->n_dof; i++) {
        s->most_u = u[i] > s->most_u ? u[i] : s->most_u;
        s->most_v = v[i] > s->most_v ? v[i] : s->most_v;
    }
    for (int k = 0; k < m->n_building; k++) {
        const struct building *g = &m->building[k];
        double of_u = over(fmax(largest_of(u, g), SHARE * s->most_u));
        double of_v = over(fmax(largest_of(v, g), SHARE * s->most_v));
        for (int i = g->first; i < g->first + g->n_floor; i++) {
            s->over_u[i] = of_u;
            s->over_v[i] = of_v;
        }
    }
}
