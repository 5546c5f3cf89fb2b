// SPDX-License-Identifier: GPL-3.0-or-later
// What a contact law is: one const descriptor in one file of src/law/contact/, named by one line in
// contact_list.inc. Docs, deck parsing and range checks come from the descriptor.
#ifndef JOSTLE_CONTACT_LAW_H
#define JOSTLE_CONTACT_LAW_H

#include "jostle/curve.h"
#include "jostle/error.h"
#include "jostle/names.h"
#include "jostle/row.h"

JOSTLE_C_BEGIN

// A law has at most this many rows, constants and history values.
enum { CONTACT_ROWS_MAX = 12, CONTACT_CONSTANTS_MAX = 16, CONTACT_HISTORY_MAX = 8 };

// A law may have one row of kind ROW_FILE: the file of a curve of force against penetration. The
// value of that row is the number of points, which follow the values of all rows, each with
// CURVE_COLUMNS numbers; after the constants is room for as many.

// What the solver must know about a law beyond its force.
enum contact_trait {
    CONTACT_JUMPS = 1,       // the force is not 0 at d = 0+ while approaching
    CONTACT_MAY_PULL = 2,    // the force may be negative in contact
    CONTACT_NEEDS_V0 = 4,    // uses the velocity at closure
    CONTACT_NEEDS_MASS = 8,  // the constants depend on the effective mass
    CONTACT_EXACT = 16,      // delivers e exactly as it is: -calibrate changes nothing
    CONTACT_SMOOTH = 32,     // no kinks or jumps but at d = 0 and v = 0, whatever the history; like
                             // powers of d, of at most third degree, and linear in v
    CONTACT_BUMPER = 64,     // is soft on purpose
};

// Force of a link in contact, positive in compression, and its tangents.
struct contact_response {
    double force;  // [F]
    double dfdd;   // [F/L]
    double dfdv;   // [F T/L]
};

// From a penetration and a velocity to others.
struct contact_way {
    double d0, v0, d, v;
};

// The same of so many links at once.
enum { CONTACT_LANES = 8 };
struct contact_lanes {
    double force[CONTACT_LANES], dfdd[CONTACT_LANES], dfdv[CONTACT_LANES];
};

struct contact_law {
    const char *name;
    const char *summary;  // one line
    const char *formula;  // ASCII
    const char *source;   // authors, year, equation
    const char *remarks;  // what it is good for and where it fails
    const char *example;  // options for its picture, for floors of 25 t and 40 t; NULL: no picture
    const struct row *row;
    int n_row;
    int n_constant;   // derived once per link; those of a curve not counted
    int n_history;    // kept through one contact
    unsigned traits;  // enum contact_trait

    // Values of the rows in the deck's units, NAN where not given, and the effective mass -> the
    // constants that `force` uses. Errors: STATUS_INPUT.
    int (*prepare)(const double *value, double m_eff, double *constant, struct error *e);

    // History at the instant of closure with velocity v0 >= 0. NULL if n_history = 0.
    void (*close)(const double *constant, double v0, double *history);

    // Velocity with which the bodies part at the instant at which they meet with velocity v >= 0: a
    // law without a force, of rigid bodies. Then `force` is NULL, and so is whatever has to do with
    // it. NULL: the law has a force.
    double (*rebound)(const double *constant, double v);

    // The force at penetration d >= 0 and velocity v. Pure; every finite d >= 0 and v is valid.
    // At d = 0 the limit d -> 0+ is meant.
    struct contact_response (*force)(const double *constant, const double *history, double d,
                                     double v);

    // The same of links side by side, with the same bits, for a law without history: constants
    // (n_constant, CONTACT_LANES), d and v; where d < 0 anything will do. NULL: one at a time.
    void (*force_lanes)(const double *constant, const double *d, const double *v,
                        struct contact_lanes *response);

    // How far the end of `way`, whose d does not turn, is before the first kink of the force on it
    // but those at d = 0 and v = 0, in any unit: continuous, and 0 or less beyond the kink.
    // INFINITY: there is none. NULL: the law has no others.
    double (*kink)(const double *constant, const double *history, const struct contact_way *way);

    // Brings the history from the committed step to (d, v). NULL if it does not change in contact.
    void (*commit)(const double *constant, double *history, double d, double v);

    // The value of row `zeta` that delivers exactly the restitution e, 0 < e <= 1, in an isolated
    // impact; NAN where it is not found. NULL: the law does not take e.
    double (*exact)(double e);

    // In place of `exact` where the damping that delivers e depends on more than e: puts parameters
    // that deliver it in an isolated impact of the effective mass in place of e. Errors:
    // STATUS_INPUT (no parameters do), STATUS_SYSTEM.
    int (*calibrate)(double *value, double m_eff, struct error *e);
};

extern const struct contact_law *const contact_laws[];
extern const int n_contact_law;

// The law called `name`; NULL if there is none.
const struct contact_law *contact_law_find(const char *name);

// Index of the row called `key`; -1 if the law has none.
int contact_law_row(const struct contact_law *law, const char *key);

// Index of the row of kind ROW_FILE; -1 if the law has none.
int contact_law_curve(const struct contact_law *law);

// Values of the law's rows and its curve, and constants, as many as `value` says.
int contact_law_n_value(const struct contact_law *law, const double *value);
int contact_law_n_constant(const struct contact_law *law, const double *value);

JOSTLE_C_END

#endif
