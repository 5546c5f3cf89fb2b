// SPDX-License-Identifier: GPL-3.0-or-later
// What `jostle fragility` prints of a curve.
#ifndef JOSTLE_FRAGILITY_PRINT_H
#define JOSTLE_FRAGILITY_PRINT_H

#include "command/printer.h"
#include "study/bootstrap.h"
#include "study/cloud.h"
#include "study/hazard.h"

enum fragility_method { METHOD_COUNTS, METHOD_IDA, METHOD_CLOUD };

// Of one group of runs and one limit.
struct fragility_result {
    const struct suite *suite;
    int group;
    double limit;
    enum fragility_method method;
    const struct hazard *hazard;  // NULL: none
    struct fragility_runs runs;
    int n_level;
    struct fragility_level *level;    // (n_level) of room for runs.n
    struct fragility_record *record;  // (runs.n_unit), by METHOD_IDA
    struct cloud cloud;               // by METHOD_CLOUD
    struct fragility fit;
    struct bootstrap bootstrap;  // n_draw 0: none is asked for
    double rate;                 // of exceedance in a year; NAN: there is none
};

int fragility_print_text(const struct fragility_result *r, struct error *e);

// The columns of data, and the lines of a result in them.
void fragility_print_columns(const struct fragility_result *r, struct printer *t);
void fragility_print_data(const struct fragility_result *r, struct printer *t);

#endif
