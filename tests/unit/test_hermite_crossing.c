// SPDX-License-Identifier: GPL-3.0-or-later
// Zeros of the cubic through both ends of a step.
#include <math.h>

#include "solve/event/hermite.h"
#include "support/support.h"

static double time_of(double d0, double v0, double d1, double v1, double h, double *rate) {
    struct path path = {d0, v0, d1, v1, h};
    return hermite_crossing(&path, rate);
}

static void a_straight_path_is_crossed_where_it_is(void **state) {
    (void)state;
    double rate;
    assert_close(time_of(-0.2, 1.0, 0.8, 1.0, 1.0, &rate), 0.2, 1e-14);
    assert_close(rate, 1.0, 1e-14);
    assert_close(time_of(0.3, -2.0, -0.1, -2.0, 0.2, &rate), 0.15, 1e-14);
    assert_close(rate, -2.0, 1e-14);
}

// d = x^3 - x / 4 - 1/50 on [0, 1]: the cubic is reproduced, whatever its shape.
static void a_cubic_path_is_reproduced(void **state) {
    (void)state;
    double rate;
    double t = time_of(-0.02, -0.25, 0.73, 2.75, 1.0, &rate);
    assert_near(t * t * t - 0.25 * t - 0.02, 0.0, 1e-14);
    assert_close(rate, 3.0 * t * t - 0.25, 1e-12);
}

static void a_zero_at_an_end_is_found_there(void **state) {
    (void)state;
    double rate;
    assert_true(time_of(0.0, 2.0, 1.0, 1.0, 0.5, &rate) == 0.0);
    assert_true(rate == 2.0);
    assert_true(time_of(-1.0, 2.0, 0.0, 1.0, 0.5, &rate) == 0.5);
    assert_true(rate == 1.0);
}

// Closed at d = 0 with v = 1, open again at the end: the opening is the second zero.
static void from_zero_upwards_and_back_it_is_the_second_zero(void **state) {
    (void)state;
    double rate;
    double t = time_of(0.0, 1.0, -1.0, -3.0, 1.0, &rate);
    assert_close(t, 0.5, 1e-12);
    assert_close(rate, -1.0, 1e-12);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_straight_path_is_crossed_where_it_is),
        cmocka_unit_test(a_cubic_path_is_reproduced),
        cmocka_unit_test(a_zero_at_an_end_is_found_there),
        cmocka_unit_test(from_zero_upwards_and_back_it_is_the_second_zero),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
