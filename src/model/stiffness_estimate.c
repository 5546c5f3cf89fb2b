// SPDX-License-Identifier: GPL-3.0-or-later
// The stiffness of a contact from the bodies that meet:
//
//     hertz  k = (4/3) sqrt(R) E*,  1/R = 1/R1 + 1/R2,  1/E* = (1 - nu1^2)/E1 + (1 - nu2^2)/E2
//            of two spheres, or a sphere and a flat face (R2 infinite); F = k d^(3/2).
//            Johnson (1985), Contact Mechanics, eq. 4.22. A formula with sqrt(R E*) is in print,
//            and is wrong.
//     slab   k = E A / L, the axial stiffness of the slab that is struck; F = k d.
#include "model/law_choice.h"

#include <string.h>

enum { RADIUS1, RADIUS2, MODULUS1, MODULUS2, POISSON1, POISSON2 };
enum { MODULUS, AREA, LENGTH };

static const struct range poisson_range = {.min = 0.0, .max = 0.5, .text = ">= 0 and <= 0.5"};

const struct row stiffness_hertz_rows[STIFFNESS_HERTZ_ROWS] = {
    [RADIUS1] = {"radius1", ROW_NUMBER, ROW_REQUIRED, OF_LENGTH, &range_positive, NAN,
                 "radius of a body at the contact"},
    [RADIUS2] = {"radius2", ROW_NUMBER, 0, OF_LENGTH, &range_positive, NAN,
                 "radius of the other body; default: a flat face"},
    [MODULUS1] = {"modulus1", ROW_NUMBER, ROW_REQUIRED, OF_STRESS, &range_positive, NAN,
                  "Young's modulus of the first body"},
    [MODULUS2] = {"modulus2", ROW_NUMBER, 0, OF_STRESS, &range_positive, NAN,
                  "Young's modulus of the other body; default: that of the first one"},
    [POISSON1] = {"poisson1", ROW_NUMBER, ROW_REQUIRED, OF_NONE, &poisson_range, NAN,
                  "Poisson's ratio of the first body"},
    [POISSON2] = {"poisson2", ROW_NUMBER, 0, OF_NONE, &poisson_range, NAN,
                  "Poisson's ratio of the other body; default: that of the first one"},
};

const struct row stiffness_slab_rows[STIFFNESS_SLAB_ROWS] = {
    [MODULUS] = {"modulus", ROW_NUMBER, ROW_REQUIRED, OF_STRESS, &range_positive, NAN,
                 "Young's modulus of the slab"},
    [AREA] = {"area", ROW_NUMBER, ROW_REQUIRED, OF_AREA, &range_positive, NAN,
              "cross-section of the slab"},
    [LENGTH] = {"length", ROW_NUMBER, ROW_REQUIRED, OF_LENGTH, &range_positive, NAN,
                "length of the slab in the direction of impact"},
};

// The value of the option `row`, or of the option `other` if `row` is not given.
static double value_or(const struct argument *given, int row, int other) {
    return given[given[row].given ? row : other].number[0];
}

static double hertz_stiffness(const struct argument *given) {
    double nu1 = given[POISSON1].number[0];
    double nu2 = value_or(given, POISSON2, POISSON1);
    double compliance = (1.0 - nu1 * nu1) / given[MODULUS1].number[0] +
                        (1.0 - nu2 * nu2) / value_or(given, MODULUS2, MODULUS1);
    double curvature = 1.0 / given[RADIUS1].number[0];
    if (given[RADIUS2].given) {
        curvature += 1.0 / given[RADIUS2].number[0];
    }
    return 4.0 / (3.0 * compliance * sqrt(curvature));
}

static double slab_stiffness(const struct argument *given) {
    return given[MODULUS].number[0] * given[AREA].number[0] / given[LENGTH].number[0];
}

const struct stiffness_estimate stiffness_estimates[] = {
    {
        .name = "hertz",
        .row = stiffness_hertz_rows,
        .n_row = STIFFNESS_HERTZ_ROWS,
        .dimension = OF_HERTZ_STIFFNESS,
        .stiffness = hertz_stiffness,
    },
    {
        .name = "slab",
        .row = stiffness_slab_rows,
        .n_row = STIFFNESS_SLAB_ROWS,
        .dimension = OF_STIFFNESS,
        .stiffness = slab_stiffness,
    },
};

enum { N_ESTIMATE = sizeof stiffness_estimates / sizeof stiffness_estimates[0] };
const int n_stiffness_estimate = N_ESTIMATE;

const struct stiffness_estimate *stiffness_estimate_find(struct deck *d, const struct word *name) {
    const char *text = deck_text(d, name);
    const char *known[N_ESTIMATE];
    for (int i = 0; text && i < N_ESTIMATE; i++) {
        known[i] = stiffness_estimates[i].name;
        if (strcmp(text, known[i]) == 0) {
            return &stiffness_estimates[i];
        }
    }
    if (text) {
        deck_unknown(d, name, text, "estimate of stiffness", known, N_ESTIMATE);
    }
    return NULL;
}
