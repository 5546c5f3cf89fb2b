// SPDX-License-Identifier: GPL-3.0-or-later
// A target spectrum to which ground motions are scaled: pseudo-acceleration over period, from a
// file or by the formulas of a building code.
#ifndef JOSTLE_MOTION_TARGET_H
#define JOSTLE_MOTION_TARGET_H

#include <stdbool.h>
#include <stddef.h>

#include "jostle/error.h"
#include "jostle/spectrum.h"
#include "motion/target_code.h"

struct arena;

struct target {
    double first, last;              // [s] the spectrum is defined between these periods
    const struct target_code *code;  // NULL: the points below
    double value[TARGET_CODE_ROWS_MAX];
    size_t n;              // at least 2
    const double *period;  // (n) [s] ascending, from >= 0
    const double *psa;     // (n) [m/s^2] > 0
};

// Makes the target of a text, which is that of a code, or the name of a file. `damping` is the
// ratio for which it is wanted. Memory is from `a`. Errors: STATUS_INPUT, STATUS_SYSTEM.
int target_open(struct arena *a, const char *text, double damping, struct target *out,
                struct error *e);

// Reads rows of period and pseudo-acceleration, laid out as for records. The line above the rows
// gives the unit of the pseudo-acceleration in brackets: `period [s], PSA [g]`. Without a unit,
// periods are in s. Memory is from `a`. Errors: STATUS_INPUT with "path:line:column: cause",
// STATUS_SYSTEM.
int target_read(struct arena *a, const char *path, struct target *out, struct error *e);

// The value at a period [m/s^2]. Points of a file are joined by straight lines between the
// logarithms of periods and values. After a point at T = 0, which has no logarithm, the line is
// straight between the values. NAN outside the target.
double target_at(const struct target *t, double period);

// Scale factors that fit ground motions to a target spectrum, and the motions that fit best. A
// motion is one record, or two that are horizontal components and have one factor.

struct match_request {
    const struct spectra *spectra;  // of unscaled records, at the first damping ratio; PSA > 0
    const double *goal;             // (n_period) [m/s^2] the target at their periods
    int n_component;                // 1; 2: records 2 i and 2 i + 1 are a motion
    int n_select;                   // motions to choose; 0: all
    double low, high;               // motions with a factor outside are not chosen
    bool exchange;  // exchange chosen motions while this brings their mean nearer to the target
};

// A period, and the mean of the scaled spectra divided by the target there.
struct match_ratio {
    double period, value;
};

struct match {
    double *factor;  // (n_record)
    double *misfit;  // (n_record) root of the mean of ln(f PSA / target)^2
    int *chosen;     // (n_chosen) records, ascending
    int n_chosen;
    int n_outside;                      // motions with a factor outside the limits
    int n_exchange;                     // of chosen motions
    double of_best, of_mean;            // misfit of the mean before and after the exchanges
    struct match_ratio least, largest;  // of the chosen records over all periods
};

// Errors: STATUS_INPUT (fewer motions within the limits than are to be chosen), STATUS_SYSTEM (no
// memory).
int target_match(struct match *m, const struct match_request *q, struct arena *a, struct error *e);

#endif
