// SPDX-License-Identifier: GPL-3.0-or-later
// The laws of links: the spring and damper of bilateral.h, Maxwell's law, and every storey law. In
// a link the shear of a storey law is the tension, and its drift is the lengthening of the link.
//
// A link with a storey law may be slack. Then it carries no tension before it has lengthened by its
// slack, and no compression before it has shortened by its slack. It may carry tension only, or
// compression only. The slack counts from the deformation at which the law has no force, so that a
// brace which has yielded in tension hangs loose.
#ifndef JOSTLE_LINK_LAW_H
#define JOSTLE_LINK_LAW_H

#include "jostle/contact_law.h"
#include "jostle/storey_law.h"

// The first constants of all laws of links. A law without a dashpot against its ends has the
// dashpot 0 and the exponent 1.
enum link_constant {
    LINK_STIFFNESS,  // [F/L] initial
    LINK_DASHPOT,
    LINK_EXPONENT,
    LINK_CONSTANTS
};

// The rows of a link with a storey law before those of the law.
enum link_law_row {
    LINK_ROW_STIFFNESS,
    LINK_ROW_SLACK,
    LINK_ROW_TENSION_ONLY,
    LINK_ROW_COMPRESSION_ONLY,
    LINK_ROWS
};

// A law by its name in `link -law NAME`.
struct link_law {
    const char *name;
    const struct contact_law *law;    // NULL: made of the storey law by link_law_make
    const struct storey_law *storey;  // NULL: none
    const struct row *row;            // (n_row) all its rows, or those after the LINK_ROWS ones
    int n_row;
    const char *what;        // how it differs from the storey law; NULL: it has its name
    enum link_law_row only;  // the direction in which it always acts alone; 0: both
};

// All laws of links: n_link_law of them, the storey laws last.
extern const int n_link_law;
struct link_law link_law_at(int i);

// The law of a link with this storey law, which must not depend on the velocity.
struct link_law link_law_of_storey(const struct storey_law *law);

// Rows of links with a storey law (LINK_ROWS).
extern const struct row link_law_rows[LINK_ROWS];

// Does a link with a storey law have this row? The slip law has a slack of its own.
bool link_law_has(const struct link_law *law, int row);

// The law that is made of the storey law of `from`, without rows.
struct contact_law link_law_make(const struct link_law *from);

// Computes its constants (n_constant of link_law_make) from the values of all its rows, those of
// link_law_rows first. Errors: as in struct storey_law.
int link_law_prepare(const struct link_law *from, const double *value, double *constant,
                     struct error *e);

// Is there a deformation at which the link is loose?
bool link_law_is_slack(const double *constant);

// The storey law in the law of a link, with its constants and its part of the link's history.
struct link_storey {
    const struct storey_law *law;
    const double *constant, *history;
    double deformation;  // [L] committed, of the law: without the slack
};
struct link_storey link_law_storey(const double *constant, const double *history);

#endif
