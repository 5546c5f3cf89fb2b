// SPDX-License-Identifier: GPL-3.0-or-later
#include "law/fit_model.h"

#include <assert.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

static const double JUMP = 1e-6;  // share of the peak force
enum { SAMPLES_MIN = 6, SAMPLES_MAX = 10000000 };

// True if the law has a stiffness that can be fitted.
static bool is_possible(const struct contact_law *law) {
    int k = contact_law_row(law, "k");
    return law->force && k >= 0 && law->row[k].kind == ROW_NUMBER;
}

static int check_record(const struct fit_request *q, double *peak, struct error *e) {
    if (q->n < SAMPLES_MIN || q->n > SAMPLES_MAX) {
        return error_set(e, STATUS_INPUT, "the record has %zu samples; it must have %d to %d", q->n,
                         SAMPLES_MIN, SAMPLES_MAX);
    }
    *peak = q->force[0];
    for (size_t i = 0; i < q->n; i++) {
        *peak = fmax(*peak, q->force[i]);
    }
    if (*peak <= 0.0) {
        return error_set(e, STATUS_INPUT,
                         "the largest force of the record is %.6g; compression must be positive",
                         *peak);
    }
    return STATUS_OK;
}

int fit_model_init(const struct fit_request *q, struct fit_model *m, struct error *e) {
    *m = (struct fit_model){.q = q, .damped = contact_law_row(q->law, "zeta") >= 0};
    if (!is_possible(q->law)) {
        return error_set(e, STATUS_INPUT, "%s has no k that could be fitted", q->law->name);
    }
    int status = check_record(q, &m->peak, e);
    if (status != STATUS_OK) {
        return status;
    }
    memcpy(m->value, q->value, (size_t)q->law->n_row * sizeof *m->value);
    int restitution = contact_law_row(q->law, "e");
    if (m->damped && restitution >= 0) {
        m->value[restitution] = NAN;
    }
    m->time = calloc(q->n, sizeof *m->time);
    m->force = calloc(q->n, sizeof *m->force);
    m->rate = calloc(q->n, sizeof *m->rate);
    return m->time && m->force && m->rate ? STATUS_OK : error_no_memory(e);
}

void fit_model_free(struct fit_model *m) {
    free(m->time);
    free(m->force);
    free(m->rate);
}

int fit_model_impact(struct fit_model *m, const struct fit_point *p,
                     const struct isolated_observer *observer, struct isolated_impact *out,
                     struct error *e) {
    const struct contact_law *law = m->q->law;
    double constant[CONTACT_CONSTANTS_MAX];
    m->value[contact_law_row(law, "k")] = p->k;
    if (m->damped) {
        m->value[contact_law_row(law, "zeta")] = p->zeta;
    }
    int status = law->prepare(m->value, m->q->mass, constant, e);
    return status == STATUS_OK
               ? isolated_run(law, constant, m->q->mass, m->q->velocity, observer, out, e)
               : status;
}

static void note_point(void *context, const struct isolated_point *p) {
    struct fit_model *m = context;
    if (p->time == 0.0) {
        m->closure = *p;
    }
    m->opening = *p;
}

static void note_sample(void *context, int i, const struct isolated_point *p) {
    struct fit_model *m = context;
    size_t at = m->contact.first + (size_t)i;
    m->contact.end = at + 1;
    m->force[at] = p->force;
    m->rate[at] = p->rate;
}

static bool jumps_at(const struct fit_model *m, const struct isolated_point *p) {
    return fabs(p->force) > JUMP * m->peak;
}

bool fit_model_note_jumps(struct fit_model *m) {
    m->jumps_closing = jumps_at(m, &m->closure);
    m->jumps_opening = jumps_at(m, &m->opening);
    return m->jumps_closing || m->jumps_opening;
}

// Gives the samples on both sides of a jump their measured values. `inner` is the one in contact.
static void leave_out(struct fit_model *m, size_t inner, size_t outer) {
    const size_t n = m->q->n;
    if (inner < n && outer < n) {
        m->force[inner] = m->q->force[inner];
        m->force[outer] = m->q->force[outer];
        m->rate[inner] = m->rate[outer] = 0.0;
    }
}

