// SPDX-License-Identifier: GPL-3.0-or-later
// A scalar function of time: samples joined by straight lines, a sine, or a constant.
#ifndef JOSTLE_SIGNAL_H
#define JOSTLE_SIGNAL_H

#include <stddef.h>

#include "jostle/error.h"
#include "jostle/names.h"

JOSTLE_C_BEGIN

struct arena;

struct signal {
    double start;  // [T] 0 before it
    double end;    // [T] 0 after it; may be infinite

    // Samples (value is not NULL), at start, start + dt, ...
    size_t n;
    double dt;
    const double *value;         // (n)
    double peak;                 // the largest absolute value
    const double *velocity;      // (n) first integral at the samples
    const double *displacement;  // (n) second integral at the samples

    // amplitude sin(omega (t - start) + phase); a constant has omega = 0 and phase = pi/2.
    double amplitude, omega, phase;
    const char *name;    // file name, "sine" or "constant"
    double mean;         // mean that was subtracted from the samples of a record; 0: none
    const char *scaled;  // scaling of a record to a spectrum, a phrase; NULL: not scaled
};

// A sampled signal of n >= 2 values, scaled; integrates them exactly as a piecewise linear
// function.
int signal_init_samples(struct signal *s, struct arena *a, const double *value, size_t n, double dt,
                        double scale, double start, struct error *e);

// The value at time t.
double signal_value(const struct signal *s, double t);

// Adds to sum (n) the values at the times t (n).
void signal_add_values(const struct signal *s, int n, const double *t, double *sum);

// First and second integral from -infinity to t.
void signal_integrals(const struct signal *s, double t, double *velocity, double *displacement);

// The largest absolute value.
double signal_peak(const struct signal *s);

JOSTLE_C_END

#endif
