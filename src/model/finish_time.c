// SPDX-License-Identifier: GPL-3.0-or-later
// A Newmark integrator with 2 beta < gamma is stable only up to a step of
//     omega dt <= 1 / sqrt(gamma / 2 - beta)
// for the undamped mode omega: Hughes (2000), The Finite Element Method, eq. 9.2.13.
#include <float.h>
#include <math.h>

#include "law/bilateral.h"
#include "model/finish.h"

// More steps than this are taken for a mistake: they would run for hours.
static const double STEPS_MAX = 2e10;
static const double DEFAULT_INTERVAL = 0.01;  // [s]
static const double ROUNDING = 1e-9;          // of the step, in counting steps

static void count_steps(struct builder *b, struct model *m) {
    m->dt = b->dt;
    m->duration = b->duration.text ? b->run_time : b->longest;
    double ratio = m->duration / m->dt;
    double n = ceil(ratio - fmax(ROUNDING, 4.0 * DBL_EPSILON * ratio));
    if (!(n <= STEPS_MAX)) {
        deck_error(b->deck, &b->step, "%.3g steps are too many; at most %.3g", n, STEPS_MAX);
        n = 1.0;
    }
    m->n_step = n < 1.0 ? 1 : (long)n;
}

static void count_rows(struct builder *b, struct model *m) {
    const char *unit = b->deck->units.time_name;
    m->output = b->out;
    if (m->output.every > 0) {
        return;
    }
    if (b->out_interval > 0.0) {
        double every = round(b->out_interval / m->dt);
        if (every < 1.0 || fabs(every * m->dt - b->out_interval) > 1e-6 * m->dt || every > 1e9) {
            deck_error(b->deck, &b->output,
                       "the interval %.6g %s is not a multiple of the step %.6g %s",
                       b->out_interval, unit, m->dt, unit);
        }
        m->output.every = (int)fmin(fmax(every, 1.0), 1e9);
        return;
    }
    double every = floor(DEFAULT_INTERVAL / b->deck->units.time / m->dt + ROUNDING);
    m->output.every = (int)fmin(fmax(every, 1.0), 1e9);
}

// By the largest omega^2 of a floor's links alone, sum of k (1/m1 + 1/m2); contacts are left out,
// as steps are cut for them.
double model_fastest(const struct model *m, int i) {
    const struct building *g = &m->building[i];
    double square[FLOORS_MAX] = {0.0};
    double largest = 0.0;
    for (int k = m->n_contact; k < m->n_link; k++) {
        const struct link *l = &m->link[k];
        for (int end = 0; end < 2; end++) {
            if (l->building[end] == i) {
                square[l->floor[end] - 1] += l->constant[BILATERAL_STIFFNESS] / l->mass;
                largest = fmax(largest, square[l->floor[end] - 1]);
            }
        }
    }
    return sqrt(pow(g->omega[g->n_floor - 1], 2.0) + largest);
}

static void check_stability(struct builder *b, struct model *m) {
    double excess = m->gamma / 2.0 - m->beta;
    if (excess <= 0.0) {
        return;
    }
    double limit = 1.0 / sqrt(excess);
    const char *unit = b->deck->units.time_name;
    for (int i = 0; i < m->n_building; i++) {
        const struct building *g = &m->building[i];
        double omega = model_fastest(m, i);
        if (omega * m->dt > limit) {
            deck_error(
                b->deck, &b->step,
                "step %.6g %s is unstable with beta = %g: building %s%s needs at most %.4g %s",
                m->dt, unit, m->beta, g->name,
                omega > g->omega[g->n_floor - 1] ? " with its links" : "", limit / omega, unit);
            return;
        }
    }
}

void finish_time(struct builder *b, struct model *m) {
    m->beta = b->beta;
    m->gamma = b->gamma;
    m->tolerance = b->tolerance;
    m->iterations = b->iterations;
    m->step = b->step;
    count_steps(b, m);
    count_rows(b, m);
    check_stability(b, m);
}
