// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef JOSTLE_IDA_PRINT_H
#define JOSTLE_IDA_PRINT_H

#include "command/printer.h"
#include "study/bootstrap.h"
#include "study/capacity.h"
#include "study/hazard.h"
#include "study/roles.h"

// What is printed.
struct ida_print {
    const struct capacity_request *request;
    const struct capacities *found;
    const struct study_view *view;
    const struct roles *roles;
    const struct hazard *hazard;  // NULL: none
    int n_bootstrap, seed;        // n_bootstrap 0: none
    struct printer table;
};

// Whether the runs were used up before the limit was found as the tolerance asks.
bool ida_print_is_short(const struct capacity_request *q, const struct capacity *c);

// The intensity found for each sample, and the curve of each group.
int ida_print_samples(struct ida_print *p, struct error *e);

// Every run, for curves.
int ida_print_points(struct ida_print *p, struct error *e);

#endif
