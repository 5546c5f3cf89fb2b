// SPDX-License-Identifier: GPL-3.0-or-later
// The velocities of modes and excitations are combined by the square root of the sum of squares, as
// in response spectrum analysis (Chopra, Dynamics of Structures, section 13.7). A mode phi with the
// generalised mass m = phi^T M phi has the largest modal velocity
//     ground motion    phi^T M 1 / m times the velocity spectrum of the part of the record that
//                      acts during the analysis (exact),
//     load on floor i  phi_i / m times the velocity spectrum of the load,
//     initial state    hypot(q', omega q) with q = phi^T M u / m, that of the undamped free
//                      vibration.
// Floor i has phi_i times this velocity, and the storey below it has the drift rate phi_i -
// phi_(i-1) times this velocity. For a rigid-body mode the largest integral of the record replaces
// the spectrum. Floors of storeys that yield are slower.
#include "model/guidance.h"

#include <assert.h>
#include <gsl/gsl_math.h>
#include <math.h>

#include "core/arena.h"
#include "jostle/intensity.h"
#include "jostle/spectrum.h"

enum { MODES_MAX = 3 };                            // higher modes add little to the velocity
enum { SAMPLES_PER_CYCLE = 40, CYCLES_MAX = 50 };  // of a sine; then its response is steady
static const double RATIO_MAX = 0.99;              // largest damping ratio of a spectrum

// One mode of a building, and the sum of squares of its modal velocities.
struct mode {
    const struct model *model;
    const struct building *building;
    const double *phi;
    double omega, ratio;  // circular frequency, damping ratio
    double mass;          // generalised
    double square;        // sum of squares so far [L^2/T^2]
    struct arena *scratch;
};

// Samples the part of a sine that acts during the analysis.
static int sample_sine(const struct mode *k, const struct signal *s, struct signal *out,
                       struct error *e) {
    double cycle = 2.0 * M_PI / s->omega;
    double length = fmin(fmin(s->end, k->model->duration) - s->start, CYCLES_MAX * cycle);
    double dt = cycle / SAMPLES_PER_CYCLE;
    size_t n = (size_t)ceil(length / dt) + 1;
    double *value = arena_alloc(k->scratch, n, sizeof *value);
    if (!value) {
        return error_no_memory(e);
    }
    for (size_t i = 0; i < n; i++) {
        value[i] = s->amplitude * sin(s->omega * dt * (double)i + s->phase);
    }
    return signal_init_samples(out, k->scratch, value, n, dt, 1.0, 0.0, e);
}

// The samples of a record that act during the analysis.
static struct signal cut_samples(const struct mode *k, const struct signal *s) {
    struct signal out = *s;
    const double n = ceil((k->model->duration - s->start) / s->dt) + 1.0;
    out.n = n < (double)s->n ? (size_t)n : s->n;
    return out;
}

static double spectral_velocity(const struct mode *k, const struct signal *s) {
    if (k->omega == 0.0) {
        return intensity_of(s, 1.0).pgv;
    }
    return spectrum_velocity(s, k->omega, k->ratio);
}

// Adds the square of the modal velocity from an excitation times `share`.
static int excite(struct mode *k, const struct signal *s, double share, struct error *e) {
    double velocity;
    struct signal samples;
    if (s->start >= k->model->duration || share == 0.0) {
        return STATUS_OK;
    }
    if (s->value) {
        samples = cut_samples(k, s);
        velocity = spectral_velocity(k, &samples);
    } else if (s->omega == 0.0) {
        double time = fmin(s->end, k->model->duration) - s->start;
        velocity = fabs(s->amplitude) * (k->omega > 0.0 ? fmin(1.0 / k->omega, time) : time);
    } else if (sample_sine(k, s, &samples, e) == STATUS_OK) {
        velocity = spectral_velocity(k, &samples);
    } else {
        return e->status;
    }
    k->square += pow(share * velocity, 2.0);
    return STATUS_OK;
}

// Computes the generalised mass, adds the initial state, and returns the share of the ground
// motion.
static double begin(struct mode *k) {
    const struct building *g = k->building;
    double excited = 0.0, displacement = 0.0, velocity = 0.0;
    for (int i = 0; i < g->n_dof; i++) {
        double momentum = g->mass[i] * k->phi[i];
        k->mass += momentum * k->phi[i];
        excited += momentum;
        displacement += momentum * k->model->displacement[g->first + i];
        velocity += momentum * k->model->velocity[g->first + i];
    }
    k->square = (pow(velocity, 2.0) + pow(k->omega * displacement, 2.0)) / pow(k->mass, 2.0);
    return excited / k->mass;
}

static int respond(struct mode *k, struct error *e) {
    const struct model *m = k->model;
    const struct building *g = k->building;
    const struct ground *ground = &m->ground[g->ground];
    const double excited = begin(k);
    int status = STATUS_OK;
    for (int i = 0; i < ground->n_signal && status == STATUS_OK; i++) {
        status = excite(k, &ground->signal[i], excited, e);
    }
    for (int i = 0; i < m->n_load && status == STATUS_OK; i++) {
        int floor = m->load[i].dof - g->first;
        if (floor >= 0 && floor < g->n_dof) {
            status = excite(k, &m->load[i].signal, k->phi[floor] / k->mass, e);
        }
    }
    return status;
}

static int add_mode(const struct model *m, const struct building *g, int number,
                    struct arena *scratch, double *velocity, double *drift_rate, struct error *e) {
    struct mode k = {
        .model = m,
        .building = g,
        .phi = g->shape + (size_t)number * (size_t)g->n_dof,
        .omega = g->omega[number],
        .scratch = scratch,
    };
    double ratio = building_damping_ratio(g, number + 1);
    k.ratio = isnan(ratio) ? 0.0 : fmin(ratio, RATIO_MAX);
    int status = respond(&k, e);
    for (int i = 0; i < g->n_dof && status == STATUS_OK; i++) {
        double drift = k.phi[i] - (i > 0 ? k.phi[i - 1] : 0.0);
        velocity[i] += k.phi[i] * k.phi[i] * k.square;
        drift_rate[i] += drift * drift * k.square;
    }
    return status;
}

int floor_velocity(const struct model *m, int i, double *velocity, double *drift_rate,
                   struct error *e) {
    assert(i >= 0 && i < m->n_body && velocity && drift_rate);
    const struct building *g = &m->building[i];
    struct arena *scratch = arena_create();
    int status = scratch ? STATUS_OK : error_no_memory(e);
    for (int j = 0; j < g->n_dof; j++) {
        velocity[j] = drift_rate[j] = 0.0;
    }
    for (int k = 0; k < g->n_dof && k < MODES_MAX && status == STATUS_OK; k++) {
        status = add_mode(m, g, k, scratch, velocity, drift_rate, e);
    }
    for (int j = 0; j < g->n_dof; j++) {
        velocity[j] = sqrt(velocity[j]);
        drift_rate[j] = sqrt(drift_rate[j]);
    }
    arena_free(scratch);
    return status;
}
