// SPDX-License-Identifier: GPL-3.0-or-later
// Whether masses, velocity and record agree. The impulse J of the contact force takes the effective
// mass m from the approach velocity v to -e v, so that e = J / (m v) - 1, and 0 <= e <= 1 where the
// impact creates no energy (Goldsmith 1960, Impact, chapter 2).
//
// J is taken by the trapezoidal rule from the peak to the first sample <= 0 on either side. Its
// edges are known to half a sampling interval, where the force may jump. A record that is cut off
// there has a smaller J, and e is then only known not to exceed 1.
#include <math.h>

#include "law/fit_model.h"

static const double MEASURING_ERROR = 0.02;  // relative, of masses, velocities and forces together
static const double CUT = 0.05;              // of the peak: more at an end of the record is cut off

// The pulse around the peak.
struct pulse {
    size_t first, last;  // samples > 0
    double impulse;
    double edges;  // by which the impulse may be off at both ends
};

static struct pulse find_pulse(const struct fit_request *q, double peak) {
    size_t top = 0;
    while (q->force[top] < peak) {
        top++;
    }
    struct pulse p = {top, top, 0.0, 0.0};
    while (p.first > 0 && q->force[p.first - 1] > 0.0) {
        p.first--;
    }
    while (p.last + 1 < q->n && q->force[p.last + 1] > 0.0) {
        p.last++;
    }
    for (size_t i = p.first; i < p.last; i++) {
        p.impulse += (q->force[i] + q->force[i + 1]) / 2.0 * (q->time[i + 1] - q->time[i]);
    }
    // Beyond the ends the force goes to 0 within one interval, somehow.
    const double before = p.first > 0 ? q->time[p.first] - q->time[p.first - 1] : 0.0;
    const double behind = p.last + 1 < q->n ? q->time[p.last + 1] - q->time[p.last] : 0.0;
    p.edges = (q->force[p.first] * before + q->force[p.last] * behind) / 2.0;
    p.impulse += p.edges;
    return p;
}

// The force at an end of the record that the pulse reaches, over the peak.
static double cut_at(const struct fit_request *q, size_t end, size_t edge, double peak) {
    return edge == end && q->force[edge] > CUT * peak ? q->force[edge] / peak : 0.0;
}

int fit_check_impulse(const struct fit_model *m, struct fit_result *out, struct error *e) {
    const struct fit_request *q = m->q;
    const struct pulse p = find_pulse(q, m->peak);
    const double momentum = q->mass * q->velocity;
    const double error = MEASURING_ERROR + p.edges / momentum;
    out->restitution = p.impulse / momentum - 1.0;
    out->cut = fmax(cut_at(q, 0, p.first, m->peak), cut_at(q, q->n - 1, p.last, m->peak));
    if (q->force[q->n - 1] == m->peak || q->force[0] == m->peak) {
        return error_set(e, STATUS_INPUT,
                         "the force is largest at an end of the record; the record must hold the "
                         "impact from before to behind its peak");
    }
    const bool too_small = out->cut == 0.0 && out->restitution < -error;
    if (!too_small && out->restitution <= 1.0 + error) {
        return STATUS_OK;
    }
    return error_set(e, STATUS_INPUT,
                     "the impulse J of the record is %.6g N s, so that e = J/(m* v) - 1 is %.4g "
                     "with m* = %.6g kg and v = %.6g m/s; it must be >= 0 and <= 1: check masses, "
                     "velocity and units",
                     p.impulse, out->restitution, q->mass, q->velocity);
}

bool fit_is_undetermined(const struct fit_parameter *p) {
    return p->error > p->value;
}
