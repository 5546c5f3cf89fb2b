// SPDX-License-Identifier: GPL-3.0-or-later
// The arithmetic of convergence against sequences made up with a known limit and order.
#include <math.h>

#include "study/refinement.h"
#include "support/support.h"

static const double LIMIT = 3.0, SAFETY = 1.25;

// limit + c h^p at h = 1, 1 / ratio, 1 / ratio^2 ...
static void make_up(double *value, int n, double c, double p, double ratio) {
    for (int i = 0; i < n; i++) {
        value[i] = LIMIT + c * pow(ratio, -p * i);
    }
}

static void a_pure_power_gives_its_order_and_its_limit(void **state) {
    (void)state;
    static const double order[] = {0.5, 1.0, 1.25, 2.0};
    for (int i = 0; i < 4; i++) {
        double value[5];
        make_up(value, 5, -0.1, order[i], 2.0);
        struct convergence c = refinement_convergence(value, 5, 2.0, 2.0, SAFETY);
        assert_int_equal(c.kind, CONVERGENCE_ORDERLY);
        assert_near(c.order, order[i], 1e-10);
        assert_close(c.estimate, LIMIT, 1e-12);
        assert_close(c.error, SAFETY * fabs(value[4] - LIMIT), 1e-8);
    }
}

static void the_ratio_of_the_steps_may_be_another_one(void **state) {
    (void)state;
    double value[3];
    make_up(value, 3, 0.2, 1.0, 10.0);
    struct convergence c = refinement_convergence(value, 3, 10.0, 1.0, SAFETY);
    assert_int_equal(c.kind, CONVERGENCE_ORDERLY);
    assert_near(c.order, 1.0, 1e-10);
    assert_close(c.estimate, LIMIT, 1e-12);
}

static void only_the_last_three_levels_count(void **state) {
    (void)state;
    double value[6] = {-7.0, 100.0};
    make_up(value + 2, 4, 0.1, 2.0, 2.0);
    struct convergence c = refinement_convergence(value, 6, 2.0, 2.0, SAFETY);
    assert_near(c.order, 2.0, 1e-10);
}

// Two powers, as real results have them: the bar still holds the limit, and the estimate is nearer.
static void a_disturbed_power_is_inside_its_error_bar(void **state) {
    (void)state;
    double value[4];
    for (int i = 0; i < 4; i++) {
        double h = pow(0.5, i);
        value[i] = LIMIT + 0.1 * h * h + 0.03 * h * h * h;
    }
    struct convergence c = refinement_convergence(value, 4, 2.0, 2.0, SAFETY);
    assert_true(fabs(value[3] - LIMIT) < c.error);
    assert_true(fabs(c.estimate - LIMIT) < 0.2 * fabs(value[3] - LIMIT));
}

static void an_order_above_that_of_the_method_is_not_used(void **state) {
    (void)state;
    double value[3];
    make_up(value, 3, 0.1, 4.0, 2.0);
    struct convergence c = refinement_convergence(value, 3, 2.0, 2.0, SAFETY);
    assert_int_equal(c.kind, CONVERGENCE_FAST);
    assert_near(c.order, 4.0, 1e-10);
    assert_close(c.estimate, value[2] + (value[2] - value[1]) / 3.0, 1e-14);
    assert_close(c.error, 1.25 * (value[0] - value[2]), 1e-14);
}

static void going_back_and_forth_gives_no_order(void **state) {
    (void)state;
    static const double value[] = {3.1, 2.95, 3.02};
    struct convergence c = refinement_convergence(value, 3, 2.0, 2.0, SAFETY);
    assert_int_equal(c.kind, CONVERGENCE_IRREGULAR);
    assert_true(isnan(c.order));
    assert_close(c.estimate, 3.02, 1e-15);
    assert_close(c.error, 3.0 * 0.15, 1e-12);
}

static void growing_differences_give_no_order(void **state) {
    (void)state;
    static const double growing[] = {3.0, 3.1, 3.3}, straight[] = {1.0, 2.0, 3.0};
    static const double stalled[] = {3.0, 3.0, 3.3};
    assert_int_equal(refinement_convergence(growing, 3, 2.0, 2.0, SAFETY).kind,
                     CONVERGENCE_IRREGULAR);
    assert_int_equal(refinement_convergence(straight, 3, 2.0, 2.0, SAFETY).kind,
                     CONVERGENCE_IRREGULAR);
    assert_int_equal(refinement_convergence(stalled, 3, 2.0, 2.0, SAFETY).kind,
                     CONVERGENCE_IRREGULAR);
}

static void a_result_that_does_not_change_has_converged(void **state) {
    (void)state;
    static const double same[] = {2.0, 2.0, 2.0}, zero[] = {0.0, 0.0, 0.0};
    struct convergence c = refinement_convergence(same, 3, 2.0, 2.0, SAFETY);
    assert_int_equal(c.kind, CONVERGENCE_NONE);
    assert_true(refinement_is_within(&c, 2.0, 1e-12));
    c = refinement_convergence(zero, 3, 2.0, 2.0, SAFETY);
    assert_true(refinement_is_within(&c, 0.0, 1e-12));
}

static void a_value_that_is_no_number_has_not_converged(void **state) {
    (void)state;
    static const double value[] = {2.0, 2.0, NAN};
    struct convergence c = refinement_convergence(value, 3, 2.0, 2.0, SAFETY);
    assert_false(refinement_is_within(&c, NAN, 1.0));
}

static void counts_must_be_equal_at_the_last_two_levels(void **state) {
    (void)state;
    static const double settled[] = {5.0, 7.0, 7.0}, open[] = {700.0, 700.0, 701.0};
    struct convergence c = refinement_convergence_of_count(settled, 3);
    assert_int_equal(c.kind, CONVERGENCE_COUNT);
    assert_true(refinement_is_within(&c, 7.0, 1e-3));
    c = refinement_convergence_of_count(open, 3);
    assert_int_equal(c.kind, CONVERGENCE_MISCOUNT);
    assert_close(c.error, 1.0, 1e-15);
    assert_false(refinement_is_within(&c, 701.0, 0.1));
}

static void the_tolerance_is_that_of_the_error_bar(void **state) {
    (void)state;
    double value[3];
    make_up(value, 3, 0.016, 2.0, 2.0);  // the last one is off by 1e-3, the bar is 1.25e-3
    struct convergence c = refinement_convergence(value, 3, 2.0, 2.0, SAFETY);
    assert_true(refinement_is_within(&c, value[2], 1.26e-3 / LIMIT));
    assert_false(refinement_is_within(&c, value[2], 1.24e-3 / LIMIT));
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_pure_power_gives_its_order_and_its_limit),
        cmocka_unit_test(the_ratio_of_the_steps_may_be_another_one),
        cmocka_unit_test(only_the_last_three_levels_count),
        cmocka_unit_test(a_disturbed_power_is_inside_its_error_bar),
        cmocka_unit_test(an_order_above_that_of_the_method_is_not_used),
        cmocka_unit_test(going_back_and_forth_gives_no_order),
        cmocka_unit_test(growing_differences_give_no_order),
        cmocka_unit_test(a_result_that_does_not_change_has_converged),
        cmocka_unit_test(a_value_that_is_no_number_has_not_converged),
        cmocka_unit_test(counts_must_be_equal_at_the_last_two_levels),
        cmocka_unit_test(the_tolerance_is_that_of_the_error_bar),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
