// SPDX-License-Identifier: GPL-3.0-or-later
// Start of the search for the best parameters. The impulse of the pulse is m v (1 + e), which gives
// e and so zeta. The peak gives k. The centroid of the pulse gives the instant of closure. If the
// force jumps, the sum of squares jumps when closure passes a sample. Then a scan finds the best
// instant.
#include <math.h>

#include "core/root.h"
#include "law/fit_model.h"

static const double PULSE = 0.05;            // share of the peak at which the pulse ends
static const double STIFF = 70.0;            // logarithm of a k above all real ones, in SI
static const double LITTLE_DAMPING = -3.0;   // logarithm of a zeta at which bodies separate
static const double RESTITUTION_MIN = 0.05;  // smallest restitution
static const double DAMPED = 0.95;           // largest restitution, over that without damping
static const double SCAN = 0.25;             // half width of the scan, as a share of the duration
enum { SCAN_POINTS = 16, SCANS = 3, SCAN_SHRINKS = 8, STEPS_MAX = 300 };

// The first moments of a force over time, by the trapezoidal rule.
struct moments {
    double impulse, moment;
    double time, force;  // of the previous point
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
    double restitution;  // required
};

// Peak force minus the peak force of the record, as a function of the logarithm of k.
static double excess_force(double log_k, void *context) {
    const struct search *s = context;
    struct fit_point p = s->at;
    struct isolated_impact i;
    struct error e;
    p.k = exp(log_k);
    return fit_model_impact(s->model, &p, NULL, &i, &e) == STATUS_OK ? i.peak_force - s->model->peak
                                                                     : NAN;
}

// Restitution minus the required one, as a function of the logarithm of zeta. Bodies that do not
// separate have the restitution 0.
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

// Root of a function of a logarithm. The function rises (`rise` 1) or falls (-1) with its argument.
// The search starts at `near` and goes to the side on which the root must be. NAN: no root.
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

// The logarithm of the k that gives the peak. A bumper has a limit of penetration. With a small k
// the penetration may exceed this limit, and the peak may be larger than with a larger k. Then the
// search starts from above.
static double find_stiffness(struct search *s) {
    double log_k = solve(excess_force, s, 0.0, 1.0);
    return isfinite(log_k) ? log_k : solve(excess_force, s, STIFF, 1.0);
}

// k and zeta from peak and restitution. With strong damping the peak may be too large for every k.
// Then the k without damping is the start.
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

// Moves the instant of closure to the smallest sum of squares.
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
