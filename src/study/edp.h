// SPDX-License-Identifier: GPL-3.0-or-later
// Engineering demand parameters: the one number of a run that a limit is set on.
#ifndef JOSTLE_EDP_H
#define JOSTLE_EDP_H

#include "jostle/analysis.h"

struct edp_kind {
    const char *name;  // as in the result file: "drift"
    const struct dimension *dimension;
    enum peak peak;                                // of floors
    double (*of_link)(const struct link_peak *p);  // of contacts; NULL: it is of floors
};
extern const struct edp_kind edp_kinds[];
extern const int n_edp_kind;

struct edp {
    const struct edp_kind *kind;
    int owner;  // the building or contact; -1: the largest of all
};

double edp_value(const struct edp *edp, const struct model *m, const struct results *r);

// The building or contact of that name that the kind can be of; -1: there is none.
int edp_find_owner(const struct edp_kind *kind, const struct model *m, const char *name);

#endif
