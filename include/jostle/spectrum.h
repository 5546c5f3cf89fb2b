// SPDX-License-Identifier: GPL-3.0-or-later
// Elastic response spectra of sampled ground accelerations: the largest response of a damped
// single-degree-of-freedom oscillator, u'' + 2 zeta omega u' + omega^2 u = -a(t). It is at rest
// before the first sample and vibrates freely after the last.
#ifndef JOSTLE_SPECTRUM_H
#define JOSTLE_SPECTRUM_H

#include "jostle/error.h"
#include "jostle/names.h"
#include "jostle/signal.h"

JOSTLE_C_BEGIN

struct arena;

// Largest absolute values over all time.
enum spectrum_quantity {
    SPECTRUM_PSA,  // [L/T^2] pseudo-acceleration, omega^2 SD
    SPECTRUM_PSV,  // [L/T] pseudo-velocity, omega SD
    SPECTRUM_SD,   // [L] displacement relative to the ground
    SPECTRUM_SV,   // [L/T] velocity relative to the ground
    SPECTRUM_SA,   // [L/T^2] total acceleration
    SPECTRUM_COUNT,
};

struct spectrum_point {
    double value[SPECTRUM_COUNT];
};

// The point at `period` >= 0 [T] and the damping ratio 0 <= zeta < 1 for a ground acceleration
// given by samples. A period of 0 is the rigid oscillator: the ground's peak acceleration.
struct spectrum_point spectrum_at(const struct signal *ground, double period, double zeta);

// SPECTRUM_SV only, at the frequency omega > 0 [1/T]. This takes a third of the time.
double spectrum_velocity(const struct signal *ground, double omega, double zeta);

// Statistics of the spectra of several records, for each quantity: the arithmetic mean, and
// percentiles of the sorted values, with linear interpolation.
enum spectra_statistic { SPECTRA_MEAN, SPECTRA_P16, SPECTRA_P50, SPECTRA_P84, SPECTRA_STATISTICS };

// Spectra of n_record records at a grid of damping ratios and periods.
struct spectra {
    int n_record, n_damping, n_period;
    const double *damping;         // (n_damping), borrowed
    const double *period;          // (n_period) [T], borrowed
    struct spectrum_point *point;  // (n_record + SPECTRA_STATISTICS, n_damping, n_period)
    // Called for each point of each record. NULL: not called.
    void (*tell)(void *context, long n_done, long n);
    void *context;
};

// Fills `point`, from `a`, of a struct that has everything else. Errors: STATUS_SYSTEM (no memory).
int spectra_compute(struct spectra *s, const struct signal *ground, struct arena *a,
                    struct error *e);

// The point of a record, or of the statistic `n_record + SPECTRA_MEAN` and so on.
const struct spectrum_point *spectra_at(const struct spectra *s, int series, int damping,
                                        int period);

JOSTLE_C_END

#endif
