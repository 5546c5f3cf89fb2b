// SPDX-License-Identifier: GPL-3.0-or-later
// A law whose loops are computed without a building: of a storey, a hinge or a link. Its
// deformation is the drift of a storey, or the lengthening of a link; its force is positive with
// it.
#ifndef JOSTLE_LOOP_LAW_H
#define JOSTLE_LOOP_LAW_H

#include "law/link_law.h"

enum {
    LOOP_ROWS_MAX = STOREY_ROWS_MAX + LINK_ROWS,
    LOOP_CONSTANTS_MAX = STOREY_CONSTANTS_MAX + 8,
    LOOP_HISTORY_MAX = STOREY_HISTORY_MAX + 8
};

struct loop_law {
    const char *name;
    int n_row;
    struct row row[LOOP_ROWS_MAX];    // without the initial stiffness
    const struct storey_law *storey;  // the law, or what that of a link is made of; NULL: none
    struct link_law link;             // NULL name: it is none of a link
    struct contact_law contact;       // that of a link
    int place[LOOP_ROWS_MAX];         // of its rows among all rows of the link
    bool straight;                    // it is of straight lines
    bool rated;                       // the force depends on the velocity
};

void loop_law_of_storey(const struct storey_law *from, struct loop_law *out);
void loop_law_of_link(const struct link_law *from, struct loop_law *out);

// The place of the row with this key; -1: none.
int loop_law_row(const struct loop_law *law, const char *key);

// Computes the constants from the values of the rows (NAN: not given) and the initial stiffness
// (NAN: 0, for a law that does not need one).
int loop_law_prepare(const struct loop_law *law, const double *value, double stiffness,
                     double *constant, struct error *e);

// Goes to this deformation in a step of length `dt`, and brings the history there. The tangent is
// that by the deformation. The velocity is that at the end.
struct storey_response loop_law_advance(const struct loop_law *law, const double *constant,
                                        double *history, double deformation, double velocity,
                                        double dt);

// Recoverable energy at this deformation.
double loop_law_stored(const struct loop_law *law, const double *constant, const double *history,
                       double deformation);

#endif
