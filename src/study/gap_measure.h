// SPDX-License-Identifier: GPL-3.0-or-later
// Engineering demand parameters: the one number of a run that a limit is set on.
#ifndef JOSTLE_GAP_MEASURE_H
#define JOSTLE_GAP_MEASURE_H

#include "jostle/analysis.h"

struct gap_measure_kind {
    const char *name;  // as in the result file: "drift"
    const struct dimension *dimension;
    enum peak peak;                                // of floors
    double (*of_link)(const struct link_peak *p);  // of contacts; NULL: it is of floors
};
extern const struct gap_measure_kind gap_measure_kinds[];
extern const int n_gap_measure_kind;

struct gap_measure {
    const struct gap_measure_kind *kind;
    int owner;  // the building or contact; -1: the largest of all
};

double gap_measure_value(const struct gap_measure *edp, const struct model *m,
                         const struct results *r);

// The building or contact of that name that the kind can be of; -1: there is none.
int gap_measure_find_owner(const struct gap_measure_kind *kind, const struct model *m,
                           const char *name);

#endif
