// SPDX-License-Identifier: GPL-3.0-or-later
// Descriptor of a contact law. A law is one const descriptor in one file of src/law/contact/ and
// one line in contact_list.inc. Docs, deck parsing and range checks come from the descriptor.
#ifndef JOSTLE_CONTACT_LAW_H
#define JOSTLE_CONTACT_LAW_H

#include "jostle/curve.h"
#include "jostle/error.h"
#include "jostle/names.h"
#include "jostle/row.h"

JOSTLE_C_BEGIN

// Largest numbers of rows, constants and history values of a law.
enum { CONTACT_ROWS_MAX = 12, CONTACT_CONSTANTS_MAX = 16, CONTACT_HISTORY_MAX = 8 };

// A law may have one row of kind ROW_FILE: the file of a curve of force against penetration. The
// value of this row is the number of points. The points follow the values of all rows, each point
// with CURVE_COLUMNS numbers. After the constants there is space for as many points.

// Properties of a law that the solver uses, besides its force.
enum contact_trait {
    CONTACT_JUMPS = 1,       // the force is not 0 at d = 0+ while approaching
    CONTACT_MAY_PULL = 2,    // the force may be negative in contact
    CONTACT_NEEDS_V0 = 4,    // uses the velocity at closure
    CONTACT_NEEDS_MASS = 8,  // the constants depend on the effective mass
    CONTACT_EXACT = 16,      // delivers e exactly as it is: -calibrate changes nothing
    CONTACT_SMOOTH = 32,     // for any history, no kinks or jumps except at d = 0 and v = 0; varies
                             // with d like a power up to 3, and is linear in v
    CONTACT_BUMPER = 64,     // is soft on purpose
    CONTACT_TURNS = 128,     // of a link: depends on the turns of the deformation before
    CONTACT_NEEDS_STEP = 256,  // of a link: history[0] is the length of a step while its end is
                               // being found, else 0
};

// Force of a link in contact, positive in compression, and its tangents.
struct contact_response {
    double force;  // [F]
    double dfdd;   // [F/L]
    double dfdv;   // [F T/L]
};

// A motion from (d0, v0) to (d, v).
struct contact_way {
    double d0, v0, d, v;
};

// Forces and tangents of CONTACT_LANES links.
enum { CONTACT_LANES = 8 };
struct contact_lanes {
    double force[CONTACT_LANES], dfdd[CONTACT_LANES], dfdv[CONTACT_LANES];
};

struct contact_law {
    const char *name;
    const char *summary;  // one line
    const char *formula;  // ASCII
    const char *source;   // authors, year, equation
    const char *remarks;  // use and limits
    const char *example;  // options for its picture, for floors of 25 t and 40 t; NULL: no picture
    const struct row *row;
    int n_row;
    int n_constant;   // computed once for each link; without those of a curve
    int n_history;    // kept through one contact
    unsigned traits;  // enum contact_trait

    // Computes the constants for `force` from the values of the rows, in the units of the deck, and
    // the effective mass. A value is NAN if it is not given. Errors: STATUS_INPUT.
    int (*prepare)(const double *value, double m_eff, double *constant, struct error *e);

    // Sets the history at the instant of closure with velocity v0 >= 0. NULL if n_history = 0.
    void (*close)(const double *constant, double v0, double *history);

    // For a law of rigid bodies without a force: the velocity of separation, at the instant at
    // which the bodies meet with velocity v >= 0. Then `force` and all members that belong to it
    // are NULL. NULL: the law has a force.
    double (*rebound)(const double *constant, double v);

    // The force at penetration d >= 0 and velocity v. The function is pure. Every finite d >= 0 and
    // v is valid. At d = 0 the force is the limit d -> 0+.
    struct contact_response (*force)(const double *constant, const double *history, double d,
                                     double v);

    // The forces of CONTACT_LANES links, with the bits of `force`, for a law without history.
    // `constant` has the shape (n_constant, CONTACT_LANES). Results at d < 0 are not used. NULL:
    // the solver calls `force` for one link at a time.
    void (*force_lanes)(const double *constant, const double *d, const double *v,
                        struct contact_lanes *response);

    // Distance from the end of `way` to the first kink of the force on it, in any unit. Kinks at d
    // = 0 and v = 0 do not count. d does not reverse on `way`. The distance is continuous, and <= 0
    // beyond the kink. INFINITY: no kink. NULL: the law has no other kinks.
    double (*kink)(const double *constant, const double *history, const struct contact_way *way);

    // Updates the history from the committed step to (d, v). NULL if it does not change in contact.
    void (*commit)(const double *constant, double *history, double d, double v);

    // Laws of links only. The rate at which the value history[1] grows under a force [L/T]. NULL:
    // the force follows from d, v and the committed history.
    double (*creep)(const double *constant, double force);

    // Recoverable energy [F L] in the committed state at d. NULL: none.
    double (*stored)(const double *constant, const double *history, double d);

    // The value of row `zeta` that delivers exactly the restitution e, 0 < e <= 1, in an isolated
    // impact. NAN: not found. NULL: the law does not take e.
    double (*exact)(double e);

    // Replaces `exact` if the damping that delivers e depends on more than e. Puts values that
    // deliver e, in an isolated impact of the effective mass, in place of the value of e. Errors:
    // STATUS_INPUT (no values deliver e), STATUS_SYSTEM.
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

// Numbers of values and of constants of a law, including its curve. `value` has the number of
// points.
int contact_law_n_value(const struct contact_law *law, const double *value);
int contact_law_n_constant(const struct contact_law *law, const double *value);

JOSTLE_C_END

#endif
