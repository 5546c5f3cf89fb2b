// SPDX-License-Identifier: GPL-3.0-or-later
// Two histories beside each other.
#include "study/comparison.h"

#include <math.h>
#include <string.h>

#include "support/support.h"

enum { N = 400 };

// sin(2 t) + 0.3 sin(5 t), `late` and times a factor, at steps of h from `start`.
static struct time_series wave(double *time, double *value, size_t n, double start, double h,
                               double late, double factor) {
    for (size_t i = 0; i < n; i++) {
        time[i] = start + h * (double)i;
        const double t = time[i] - late;
        value[i] = factor * (sin(2.0 * t) + 0.3 * sin(5.0 * t));
    }
    return (struct time_series){n, time, value};
}

static struct comparison compare(double late, double factor, double tolerance) {
    double t[N], x[N], s[N], r[N];
    const struct time_series computed = wave(t, x, N, 0.0, 0.05, late, factor);
    const struct time_series reference = wave(s, r, N / 2, 1.0, 0.08, 0.0, 1.0);
    struct comparison c;
    struct error e;
    assert_int_equal(comparison_make(&computed, &reference, tolerance, &c, &e), STATUS_OK);
    return c;
}

static void equal_histories_at_other_times_do_not_differ(void **state) {
    (void)state;
    const struct comparison c = compare(0.0, 1.0, 0.01);
    // Between rows the curve of third order errs by about h^2 at crests.
    assert_true(c.difference < 2e-3 && c.error < 1e-3);
    assert_true(isnan(c.first_time));
    assert_true(c.correlation > 0.99999 && fabs(c.shift) < 1e-3);
    assert_close(c.peak[0], c.peak[1], 1e-3);
}

static void a_factor_is_the_error_and_the_difference(void **state) {
    (void)state;
    const struct comparison c = compare(0.0, 1.25, 0.1);
    assert_close(c.error, 0.25, 5e-3);
    assert_close(c.difference, 0.25, 5e-3);
    assert_close(c.peak[0], 1.25 * c.peak[1], 1e-3);
    assert_close(c.difference_time, c.peak_time[1], 1e-12);
    assert_true(c.first_time >= 1.0 && c.first_time <= c.difference_time);
    assert_true(c.correlation > 0.99999);
}

static void a_late_history_has_a_positive_shift(void **state) {
    (void)state;
    assert_close(compare(0.12, 1.0, 0.1).shift, 0.12, 0.01);
    assert_close(compare(-0.12, 1.0, 0.1).shift, -0.12, 0.01);
}

static void rows_in_common_are_exact(void **state) {
    (void)state;
    double t[] = {0.0, 1.0, 2.0, 3.0, 4.0}, x[] = {0.0, 1.0, -3.0, 1.0, 0.5};
    double s[] = {1.0, 2.0, 3.0}, r[] = {1.0, -2.0, 1.0};
    const struct time_series computed = {5, t, x}, reference = {3, s, r};
    struct comparison c;
    struct error e;
    assert_int_equal(comparison_make(&computed, &reference, 0.5, &c, &e), STATUS_OK);
    assert_close(c.difference, 0.5, 0.0);
    assert_close(c.difference_time, 2.0, 0.0);
    assert_true(isnan(c.first_time));
    assert_close(c.error, sqrt(1.0 / 6.0), 1e-15);
    assert_close(c.peak[0], 3.0, 0.0);
    // The mean of (1, -3, 1) is -1/3, and that of (1, -2, 1) is 0: both are one line.
    assert_close(c.correlation, 1.0, 1e-14);
}

static void histories_without_common_times_are_refused(void **state) {
    (void)state;
    double t[] = {0.0, 1.0, 2.0}, s[] = {3.0, 4.0, 5.0}, x[] = {0.0, 1.0, 0.0};
    const struct time_series computed = {3, t, x}, reference = {3, s, x};
    struct comparison c;
    struct error e;
    assert_int_equal(comparison_make(&computed, &reference, 0.5, &c, &e), STATUS_INPUT);
    assert_non_null(strstr(e.message, "fewer than 3 instants in common"));
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(equal_histories_at_other_times_do_not_differ),
        cmocka_unit_test(a_factor_is_the_error_and_the_difference),
        cmocka_unit_test(a_late_history_has_a_positive_shift),
        cmocka_unit_test(rows_in_common_are_exact),
        cmocka_unit_test(histories_without_common_times_are_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
