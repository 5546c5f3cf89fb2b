// SPDX-License-Identifier: GPL-3.0-or-later
// Fits of storey laws to loops with noise, of which the parameters are known.
#include <gsl/gsl_errno.h>
#include <math.h>

#include "law/storey_fit.h"
#include "support/storey.h"
#include "support/support.h"

enum { SAMPLES = 900, LEG = 90 };

// A loop of the law with cycles of rising amplitude, and noise of the size `noise`.
struct loop {
    double drift[SAMPLES], shear[SAMPLES];
};

static void measure(const char *name, double stiffness, const char *values, double noise,
                    struct loop *l) {
    struct test_storey s = test_storey_of(name, stiffness, values);
    unsigned seed = 5;
    double from = 0.0;
    for (int i = 0; i < SAMPLES / LEG; i++) {
        const double target = (i % 2 ? -0.7 : 0.7) * (i + 2);
        for (int k = 1; k <= LEG; k++) {
            const int at = i * LEG + k - 1;
            seed = seed * 1664525u + 1013904223u;
            l->drift[at] = from + (target - from) * k / LEG;
            l->shear[at] =
                test_storey_go(&s, l->drift[at], 1) + noise * ((double)seed / 2147483648.0 - 1.0);
        }
        from = target;
    }
}

static int fit(const char *name, const char *values, const int *row, int n_row,
               const struct loop *l, struct storey_fit_result *out, struct error *e) {
    const struct storey_law *law = storey_law_find(name);
    double value[STOREY_ROWS_MAX];
    test_storey_values(law, values, value);
    struct loop_law of;
    storey_loop_of_storey(law, &of);
    const struct storey_fit_request q = {&of, value, NAN, row, n_row, SAMPLES, l->drift, l->shear};
    return storey_fit_run(&q, out, e);
}

static void a_fit_finds_parameters_within_its_standard_errors(void **state) {
    (void)state;
    static const struct {
        const char *law, *values;
        int n;
        int row[5];
        double want[5];
    } known[] = {
        {"bilinear", "yield 2 hardening 0.05", 3, {-1, 0, 1}, {3, 2, 0.05}},
        {"bilinear", "yield 2 hardening 0.05 yield-negative 1", 4, {-1, 0, 1, 2}, {3, 2, 0.05, 1}},
        {"takeda", "yield 2 hardening 0.05 alpha 0.4", 4, {-1, 0, 1, 2}, {3, 2, 0.05, 0.4}},
        {"bouc-wen", "yield 2 hardening 0.1 n 1", 3, {-1, 0, 1}, {3, 2, 0.1}},
        {"slip", "yield 2 hardening 0.2 slack 0.3", 4, {-1, 0, 1, 2}, {3, 2, 0.2, 0.3}},
    };
    for (size_t k = 0; k < sizeof known / sizeof known[0]; k++) {
        struct loop l;
        measure(known[k].law, 3.0, known[k].values, 0.05, &l);
        struct storey_fit_result r;
        struct error e;
        assert_int_equal(fit(known[k].law, known[k].values, known[k].row, known[k].n, &l, &r, &e),
                         STATUS_OK);
        for (int i = 0; i < known[k].n; i++) {
            const int row = known[k].row[i];
            const double got = row < 0 ? r.stiffness : r.value[row];
            // Three standard errors, of five laws with many parameters: seldom more.
            assert_near(got, known[k].want[i], 4.0 * r.error[i]);
            assert_true(r.error[i] > 0.0 && r.error[i] < 0.1 * known[k].want[i]);
        }
        assert_true(r.normalised_error > 0.005 && r.normalised_error < 0.03);
    }
}

static void a_loop_that_says_nothing_is_refused(void **state) {
    (void)state;
    struct loop l = {.drift = {0}};
    struct storey_fit_result r;
    struct error e;
    const int row[] = {STOREY_FIT_STIFFNESS, 0, 1};
    assert_int_equal(fit("bilinear", "yield 1 hardening 0", row, 3, &l, &r, &e), STATUS_INPUT);
    for (int i = 0; i < SAMPLES; i++) {
        l.drift[i] = i;
        l.shear[i] = -i;
    }
    assert_int_equal(fit("bilinear", "yield 1 hardening 0", row, 3, &l, &r, &e), STATUS_INPUT);
}

int main(void) {
    gsl_set_error_handler_off();
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_fit_finds_parameters_within_its_standard_errors),
        cmocka_unit_test(a_loop_that_says_nothing_is_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
