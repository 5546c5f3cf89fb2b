// SPDX-License-Identifier: GPL-3.0-or-later
// Descriptor of a storey law: one const descriptor in one file of src/law/storey/, and one line in
// storey_list.inc.
#ifndef JOSTLE_STOREY_LAW_H
#define JOSTLE_STOREY_LAW_H

#include <stdbool.h>

#include "jostle/error.h"
#include "jostle/names.h"
#include "jostle/row.h"

JOSTLE_C_BEGIN

enum { STOREY_ROWS_MAX = 40, STOREY_CONSTANTS_MAX = 40, STOREY_HISTORY_MAX = 56 };

// Properties of a law that an integrator of high order uses.
enum storey_trait {
    STOREY_STRAIGHT = 1,  // made of straight lines: the tangent is constant on a branch
};

struct storey_response {
    double shear;    // [F]
    double tangent;  // d shear / d drift [F/L]
};

// A straight line of a law: V = back drift + spring (drift - rest), valid while the force of the
// second spring does not exceed the limit.
struct storey_branch {
    double back, spring;  // [F/L]
    double rest;          // [L]
    double limit;         // [F]
};

struct storey_law {
    const char *name;
    const char *summary;
    const char *formula;
    const char *source;
    const char *remarks;  // range, typical parameters, limits; NULL: none
    const char *example;  // options for its picture, of a storey of 60 MN/m; NULL: no picture
    const struct row *row;
    int n_row;
    int n_constant;
    int n_history;    // 0: the law is linear and elastic
    unsigned traits;  // enum storey_trait

    // Computes the constants from the values of the rows of one storey (NAN: not given) and its
    // stiffness.
    int (*prepare)(const double *value, double stiffness, double *constant, struct error *e);

    // Shear and consistent tangent at `drift`, from the committed history. `after` becomes the
    // history at `drift`. It may be NULL or `history` itself.
    struct storey_response (*respond)(const double *constant, const double *history, double drift,
                                      double *after);

    // The line of the storey as long as the history does not change; the shear on it has the bits
    // of `respond`. NULL: the law has no such lines.
    struct storey_branch (*branch)(const double *constant, const double *history);

    // Recoverable energy at `drift` with the committed history [F L].
    double (*stored)(const double *constant, const double *history, double drift);
};

extern const struct storey_law *const storey_laws[];
extern const int n_storey_law;

// The law called `name`; NULL: there is none.
const struct storey_law *storey_law_find(const char *name);

JOSTLE_C_END

#endif
