// SPDX-License-Identifier: GPL-3.0-or-later
// Duration, time steps and rows of output. A Newmark integrator with 2 beta < gamma is stable only
// for steps of at most
//     omega dt <= 1 / sqrt(gamma / 2 - beta)
// for an undamped mode omega: Hughes (2000), The Finite Element Method, eq. 9.2.13.
#include <assert.h>
#include <float.h>
#include <math.h>

#include "law/bilateral.h"
#include "model/finish.h"
#include "model/link_end.h"
#include "model/stability.h"

// Largest number of steps. A run with more steps would last for hours, so it is an error.
static const double STEPS_MAX = 2e10;
static const double DEFAULT_INTERVAL = 0.01;  // [s]
static const double ROUNDING = 1e-9;          // rounding error of a number of steps, in steps

// The shortest adaptive step if the deck gives none, as a share of the duration. Shorter steps are
// near the rounding error of the time.
static const double SHORTEST_SHARE = 1e-13;

// Least number of rows of an adaptive analysis without -interval.
static const double ADAPTIVE_ROWS = 100.0;

static void count_steps(struct builder *b, struct model *m) {
    double ratio = m->duration / m->dt;
    double n = ceil(ratio - fmax(ROUNDING, 4.0 * DBL_EPSILON * ratio));
    if (!(n <= STEPS_MAX)) {
        deck_error(b->deck, &b->step, "%s%.3g steps are too many; at most %.3g",
                   isinf(ratio) ? "over " : "", fmin(ratio, DBL_MAX), STEPS_MAX);
        n = 1.0;
    }
    m->n_step = n < 1.0 ? 1 : (long)n;
}

static void count_rows(struct builder *b, struct model *m) {
    m->output = b->out;
    if (m->output.every > 0) {
        return;
    }
    double every = floor(DEFAULT_INTERVAL / b->deck->units.time / m->dt + ROUNDING);
    if (b->out_interval > 0.0) {
        every = round(b->out_interval / m->dt);
        const char *unit = b->deck->units.time_name;
        if (every > OUTPUT_EVERY_MAX) {
            deck_error(b->deck, &b->output, "the interval %.6g %s is %.3g steps; at most %.0e",
                       b->out_interval, unit, every, (double)OUTPUT_EVERY_MAX);
        } else if (every < 1.0 || fabs(every * m->dt - b->out_interval) > 1e-6 * m->dt) {
            deck_error(b->deck, &b->output,
                       "the interval %.6g %s is not a multiple of the step %.6g %s",
                       b->out_interval, unit, m->dt, unit);
        }
    }
    m->output.every = (int)fmin(fmax(every, 1.0), OUTPUT_EVERY_MAX);
}

// For each floor of building i, the stiffnesses (or the linear dashpots) of its bilateral links,
// each divided by its effective mass, are summed. Returns the largest sum.
static double most_at_a_floor(const struct model *m, int i, enum bilateral_row which) {
    double sum[FLOORS_MAX] = {0.0};
    double largest = 0.0;
    for (int k = m->n_contact; k < m->n_link; k++) {
        const struct link *l = &m->link[k];
        bool counts = which == BILATERAL_STIFFNESS || l->constant[BILATERAL_EXPONENT] == 1.0;
        for (int end = 0; end < 2 && counts; end++) {
            for (int j = 0; l->building[end] == i && j < link_entries(l, end); j++) {
                double *at = &sum[link_entry(l, end, j).dof - m->building[i].first];
                *at += l->constant[which] / l->mass;
                largest = fmax(largest, *at);
            }
        }
    }
    return largest;
}

// stability.c derives the bound. It has no contacts, because the solver rejects steps that are too
// long for a contact.
double model_fastest(const struct model *m, int i) {
    assert(i >= 0 && i < m->n_body);
    const struct building *g = &m->building[i];
    return sqrt(pow(g->omega[g->n_dof - 1], 2.0) + most_at_a_floor(m, i, BILATERAL_STIFFNESS));
}

// The largest stable omega dt.
static double stable(const struct model *m) {
    double excess = m->gamma / 2.0 - m->beta;
    return excess > 0.0 ? 1.0 / sqrt(excess) : INFINITY;
}

static void check_stability(struct builder *b, struct model *m) {
    double limit = stable(m);
    const char *unit = b->deck->units.time_name;
    for (int i = 0; i < m->n_body; i++) {
        const struct building *g = &m->building[i];
        double omega = model_fastest(m, i);
        if (omega * m->dt > limit) {
            deck_error(
                b->deck, &b->step,
                "step %.6g %s is unstable with beta = %g: building %s%s needs at most %.4g %s",
                m->dt, unit, m->beta, g->name,
                omega > g->omega[g->n_dof - 1] ? " with its links" : "", limit / omega, unit);
            return;
        }
    }
}

