// SPDX-License-Identifier: GPL-3.0-or-later
// Linear elastic storey: V = k drift.
#include <math.h>

#include "law/lists.h"

enum { STIFFNESS, N_CONSTANT };

static int elastic_prepare(const double *value, double stiffness, double *constant,
                           struct error *e) {
    (void)value, (void)e;
    constant[STIFFNESS] = stiffness;
    return STATUS_OK;
}

static struct storey_response elastic_respond(const double *c, const double *h, double drift,
                                              double *after) {
    (void)h, (void)after;
    return (struct storey_response){.shear = c[STIFFNESS] * drift, .tangent = c[STIFFNESS]};
}

static struct storey_branch elastic_branch(const double *c, const double *h) {
    (void)h;
    return (struct storey_branch){.spring = c[STIFFNESS], .limit = INFINITY};
}

static double elastic_stored(const double *c, const double *h, double drift) {
    (void)h;
    return c[STIFFNESS] * drift * drift / 2.0;
}

const struct storey_law storey_elastic = {
    .name = "elastic",
    .summary = "linear elastic",
    .formula = "V = k drift",
    .source = "Chopra, Dynamics of Structures, section 1.3",
    .n_constant = N_CONSTANT,
    .prepare = elastic_prepare,
    .respond = elastic_respond,
    .branch = elastic_branch,
    .stored = elastic_stored,
};
