// SPDX-License-Identifier: GPL-3.0-or-later
// Values and integrals of the time functions in signal.h.
//
// Straight lines join the samples. With the slope s = (a[j+1] - a[j]) / dt and the time x since
// sample j, the integrals from sample j on are
//     v = v[j] + a[j] x + s x^2 / 2,    u = u[j] + v[j] x + a[j] x^2 / 2 + s x^3 / 6.
// Before the first and after the last sample the value is zero, so v is constant and u grows
// linearly.
#include "jostle/signal.h"

#include <assert.h>
#include <limits.h>
#include <math.h>
#include <stdbool.h>

#include "core/arena.h"
#include "core/lanes.h"
#include "core/number.h"

// A time this close to the end of a signal, relative to one sample, counts as the end itself. n dt
// and (n dt) computed in another way differ by rounding.
static const double END_SLACK = 1e-6;

int signal_init_samples(struct signal *s, struct arena *a, const double *value, size_t n, double dt,
                        double scale, double start, struct error *e) {
    assert(value && n > 0 && dt > 0.0);
    double *y = arena_alloc(a, n, sizeof *y);
    double *v = arena_alloc(a, n, sizeof *v);
    double *u = arena_alloc(a, n, sizeof *u);
    if (!y || !v || !u) {
        return error_no_memory(e);
    }
    double peak = 0.0;
    for (size_t j = 0; j < n; j++) {
        y[j] = scale * value[j];
        peak = fabs(y[j]) > peak ? fabs(y[j]) : peak;
    }
    v[0] = 0.0;
    u[0] = 0.0;
    for (size_t j = 0; j + 1 < n; j++) {
        v[j + 1] = v[j] + dt * (y[j] + y[j + 1]) / 2.0;
        u[j + 1] = u[j] + dt * v[j] + dt * dt * (2.0 * y[j] + y[j + 1]) / 6.0;
    }
    *s = (struct signal){
        .start = start,
        .end = start + dt * (double)(n - 1),
        .n = n,
        .dt = dt,
        .value = y,
        .peak = peak,
        .velocity = v,
        .displacement = u,
    };
    return STATUS_OK;
}

// The sample at or before t and the time since this sample, with the same bits as in add_samples.
static size_t sample_before(const struct signal *s, double t, double *since) {
    double x = (t - s->start) * (1.0 / s->dt);
    size_t j = x > 0.0 ? (size_t)x : 0;
    if (j > s->n - 2) {
        j = s->n - 2;
    }
    *since = t - s->start - (double)j * s->dt;
    return j;
}

static double slack(const struct signal *s) {
    return END_SLACK * (s->value ? s->dt : 1e-3 / (s->omega + 1.0));
}

double signal_value(const struct signal *s, double t) {
    double tolerance = slack(s);
    if (t < s->start - tolerance || t > s->end + tolerance) {
        return 0.0;
    }
    if (!s->value) {
        return s->amplitude * sin(s->omega * (t - s->start) + s->phase);
    }
    double x;
    size_t j = sample_before(s, t, &x);
    return s->value[j] + (s->value[j + 1] - s->value[j]) * (x * (1.0 / s->dt));
}

// signal_value of samples in lanes. Lanes have numbers of samples of type int only.
LANES static void add_samples(const struct signal *s, int n, const double *restrict t,
                              double *restrict sum) {
    const double *restrict value = s->value;
    const double start = s->start, dt = s->dt, per_dt = 1.0 / dt, most = (double)(s->n - 2);
    const double from = start - slack(s), to = s->end + slack(s);
    for (int i = 0; i < n; i++) {
        int j = (int)number_min(number_max((t[i] - start) * per_dt, 0.0), most);
        double since = t[i] - start - (double)j * dt;
        double inside = (t[i] >= from) & (t[i] <= to);
        sum[i] += inside * (value[j] + (value[j + 1] - value[j]) * (since * per_dt));
    }
}

void signal_add_values(const struct signal *s, int n, const double *t, double *sum) {
    assert(s && n >= 0 && (n == 0 || t[0] <= t[n - 1]));
    if (s->value && s->n <= INT_MAX) {
        add_samples(s, n, t, sum);
        return;
    }
    for (int i = 0; i < n; i++) {
        sum[i] += signal_value(s, t[i]);
    }
}

static void integrals_of_sine(const struct signal *s, double t, double *v, double *u) {
    double x = t - s->start;
    if (s->omega == 0.0) {
        double value = s->amplitude * sin(s->phase);
        *v = value * x;
        *u = value * x * x / 2.0;
        return;
    }
    double w = s->omega;
    *v = s->amplitude / w * (cos(s->phase) - cos(w * x + s->phase));
    *u = s->amplitude / w * (cos(s->phase) * x - (sin(w * x + s->phase) - sin(s->phase)) / w);
}

void signal_integrals(const struct signal *s, double t, double *velocity, double *displacement) {
    assert(s && velocity && displacement);
    if (t <= s->start) {
        *velocity = 0.0;
        *displacement = 0.0;
        return;
    }
    double within = fmin(t, s->end);
    if (s->value) {
        double x;
        size_t j = sample_before(s, within, &x);
        double slope = (s->value[j + 1] - s->value[j]) / s->dt;
        *velocity = s->velocity[j] + x * (s->value[j] + x * slope / 2.0);
        *displacement =
            s->displacement[j] + x * (s->velocity[j] + x * (s->value[j] / 2.0 + x * slope / 6.0));
    } else {
        integrals_of_sine(s, within, velocity, displacement);
    }
    *displacement += *velocity * (t - within);
}

double signal_peak(const struct signal *s) {
    if (s->value) {
        return s->peak;
    }
    return s->omega > 0.0 ? fabs(s->amplitude) : fabs(s->amplitude * sin(s->phase));
}
