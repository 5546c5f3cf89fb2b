// SPDX-License-Identifier: GPL-3.0-or-later
// Where the search for the best parameters starts. The impulse of the pulse is m v (1 + e), which
// gives the restitution e and with it zeta; the peak gives k; the centroid of the pulse gives the
// instant of closure. Where the force jumps, the sum of squares jumps as the instant of closure
// passes a sample, and the best instant is found by a scan.
#include <math.h>

#include "core/root.h"
#include "law/fit_model.h"

static const double PULSE = 0.05;            // of the peak: where the pulse ends
static const double STIFF = 70.0;            // logarithm of a k beyond any, in SI
static const double LITTLE_DAMPING = -3.0;   // logarithm of a zeta with which bodies part
static const double RESTITUTION_MIN = 0.05;  // of a start
static const double DAMPED = 0.95;           // of the restitution without damping: as near to it
static const double SCAN = 0.25;             // of the duration, to both sides
enum { SCAN_POINTS = 16, SCANS = 3, SCAN_SHRINKS = 8, STEPS_MAX = 300 };

// The first moments of a force over time, by the trapezoidal rule.
struct moments {
    double impulse, moment;
    double time, force;  // of the point before
    int n;
};

static void moments_add(struct moments *m, double time, double force) {
    if (m->n++ > 0) {
        double part = (force + m->force) / 2.0 * (time - m->time);
        m->impulse += part;
        m->moment += part * (time + m->time) / 2.0;
    }
    m->time = time;
    m->force = force;
}

static void add_point(void *context, const struct isolated_point *p) {
    moments_add(context, p->time, p->force);
}

struct search {
    struct fit_model *model;
    struct fit_point at;
    double restitution;  // wanted
};

// Peak force less that of the record, over the logarithm of k.
static double excess_force(double log_k, void *context) {
    const struct search *s = context;
    struct fit_point p = s->at;
    struct isolated_impact i;
    struct error e;
    p.k = exp(log_k);
    return fit_model_impact(s->model, &p, NULL, &i, &e) == STATUS_OK ? i.peak_force - s->model->peak
                                                                     : NAN;
}

// Restitution less that wanted, over the logarithm of zeta. Bodies that do not part have none.
static double excess_restitution(double log_zeta, void *context) {
    const struct search *s = context;
    struct fit_point p = s->at;
    struct isolated_impact i;
    struct error e;
    p.zeta = exp(log_zeta);
    return fit_model_impact(s->model, &p, NULL, &i, &e) == STATUS_OK
               ? i.restitution - s->restitution
               : -s->restitution;
}

// Root of a function of a logarithm, searched from `near`: upwards while it is negative if it rises
// (`rise` 1) or downwards (-1), else the other way. NAN: none.
static double solve(double (*function)(double x, void *context), struct search *s, double near,
                    double rise) {
    const double sign = function(near, s) > 0.0 ? 1.0 : -1.0;
    const double step = -sign * rise;
    for (int i = 0; i < STEPS_MAX; i++, near += step) {
        double value = function(near + step, s);
        if (!(value * sign > 0.0)) {
            return isfinite(value) ? root_find(function, s, fmin(near, near + step),
                                               fmax(near, near + step), 1e-3)
                                   : NAN;
        }
    }
    return NAN;
}

// The logarithm of the k that gives the peak. A bumper with a limit may have a larger peak with a
// small k, with which the limit is passed, than with a larger one: then it is searched from above.
static double find_stiffness(struct search *s) {
    double log_k = solve(excess_force, s, 0.0, 1.0);
    return isfinite(log_k) ? log_k : solve(excess_force, s, STIFF, 1.0);
}

// k and zeta from peak and restitution. With much damping the peak may be too large for any k: then
// that without damping is as good a start.
static int find_parameters(struct search *s, double rebound, struct error *e) {
    struct isolated_impact i;
    s->at.k = exp(find_stiffness(s));
    if (!(s->at.k > 0.0) || !s->model->damped) {
        return STATUS_OK;
    }
    int status = fit_model_impact(s->model, &s->at, NULL, &i, e);
    if (status != STATUS_OK) {
        return status;
    }
    s->restitution = fmin(fmax(rebound, RESTITUTION_MIN), DAMPED * i.restitution);
    s->at.zeta = exp(solve(excess_restitution, s, LITTLE_DAMPING, -1.0));
    double damped = exp(solve(excess_force, s, log(s->at.k), 1.0));
    s->at.k = damped > 0.0 ? damped : s->at.k;
    return STATUS_OK;
}

// Moves the instant of closure to where the sum of squares is smallest.
static void scan(struct fit_model *m, struct fit_point *p, double width) {
    double least = fit_model_squares(m, p);
    for (int round = 0; round < SCANS; round++, width /= SCAN_SHRINKS) {
        const double middle = p->start;
        double best = middle;
        for (int i = -SCAN_POINTS; i <= SCAN_POINTS; i++) {
            p->start = middle + width * i / SCAN_POINTS;
            const double sum = fit_model_squares(m, p);
            best = sum < least ? p->start : best;
            least = fmin(least, sum);
        }
        p->start = best;
    }
}

int fit_start(struct fit_model *m, struct fit_point *p, double *duration, struct error *e) {
    // The moments of the samples around the peak, down to PULSE times the peak.
    const struct fit_request *q = m->q;
    size_t first = 0;
    while (q->force[first] < m->peak) {
        first++;
    }
    size_t last = first;
    while (first > 0 && q->force[first] > PULSE * m->peak) {
        first--;
    }
    while (last + 1 < q->n && q->force[last] > PULSE * m->peak) {
        last++;
    }
    struct moments pulse = {.n = 0};
    for (size_t i = first; i <= last; i++) {
        moments_add(&pulse, q->time[i], q->force[i]);
    }
    struct search s = {.model = m};
    struct moments impact = {.n = 0};
    const struct isolated_observer observer = {.point = add_point, .context = &impact};
    struct isolated_impact i;
    int status = find_parameters(&s, pulse.impulse / (m->q->mass * m->q->velocity) - 1.0, e);
    if (status == STATUS_OK && !(s.at.k > 0.0 && s.at.zeta >= 0.0)) {
        status =
            error_set(e, STATUS_FAILED, "%s cannot be fitted: no parameters give a peak of %.6g",
                      m->q->law->name, m->peak);
    }
    if (status == STATUS_OK) {
        status = fit_model_impact(m, &s.at, &observer, &i, e);
    }
    if (status != STATUS_OK) {
        return status;
    }
    *p = s.at;
    p->start = pulse.moment / pulse.impulse - impact.moment / impact.impulse;
    *duration = i.duration;
    fit_model_predict(m, p, NULL);
    if (fit_model_note_jumps(m)) {
        scan(m, p, SCAN * i.duration);
    }
    return STATUS_OK;
}
