// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/pace.h"

#include <math.h>

// Share of the expected motion that counts as its size from the start.
static const double EXPECTED = 1e-2;

// A building that has hardly moved yet is measured by a hundredth of the largest motion of any:
// otherwise the first touch of a building at rest would take steps without end.
static const double SHARE = 1e-2;

// An error of the velocity in the fastest motion, of circular frequency omega, is one of the
// acceleration omega times as large. It lasts for N = omega * memory radians, and those of all
// steps in that time add up: it counts N^2 / (N + MANY) WEIGHT times. With this weight the errors
// of accelerations and forces are below ten times the tolerance where something is stiff, which
// `make verification` shows (stiff.md); with MANY radians motions that decay at once cost no steps.
static const double WEIGHT = 0.03, MANY = 100.0;

static const struct fields_row list[] = {
    FIELD_ARRAY(struct scales, over_u, FIELD_FLOORS),
    FIELD_ARRAY(struct scales, over_v, FIELD_FLOORS),
    FIELD_VALUES(struct scales, most_u, noisy),
};
const struct fields scale_fields = FIELDS(list);

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
    for (int k = 0; k < m->n_body; k++) {
        time = fmin(time, 1.0 / m->building[k].omega[0]);
    }
    s->most_a = acceleration;
    s->most_v = EXPECTED * acceleration * time;
    s->most_u = s->most_v * time;
}

static double scale_largest_of(const double *x, const struct building *g) {
    double largest = 0.0;
    for (int i = g->first; i < g->first + g->n_dof; i++) {
        largest = x[i] > largest ? x[i] : largest;
    }
    return largest;
}

// Where nothing moves, nothing is expected to and nothing is wrong.
static double scale_over(double size) {
    return size > 0.0 ? 1.0 / size : 0.0;
}

// One over the size of velocities of building k by which their errors are as bad as those of its
// accelerations.
static double scale_over_accelerations(struct scales *s, const struct model *m,
                                       const struct results *r, int k) {
    const struct building *g = &m->building[k];
    double a = fmax(scale_largest_of(r->peak[PEAK_ACCELERATION], g), SHARE * s->most_a);
    double u = fmax(scale_largest_of(r->peak[PEAK_DISPLACEMENT], g), SHARE * s->most_u);
    double omega = sqrt(s->square[k]);
    double radians = omega * s->memory[k];
    double weight = WEIGHT * radians * radians / (radians + MANY);
    double wanted = weight * omega * scale_over(a);
    double possible = m->control.tolerance * scale_over(DBL_EPSILON * omega * u);
    s->noisy = u > 0.0 && wanted > possible ? k : s->noisy;
    return u > 0.0 ? fmin(wanted, possible) : wanted;
}

void scale_update(struct scales *s, const struct model *m, const struct results *r) {
    const double *u = r->peak[PEAK_DISPLACEMENT];
    const double *v = r->peak[PEAK_VELOCITY];
    for (int i = 0; i < m->n_dof; i++) {
        s->most_u = u[i] > s->most_u ? u[i] : s->most_u;
        s->most_v = v[i] > s->most_v ? v[i] : s->most_v;
    }
    s->noisy = -1;
    for (int k = 0; k < m->n_body; k++) {
        const struct building *g = &m->building[k];
        double of_u = scale_over(fmax(scale_largest_of(u, g), SHARE * s->most_u));
        double of_v = scale_over(fmax(scale_largest_of(v, g), SHARE * s->most_v));
        of_v = s->square ? fmax(of_v, scale_over_accelerations(s, m, r, k)) : of_v;
        for (int i = g->first; i < g->first + g->n_dof; i++) {
            s->over_u[i] = of_u;
            s->over_v[i] = of_v;
        }
    }
}
