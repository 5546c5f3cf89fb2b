// SPDX-License-Identifier: GPL-3.0-or-later
// A storey law with its constants and its history, for tests.
#ifndef TESTS_SUPPORT_STOREY_H
#define TESTS_SUPPORT_STOREY_H

#include "jostle/storey_law.h"

struct test_storey {
    const struct storey_law *law;
    double constant[STOREY_CONSTANTS_MAX];
    double history[STOREY_HISTORY_MAX];
    double drift;  // committed
};

// A value for a row without a fallback, of a storey of 2e7 N/m that yields at 1.5e5 N; NAN: the row
// need not be given.
double test_storey_value(const char *key, double hardening);

// The values of the law's rows (STOREY_ROWS_MAX) from a text such as "yield 1 cycle peak origin".
// The test fails on a word that no row has.
void test_storey_values(const struct storey_law *law, const char *text, double *value);

// A storey of the law called `name` from such a text.
struct test_storey test_storey_of(const char *name, double stiffness, const char *text);

// Shear and tangent at `drift`.
struct storey_response test_storey_at(const struct test_storey *s, double drift);

// Goes to `drift` in `n` equal steps and commits each. Returns the shear there.
double test_storey_go(struct test_storey *s, double drift, int n);

// The work of such a path, by the mean of the shears of a step.
double test_storey_work(struct test_storey *s, double drift, int n);

// Goes to `n` targets, in `steps` steps each. Compares the shears with `want`, which has so many
// decimals.
void test_storey_protocol(const struct test_storey *virgin, const double *target,
                          const double *want, int n, int steps, double tolerance);

#endif