// Reports a building that needs too many steps of Dormand & Prince's method.
static void limit_explicit_steps(struct builder *b, struct model *m) {
    for (int i = 0; i < m->n_body; i++) {
        const struct building *g = &m->building[i];
        struct stability stability = stability_of(g);
        double spring = most_at_a_floor(m, i, BILATERAL_STIFFNESS);
        double dashpot = most_at_a_floor(m, i, BILATERAL_DASHPOT);
        double limit = stability_step(&stability, spring, dashpot);
        if (!(limit > 0.0)) {
            deck_error(b->deck, &b->step,
                       "building %s has a mode with negative damping, in which no adaptive step "
                       "is stable; use integrator newmark or step fixed DT",
                       g->name);
            return;
        }
        if (m->duration > ADAPTIVE_STEPS_MAX * limit) {
            const char *unit = b->deck->units.time_name;
            deck_error(b->deck, &b->step,
                       "building %s%s is too stiff for adaptive steps: at most %.3g %s, %.3g of "
                       "them; use integrator newmark or step fixed DT",
                       g->name, spring + dashpot > 0.0 ? " with its links" : "", limit, unit,
                       m->duration / limit);
            return;
        }
    }
}

// Least exponent of a damper for Dormand & Prince's method. The force c |v|^a of a damper has the
// slope c a |v|^(a - 1), which has no bound at v = 0 for exponents a < 1, and there the method
// needs very short steps. Tested with the default tolerance and dampers of 0.1 to 10 MN at 1 m/s
// between floors of 200 and 300 t: runs with a = 0.5 end, runs with a = 0.25 do not.
static const double LEAST_EXPONENT = 0.5;

// A building whose damping is on its tangent stiffness; NULL: none. Its damping jumps from step to
// step, which the error control of a method of high order does not follow.
static const struct building *tangent_damped(const struct model *m) {
    for (int k = 0; k < m->n_building; k++) {
        if (m->building[k].tangent) {
            return &m->building[k];
        }
    }
    return NULL;
}

// The method of adaptive steps if the deck has no integrator statement.
static enum integrator choose_adaptive(struct builder *b, const struct model *m) {
    if (tangent_damped(m)) {
        return INTEGRATOR_NEWMARK;
    }
    for (int k = m->n_contact; k < m->n_link; k++) {
        const double *c = m->link[k].constant;
        if (c[BILATERAL_DASHPOT] > 0.0 && c[BILATERAL_EXPONENT] < LEAST_EXPONENT) {
            deck_warning(b->deck, &b->step,
                         "the method is newmark because the exponent of damper %s is %g, and "
                         "dormand-prince is for %g or more; an integrator statement chooses either",
                         m->link[k].name, c[BILATERAL_EXPONENT], LEAST_EXPONENT);
            return INTEGRATOR_NEWMARK;
        }
    }
    return INTEGRATOR_DORMAND_PRINCE;
}

void finish_time(struct builder *b, struct model *m) {
    if (b->of_runs.text && !b->deck->sweeps) {
        deck_error(b->deck, &b->of_runs,
                   "-histories is for studies by sweep; one analysis always writes its histories");
    }
    m->beta = b->beta;
    m->gamma = b->gamma;
    m->tolerance = b->tolerance;
    m->iterations = b->iterations;
    m->step = b->step;
    m->dt = b->dt;
    m->duration = b->duration.text ? b->run_time : b->longest;
    m->integrator = b->adaptive && !b->integrator.text ? choose_adaptive(b, m) : b->method;
    m->adaptive = b->adaptive;
    m->control = b->control;
    m->control.shortest = fmax(m->control.shortest, SHORTEST_SHARE * m->duration);
    if (!b->adaptive && m->integrator == INTEGRATOR_DORMAND_PRINCE) {
        deck_error(b->deck, &b->step,
                   "dormand-prince has no fixed steps; use step adaptive or integrator newmark");
    }
    const struct building *tangent = tangent_damped(m);
    if (m->integrator == INTEGRATOR_DORMAND_PRINCE && tangent) {
        deck_error(b->deck, &b->integrator,
                   "dormand-prince has no damping on the tangent stiffness, which building %s has; "
                   "use integrator newmark",
                   tangent->name);
    }
    if (m->integrator == INTEGRATOR_DORMAND_PRINCE && b->newton.text) {
        deck_warning(b->deck, &b->newton, "dormand-prince does not iterate; newton has no effect");
    }
    if (m->adaptive) {
        // In an adaptive analysis dt is the time from row to row, and n_step the number of rows.
        m->output = b->out;
        if (m->output.every > 0) {
            deck_error(b->deck, &b->output, "-every counts fixed steps; give -interval DT");
        }
        m->output.every = 1;
        m->dt = b->out_interval > 0.0
                    ? b->out_interval
                    : fmin(DEFAULT_INTERVAL / b->deck->units.time, m->duration / ADAPTIVE_ROWS);
        count_steps(b, m);
        if (m->integrator == INTEGRATOR_DORMAND_PRINCE) {
            limit_explicit_steps(b, m);
        } else {
            // The longest adaptive step of Newmark's method is the longest stable one.
            for (int i = 0; i < m->n_body; i++) {
                double omega = model_fastest(m, i);
                m->control.longest = fmin(m->control.longest, stable(m) / omega);
            }
        }
        return;
    }
    count_steps(b, m);
    count_rows(b, m);
    check_stability(b, m);
}
