// SPDX-License-Identifier: GPL-3.0-or-later
// Where the curve of a sample crosses a limit, against splines by hand.
#include <gsl/gsl_errno.h>
#include <gsl/gsl_math.h>

#include "study/capacity.h"
#include "support/support.h"

static double crossing(const double *x, const double *y, int n, double limit,
                       enum capacity_curve curve) {
    struct capacity c = {.n_point = n};
    for (int i = 0; i < n; i++) {
        c.point[i] = (struct capacity_point){x[i], y[i], y[i] > limit};
    }
    return capacity_curve_crossing(&c, limit, curve);
}

// The natural spline through (1, 0), (2, 1), (3, 0) is 1.5 t - 0.5 t^3 in the first half, t = x
// - 1.
static void the_spline_is_natural(void **state) {
    (void)state;
    const double x[] = {1, 2, 3}, y[] = {0, 1, 0};
    assert_close(crossing(x, y, 3, 0.6875, CAPACITY_SPLINE), 1.5, 1e-10);
    assert_close(crossing(x, y, 3, 0.6875, CAPACITY_LINE), 1.6875, 1e-15);
    assert_close(crossing(x, y, 3, 0.6875, CAPACITY_MIDDLE), M_SQRT2, 1e-15);
}

// Two points, and three on a line, have a line for a spline.
static void a_line_is_its_own_spline(void **state) {
    (void)state;
    const double x[] = {0.5, 2, 7}, y[] = {1, 4, 14};
    assert_close(crossing(x, y, 3, 6.0, CAPACITY_SPLINE), 3.0, 1e-11);
    assert_close(crossing(x, y, 2, 3.0, CAPACITY_SPLINE), 1.5, 1e-15);
}

static void a_jump_is_in_the_middle(void **state) {
    (void)state;
    const double x[] = {1, 2, 4, 8}, y[] = {0.1, 0.2, INFINITY, INFINITY}, count[] = {0, 0, 1, 1};
    assert_close(crossing(x, y, 4, 0.3, CAPACITY_SPLINE), 2.0 * M_SQRT2, 1e-15);
    assert_close(crossing(x, count, 4, 0.0, CAPACITY_SPLINE), 2.0 * M_SQRT2, 1e-15);
    // The points above all values end the spline, and do not spoil it.
    const double last[] = {0.1, 0.2, 0.4, INFINITY};
    assert_close(crossing(x, last, 4, 0.3, CAPACITY_SPLINE), 3.0, 1e-11);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_spline_is_natural),
        cmocka_unit_test(a_line_is_its_own_spline),
        cmocka_unit_test(a_jump_is_in_the_middle),
    };
    gsl_set_error_handler_off();
    return cmocka_run_group_tests(tests, NULL, NULL);
}
