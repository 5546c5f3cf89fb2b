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

// The same of a law whose shear depends on the drift rate, too.
struct storey_rate_response {
    double shear;    // [F]
    double tangent;  // d shear / d drift [F/L]
    double dashpot;  // d shear / d drift rate [F T/L]; it may be negative
};

// A straight line of a law: V = back drift + spring (drift - rest), valid while the force of the
// second spring does not exceed the limit.
struct storey_branch {
    double back, spring;  // [F/L]
    double rest;          // [L]
    double limit;         // [F]
};

// What demands on a storey are measured by, to the right [0] and to the left [1].
struct storey_figures {
    double yield[2];     // [L] drift at yield
    double strength[2];  // [F] shear there
    double ultimate[2];  // [L] drift at which all strength is lost; infinite: never
    double capacity;     // [F L] least energy that a mode of deterioration has; infinite: none
    double beta;         // of the energy in the damage index
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

    // The same at a drift rate [L/T], of a law whose shear depends on it; `respond` is this at rate
    // 0. NULL: the shear does not depend on the rate. The storeys of such a law respond in a part
    // of their building (model/rate_storeys.h).
    struct storey_rate_response (*respond_at_rate)(const double *constant, const double *history,
                                                   double drift, double rate, double *after);

    // The line of the storey as long as the history does not change; the shear on it has the bits
    // of `respond`. NULL: the law has no such lines.
    struct storey_branch (*branch)(const double *constant, const double *history);

    // Recoverable energy at `drift` with the committed history [F L].
    double (*stored)(const double *constant, const double *history, double drift);

    // Sets the yield and what else the law knows. NULL: it does not yield.
    void (*describe)(const double *constant, struct storey_figures *out);

    // The energy that the capacity has lost [F L]. NULL: the law has none.
    double (*consumed)(const double *constant, const double *history);
};

// The figures of a law; infinite where it has none. beta is 0.05, that of reinforced concrete in
// the mean.
struct storey_figures storey_law_figures(const struct storey_law *law, const double *constant);

// Ductility: the larger of the largest drifts `most` to the right and to the left over those at
// yield.
double storey_law_ductility(const struct storey_figures *f, const double most[2]);

// The damage index of Park & Ang (1985), J. Struct. Eng. ASCE 111, 722-739, of the direction in
// which it is larger: most / ultimate + beta energy / (strength ultimate). 0: nothing is ultimate.
double storey_law_damage(const struct storey_figures *f, const double most[2], double energy);

extern const struct storey_law *const storey_laws[];
extern const int n_storey_law;

// The law called `name`; NULL: there is none.
const struct storey_law *storey_law_find(const char *name);

JOSTLE_C_END

#endif
