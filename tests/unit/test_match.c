// SPDX-License-Identifier: GPL-3.0-or-later
// Factors of records for a target, where they are known beforehand.
#include "motion/target.h"

#include <math.h>

#include "core/arena.h"
#include "support/support.h"

enum { N_PERIOD = 3, N_RECORD = 4 };
static const double period[N_PERIOD] = {0.1, 1.0, 2.0}, damping[] = {0.05};

// Matches records whose PSA is given (n_record, N_PERIOD); returns the status. Arrays are the
// arena's.
static int try_match(struct arena *a, const double *psa, int n_record, struct match_request q,
                     struct match *m, struct error *e) {
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
    q.spectra = &s;
    q.n_component = q.n_component > 0 ? q.n_component : 1;
    q.high = q.high > 0.0 ? q.high : (double)INFINITY;
    return target_match(m, &q, a, e);
}

static struct match match_with(struct arena *a, const double *psa, int n_record,
                               struct match_request q) {
    struct match m;
    struct error e = {0};
    if (try_match(a, psa, n_record, q, &m, &e) != STATUS_OK) {
        fail_msg("%s", e.message);
    }
    return m;
}

static struct match match_of(struct arena *a, const double *psa, int n_record, const double *goal) {
    return match_with(a, psa, n_record, (struct match_request){.goal = goal});
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

// Two components with PSA 1, 2, 4 and 4, 4, 4 have the geometric mean 2, sqrt 8, 4. Of ln(1/PSA)
// the mean is -(0 + 1 + 2 + 2 + 2 + 2) / 6 ln 2 = -1.5 ln 2, and 3.5 / 6 (ln 2)^2 is left.
static void a_pair_has_one_factor(void **state) {
    (void)state;
    struct arena *a = arena_create();
    const double goal[] = {1.0, 1.0, 1.0}, psa[] = {1.0, 2.0, 4.0, 4.0, 4.0, 4.0};
    const struct match m =
        match_with(a, psa, 2, (struct match_request){.goal = goal, .n_component = 2});
    for (int c = 0; c < 2; c++) {
        assert_close(m.factor[c], pow(2.0, -1.5), 1e-15);
        assert_close(m.misfit[c], log(2.0) * sqrt(3.5 / 6.0), 1e-15);
    }
    assert_int_equal(m.n_chosen, 2);
    assert_close(m.least.value, 2.5 * pow(2.0, -1.5), 1e-15);
    assert_close(m.largest.value, 4.0 * pow(2.0, -1.5), 1e-15);
    arena_free(a);
}

// Four records about a target of 1, with the factors 1, 1/3, 2 and 1: tilted to one side, to the
// other, a little less, and a little more.
static const double flat[] = {1.0, 1.0, 1.0};
static const double tilted[] = {2.0,  1.0, 0.5,       1.5, 3.0, 6.0,
                                0.95, 0.5, 0.5 / 1.9, 2.2, 1.0, 1.0 / 2.2};

// The least misfits are those of numbers 2 and 0; number 1 has that of 0 and comes later.
static void the_records_with_the_least_misfits_are_chosen(void **state) {
    (void)state;
    struct arena *a = arena_create();
    const struct match m =
        match_with(a, tilted, 4, (struct match_request){.goal = flat, .n_select = 2});
    assert_int_equal(m.n_chosen, 2);
    assert_true(m.chosen[0] == 0 && m.chosen[1] == 2);
    assert_close(m.factor[2], 2.0, 1e-15);
    assert_close(m.largest.value, 1.95, 1e-15);
    assert_close(m.of_mean, hypot(log(1.95), log((0.5 + 1.0 / 1.9) / 2.0)) / sqrt(3.0), 1e-14);
    arena_free(a);
}

// Number 1 replaces 0: its tilt makes up for that of number 2. No exchange of number 2 improves
// their mean, 1.2, 1, 1.2632.
static void exchanges_bring_the_mean_to_the_target(void **state) {
    (void)state;
    struct arena *a = arena_create();
    const struct match m = match_with(
        a, tilted, 4, (struct match_request){.goal = flat, .n_select = 2, .exchange = true});
    assert_true(m.chosen[0] == 1 && m.chosen[1] == 2);
    assert_int_equal(m.n_exchange, 1);
    assert_close(m.of_mean, hypot(log(1.2), log((2.0 + 1.0 / 1.9) / 2.0)) / sqrt(3.0), 1e-14);
    assert_true(m.of_best > m.of_mean);
    assert_close(m.least.value, 1.0, 1e-15);
    arena_free(a);
}

static void factors_stay_within_their_limits(void **state) {
    (void)state;
    struct arena *a = arena_create();
    struct match_request q = {
        .goal = flat, .n_select = 2, .low = 0.5, .high = 1.5, .exchange = true};
    struct match m = match_with(a, tilted, 4, q);
    assert_true(m.chosen[0] == 0 && m.chosen[1] == 3);
    assert_int_equal(m.n_outside, 2);
    struct error e;
    q.n_select = 3;
    assert_int_equal(try_match(a, tilted, 4, q, &m, &e), STATUS_INPUT);
    assert_string_equal(e.message,
                        "2 of 4 records have a factor from 0.5 to 1.5; 3 are to be chosen");
    arena_free(a);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_record_twice_the_target_has_the_factor_one_half),
        cmocka_unit_test(the_factor_is_the_geometric_mean_of_the_ratios),
        cmocka_unit_test(ratios_of_a_suite_are_those_of_its_arithmetic_mean),
        cmocka_unit_test(a_pair_has_one_factor),
        cmocka_unit_test(the_records_with_the_least_misfits_are_chosen),
        cmocka_unit_test(exchanges_bring_the_mean_to_the_target),
        cmocka_unit_test(factors_stay_within_their_limits),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
