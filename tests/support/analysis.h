// SPDX-License-Identifier: GPL-3.0-or-later
// Runs a deck given as text inside a test, keeping the rows of its histories. Whatever goes wrong
// fails the test.
#ifndef JOSTLE_TEST_ANALYSIS_H
#define JOSTLE_TEST_ANALYSIS_H

#include "jostle/analysis.h"

// One row of every history, as struct row_view gives it.
struct kept_rows {
    long n, capacity;
    int n_dof, n_link;
    double *time;                                                    // (n)
    double *displacement, *velocity, *acceleration, *drift, *shear;  // (n, n_dof)
    double *force, *penetration;                                     // (n, n_link)
    double *energy;                                                  // (n, ENERGY_COUNT)
};

struct analysis {
    struct model *model;
    struct results *results;
    struct kept_rows rows;
};

// The model of a deck made by printf. To be given to model_free.
struct model *analysis_model(const char *format, ...) __attribute__((format(printf, 1, 2)));

// Builds and runs a deck made by printf. To be given to analysis_free.
struct analysis analysis_of(const char *format, ...) __attribute__((format(printf, 1, 2)));
void analysis_free(struct analysis *a);

// Builds the deck `text` and runs it; a run that fails leaves its error in `e` and no results.
struct analysis analysis_try(const char *text, struct error *e);

// The path of the record of El Centro in g as a series that starts from 0 at t = 0, as independent
// programs have it; its first value is at t = 0.02 s.
const char *analysis_el_centro(void);

// Runs three storeys of each law that yields under El Centro, stepped in either way: their largest
// drifts are to agree to `rtol`.
void analysis_storey_laws_agree(const char *step, const char *other, double rtol);

// Row number of time t; fails if no row is within 1e-9 of it.
long analysis_row(const struct analysis *a, double t);

// Displacement of degree of freedom `dof` at time t.
double analysis_displacement(const struct analysis *a, int dof, double t);

// The largest of the energies of all rows but the residual, which scales with it; all are finite.
double analysis_flow(const struct analysis *a);

// Fails unless all results of two runs have the same bits.
void analysis_assert_same(const struct model *m, const struct results *got,
                          const struct results *want);

// The largest penetration of any contact [L].
double analysis_deepest(const struct analysis *a);

#endif
