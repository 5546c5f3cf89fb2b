// SPDX-License-Identifier: GPL-3.0-or-later
// Which part each sweep of a study plays in a suite.
#ifndef JOSTLE_ROLES_H
#define JOSTLE_ROLES_H

#include "study/suite.h"

enum role { ROLE_GROUP, ROLE_ABSCISSA, ROLE_SAMPLE, ROLE_FIXED };
struct roles {
    enum role role[STUDY_SWEEPS_MAX];
    int fixed[STUDY_SWEEPS_MAX];  // value of a fixed sweep
    int abscissa;                 // its sweep
    const struct sweep *along;    // that sweep, or the parameter along it that is meant
    bool is_intensity;            // it has the name of one
};

// The roles that the request names; others are guessed from the names and kinds of the sweeps.
// Errors: STATUS_INPUT (an unknown name, two roles for one sweep, no abscissa).
int roles_find(const struct study_view *v, const struct suite_request *q, struct roles *out,
               struct error *e);

// The sweep whose name has these `n` bytes, or the parameter along one; NULL: there is none. *sweep
// is which dimension it is of.
const struct sweep *roles_find_name(const struct study_view *v, const char *name, size_t n,
                                    int *sweep);

// The sweep of several numbers that has the name of an intensity; -1: there is none.
int roles_intensity(const struct study_view *v);

// How many runs there are for all values of the sweeps of this role.
int roles_count(const struct study_view *v, const struct roles *r, enum role role);

#endif