static void clear(struct fit_model *m) {
    memset(m->force, 0, m->q->n * sizeof *m->force);
    memset(m->rate, 0, m->q->n * sizeof *m->rate);
}

void fit_model_predict(struct fit_model *m, const struct fit_point *p,
                       const struct fit_samples *held) {
    assert(m && p);
    size_t first = 0;
    for (size_t i = 0; i < m->q->n; i++) {
        m->time[i] = m->q->time[i] - p->start;
        first += m->time[i] <= 0.0;
    }
    m->contact = (struct fit_samples){first, first};
    clear(m);
    const struct isolated_observer observer = {.point = note_point,
                                               .context = m,
                                               .sample = note_sample,
                                               .time = m->time + first,
                                               .n_time = (int)(m->q->n - first)};
    struct isolated_impact impact;
    struct error e;
    if (fit_model_impact(m, p, &observer, &impact, &e) != STATUS_OK) {
        clear(m);
        return;
    }
    if (held) {
        // Held samples before `first` continue the force at closure. Held samples from `end` on
        // continue the force at opening. All other samples outside the contact have no force.
        for (size_t i = 0; i < m->q->n; i++) {
            const bool before = i < m->contact.first;
            const bool in = i >= held->first && i < held->end;
            if (in && !before && i < m->contact.end) {
                continue;
            }
            const struct isolated_point *edge = before ? &m->closure : &m->opening;
            const double rate = in && isfinite(edge->rate) ? edge->rate : 0.0;
            m->force[i] = in ? edge->force + rate * (m->time[i] - edge->time) : 0.0;
            m->rate[i] = rate;
        }
        m->contact = *held;
    }
    if (m->contact.first > 0 && m->jumps_closing) {
        leave_out(m, m->contact.first, m->contact.first - 1);
    }
    if (m->contact.end > m->contact.first && m->jumps_opening) {
        leave_out(m, m->contact.end - 1, m->contact.end);
    }
}

double fit_model_squares(struct fit_model *m, const struct fit_point *p) {
    assert(m && p);
    double sum = 0.0;
    fit_model_predict(m, p, NULL);
    for (size_t i = 0; i < m->q->n; i++) {
        double residual = m->force[i] - m->q->force[i];
        sum += residual * residual;
    }
    return sum;
}

// Checks that masses, velocity and record are consistent. The impulse J of the contact force
// changes the velocity of the effective mass m from v to -e v, so e = J / (m v) - 1. An impact that
// creates no energy has 0 <= e <= 1 (Goldsmith 1960, Impact, chapter 2).
//
// J is computed with the trapezoidal rule, from the peak to the first sample <= 0 on both sides.
// Each end of the pulse is known to half a sampling interval, because the force may jump there. If
// the record cuts the pulse off, J is too small. Then only e <= 1 can be checked.

static const double MEASURING_ERROR = 0.02;  // relative, of mass, velocity and forces
static const double CUT = 0.05;              // share of the peak: more at an end is a cut

// The pulse around the peak.
struct pulse {
    size_t first, last;  // samples > 0
    double impulse;
    double edges;  // possible error of the impulse from both ends
};

// The force at an end of the record over the peak, if the pulse reaches this end.
static double cut_at(const struct fit_request *q, size_t end, size_t edge, double peak) {
    return edge == end && q->force[edge] > CUT * peak ? q->force[edge] / peak : 0.0;
}

int fit_check_impulse(const struct fit_model *m, struct fit_result *out, struct error *e) {
    const struct fit_request *q = m->q;
    size_t top = 0;
    while (q->force[top] < m->peak) {
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
    // Beyond the ends of the pulse the force decreases to 0 within one interval.
    const double before = p.first > 0 ? q->time[p.first] - q->time[p.first - 1] : 0.0;
    const double behind = p.last + 1 < q->n ? q->time[p.last + 1] - q->time[p.last] : 0.0;
    p.edges = (q->force[p.first] * before + q->force[p.last] * behind) / 2.0;
    p.impulse += p.edges;
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
