// SPDX-License-Identifier: GPL-3.0-or-later
// Shares of the variance against Ishigami's function and linear functions, whose shares are known.
#include <gsl/gsl_math.h>
#include <gsl/gsl_qrng.h>
#include <string.h>

#include "study/sobol.h"
#include "support/support.h"

enum { PARAMETERS = 3, COLUMNS = PARAMETERS + SOBOL_PARAMETER, ROWS = 1 << 14 };

static double demand[ROWS * COLUMNS], step[PARAMETERS * ROWS];

typedef double function(const double *u);

static double ishigami(const double *u) {
    double x[PARAMETERS];
    for (int i = 0; i < PARAMETERS; i++) {
        x[i] = M_PI * (2.0 * u[i] - 1.0);
    }
    return sin(x[0]) + 7.0 * pow(sin(x[1]), 2.0) + 0.1 * pow(x[2], 4.0) * sin(x[0]);
}

static double linear(const double *u) {
    return 100.0 + 3.0 * u[0] - 4.0 * u[1];
}

static double constant(const double *u) {
    (void)u;
    return 7.5;
}

// Both samples from one sequence of Sobol in six dimensions.
static struct sobol_runs runs_of(function *f, size_t n) {
    gsl_qrng *sequence = gsl_qrng_alloc(gsl_qrng_sobol, 2 * PARAMETERS);
    for (size_t k = 0; k < n; k++) {
        double u[2 * PARAMETERS];
        gsl_qrng_get(sequence, u);
        for (int i = PARAMETERS; i < 2 * PARAMETERS; i++) {
            u[i] = fmod(u[i] + M_SQRT2, 1.0);  // so that no step is 0
        }
        double *row = demand + k * COLUMNS;
        row[SOBOL_A] = f(u);
        row[SOBOL_B] = f(u + PARAMETERS);
        for (int i = 0; i < PARAMETERS; i++) {
            double mixed[PARAMETERS] = {u[0], u[1], u[2]};
            mixed[i] = u[PARAMETERS + i];
            row[SOBOL_PARAMETER + i] = f(mixed);
            step[(size_t)i * n + k] = u[PARAMETERS + i] - u[i];
        }
    }
    gsl_qrng_free(sequence);
    return (struct sobol_runs){n, PARAMETERS, demand, step};
}

// V = a^2/8 + b pi^4/5 + b^2 pi^8/18 + 1/2 with a = 7, b = 0.1 (Saltelli et al. 2008, Global
// Sensitivity Analysis, p. 179); x3 acts only together with x1.
static void ishigami_has_its_shares(void **state) {
    (void)state;
    const double p4 = pow(M_PI, 4.0), both = 0.01 * p4 * p4 * (1.0 / 18.0 - 1.0 / 50.0);
    const double alone[] = {0.5 * pow(1.0 + 0.1 * p4 / 5.0, 2.0), 49.0 / 8.0, 0.0};
    const double variance = alone[0] + alone[1] + both;
    const double with[] = {alone[0] + both, alone[1], both};
    const struct sobol_runs runs = runs_of(ishigami, ROWS);
    struct sobol_share share[PARAMETERS];
    struct sobol_summary s;
    struct error e;
    assert_int_equal(sobol_find(&runs, share, &s, &e), STATUS_OK);
    assert_near(s.mean, 3.5, 2e-3);
    assert_close(s.deviation, sqrt(variance), 1e-3);
    assert_int_equal(s.n_left_out, 0);
    for (int i = 0; i < PARAMETERS; i++) {
        assert_near(share[i].first.value, alone[i] / variance, 2e-3);
        assert_near(share[i].total.value, with[i] / variance, 2e-3);
        assert_true(share[i].first.low < share[i].first.value &&
                    share[i].first.value < share[i].first.high);
        assert_true(share[i].total.low < share[i].total.value &&
                    share[i].total.value < share[i].total.high);
        // The bootstrap draws rows at random; 1 / sqrt(n) is 0.008.
        assert_true(share[i].first.high - share[i].first.low < 0.08);
    }
}

// Without products of parameters first and total shares agree: a_i^2 / sum. All elementary effects
// are the slope, and a parameter that is not used has none.
static void a_linear_function_has_the_squares_of_its_slopes(void **state) {
    (void)state;
    const struct sobol_runs runs = runs_of(linear, ROWS);
    struct sobol_share share[PARAMETERS];
    struct sobol_summary s;
    struct error e;
    const double want[] = {9.0 / 25.0, 16.0 / 25.0, 0.0}, slope[] = {3.0, 4.0, 0.0};
    assert_int_equal(sobol_find(&runs, share, &s, &e), STATUS_OK);
    for (int i = 0; i < PARAMETERS; i++) {
        assert_near(share[i].first.value, want[i], 1e-3);
        assert_near(share[i].total.value, want[i], 1e-3);
        assert_near(share[i].effect, slope[i], 1e-3);
        assert_near(share[i].scatter, 0.0, 0.05);
    }
}

// A row with a run that failed or collapsed is left out, whichever run it is.
static void rows_without_numbers_do_not_count(void **state) {
    (void)state;
    enum { N = 200 };
    struct sobol_share whole[PARAMETERS], cut[PARAMETERS];
    struct sobol_summary s, t;
    struct error e;
    struct sobol_runs runs = runs_of(ishigami, N);
    runs.n = N - COLUMNS;
    for (int i = 0; i < PARAMETERS; i++) {
        memmove(step + (size_t)i * runs.n, step + (size_t)i * N, runs.n * sizeof *step);
    }
    assert_int_equal(sobol_find(&runs, whole, &s, &e), STATUS_OK);
    runs = runs_of(ishigami, N);
    for (int c = 0; c < COLUMNS; c++) {
        demand[(N - COLUMNS + c) * COLUMNS + c] = c % 2 ? (double)INFINITY : (double)NAN;
    }
    assert_int_equal(sobol_find(&runs, cut, &t, &e), STATUS_OK);
    assert_int_equal(t.n_left_out, COLUMNS);
    assert_true(s.mean == t.mean && s.deviation == t.deviation);
    for (int i = 0; i < PARAMETERS; i++) {
        assert_memory_equal(&whole[i], &cut[i], sizeof whole[i]);
    }
    for (size_t k = 1; k < N; k++) {
        demand[k * COLUMNS] = NAN;
    }
    assert_int_equal(sobol_find(&runs, cut, &t, &e), STATUS_FAILED);
    assert_string_equal(e.message, "only 1 of 200 rows of runs have numbers");
}

static void what_does_not_vary_has_no_shares(void **state) {
    (void)state;
    const struct sobol_runs runs = runs_of(constant, 100);
    struct sobol_share share[PARAMETERS];
    struct sobol_summary s;
    struct error e;
    assert_int_equal(sobol_find(&runs, share, &s, &e), STATUS_OK);
    assert_true(isnan(share[0].first.value) && isnan(share[0].total.value));
    assert_true(s.deviation == 0.0 && share[0].effect == 0.0);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(ishigami_has_its_shares),
        cmocka_unit_test(a_linear_function_has_the_squares_of_its_slopes),
        cmocka_unit_test(rows_without_numbers_do_not_count),
        cmocka_unit_test(what_does_not_vary_has_no_shares),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
