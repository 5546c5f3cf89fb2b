// SPDX-License-Identifier: GPL-3.0-or-later
// How long the runs of a study are, for the time that is left: in steps, or in time of the analysis
// where steps are adaptive. The length of a run is taken as the product of what each sweep does to
// it, which is found by building one model for each value of a sweep.
#ifndef JOSTLE_LENGTHS_H
#define JOSTLE_LENGTHS_H

#include "study/plan.h"

struct lengths {
    const struct plan *plan;          // borrowed
    double first;                     // length of run 0
    double *share[STUDY_SWEEPS_MAX];  // (n of the sweep) length over `first` at each value
    long apart[STUDY_SWEEPS_MAX];     // runs from one value of a sweep to the next
    int sweep, value;                 // the last that was measured
    bool measured;                    // all are
};

// To be given to lengths_close. Where the sweeps have too many values to build a model for each,
// all runs count as equally long. Errors: STATUS_SYSTEM (no memory).
int lengths_init(struct lengths *l, const struct plan *p, struct error *e);
void lengths_close(struct lengths *l);

// Measures further values for about `seconds`. A model that cannot be built counts as run 0.
void lengths_measure(struct lengths *l, double seconds);

// The length of a run over that of run 0, once all are measured.
double lengths_of(const struct lengths *l, long run);

#endif
