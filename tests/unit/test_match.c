// SPDX-License-Identifier: GPL-3.0-or-later
// Factors of records for a target, where they are known beforehand.
#include "motion/target.h"

#include <math.h>

#include "core/arena.h"
#include "support/support.h"

enum { N_PERIOD = 3, N_RECORD = 2 };
static const double period[N_PERIOD] = {0.1, 1.0, 2.0}, damping[] = {0.05};

// The match of records whose PSA is given (n_record, N_PERIOD); its arrays are the arena's.
static struct match match_of(struct arena *a, const double *psa, int n_record, const double *goal) {
    struct spectrum_point point[N_RECORD * N_PERIOD] = {0};
    for (int i = 0; i < n_record * N_PERIOD; i++) {
        point[i].value[SPECTRUM_PSA] = psa[i];
    }
    const struct spectra s = {.n_record = n_record,
                              .n_damping = 1,
                              .n_period = N_PERIOD,
                              .damping = damping,
                              .period = period,
                              .point = point};
    struct match m;
    struct error e;
    assert_int_equal(target_match(&m, &s, goal, a, &e), STATUS_OK);
    return m;
}

static void a_record_twice_the_target_has_the_factor_one_half(void **state) {
    (void)state;
    struct arena *a = arena_create();
    const double goal[] = {3.0, 7.0, 2.0}, psa[] = {6.0, 14.0, 4.0, 1.5, 3.5, 1.0};
    const struct match m = match_of(a, psa, 2, goal);
    assert_close(m.factor[0], 0.5, 1e-15);
    assert_close(m.factor[1], 2.0, 1e-15);
    assert_near(m.misfit[0], 0.0, 1e-15);
    assert_near(m.misfit[1], 0.0, 1e-15);
    assert_close(m.least.value, 1.0, 1e-15);
    assert_close(m.largest.value, 1.0, 1e-15);
    arena_free(a);
}

// Target over PSA is 1, 2 and 4: ln f = ln 2, and of the square is left (ln 2)^2 (1 + 0 + 1) / 3.
static void the_factor_is_the_geometric_mean_of_the_ratios(void **state) {
    (void)state;
    struct arena *a = arena_create();
    const double goal[] = {3.0, 6.0, 8.0}, psa[] = {3.0, 3.0, 2.0};
    const struct match m = match_of(a, psa, 1, goal);
    assert_close(m.factor[0], 2.0, 1e-15);
    assert_close(m.misfit[0], log(2.0) * sqrt(2.0 / 3.0), 1e-15);
    assert_close(m.least.value, 0.5, 1e-15);
    assert_true(m.least.period == 2.0);
    assert_close(m.largest.value, 2.0, 1e-15);
    assert_true(m.largest.period == 0.1);
    arena_free(a);
}

// Scaled spectra 2, 1, 1/2 and 1, 1, 1 of a target of 1.
static void ratios_of_a_suite_are_those_of_its_arithmetic_mean(void **state) {
    (void)state;
    struct arena *a = arena_create();
    const double goal[] = {1.0, 1.0, 1.0}, psa[] = {6.0, 3.0, 1.5, 5.0, 5.0, 5.0};
    const struct match m = match_of(a, psa, 2, goal);
    assert_close(m.largest.value, 1.5, 1e-15);
    assert_close(m.least.value, 0.75, 1e-15);
    assert_true(m.least.period == 2.0 && m.largest.period == 0.1);
    arena_free(a);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_record_twice_the_target_has_the_factor_one_half),
        cmocka_unit_test(the_factor_is_the_geometric_mean_of_the_ratios),
        cmocka_unit_test(ratios_of_a_suite_are_those_of_its_arithmetic_mean),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
