// SPDX-License-Identifier: GPL-3.0-or-later
// Intensities of records whose integrals are known in closed form.
#include <gsl/gsl_math.h>
#include <math.h>

#include "core/arena.h"
#include "jostle/intensity.h"
#include "support/support.h"

static const double G = 9.80665;
static const double ROUNDING = 1e-14;

static struct intensity intensity_of_values(const double *value, size_t n, double dt) {
    struct arena *a = arena_create();
    struct signal s;
    struct error e;
    assert_non_null(a);
    assert_int_equal(signal_init_samples(&s, a, value, n, dt, 1.0, 0.0, &e), STATUS_OK);
    struct intensity out = intensity_of(&s, G);
    arena_free(a);
    return out;
}

// The integral of the square is t^3 / 3 up to the top, and comes down as it went up.
static void a_triangle_has_its_integrals(void **state) {
    (void)state;
    const struct intensity i = intensity_of_values((const double[]){0.0, 1.0, 0.0}, 3, 1.0);
    assert_close(i.pga, 1.0, ROUNDING);
    assert_close(i.pga_time, 1.0, ROUNDING);
    assert_close(i.pgv, 1.0, ROUNDING);
    assert_close(i.pgv_time, 2.0, ROUNDING);
    assert_close(i.pgd, 1.0, ROUNDING);
    assert_close(i.cav, 1.0, ROUNDING);
    assert_close(i.arias, M_PI / (2.0 * G) * 2.0 / 3.0, ROUNDING);
    assert_close(i.time_5, cbrt(0.1), ROUNDING);
    assert_close(i.d5_95, 2.0 - 2.0 * cbrt(0.1), ROUNDING);
    assert_close(i.d5_75, 2.0 - cbrt(0.5) - cbrt(0.1), ROUNDING);
}

// The rule of the samples exceeds both integrals, by hand: squares 1/2 (1 + 1) against 2/3 for the
// triangle, and 2 (1 + 1) / 2 against 1 for |a| where the sign changes.
static void the_trapezoidal_rule_is_told_apart(void **state) {
    (void)state;
    struct intensity i = intensity_of_values((const double[]){0.0, 1.0, 0.0}, 3, 1.0);
    assert_close(i.arias_trapezoid, M_PI / (2.0 * G), ROUNDING);
    assert_close(i.cav_trapezoid, 1.0, ROUNDING);
    i = intensity_of_values((const double[]){1.0, -1.0}, 2, 2.0);
    assert_close(i.arias_trapezoid, M_PI / (2.0 * G) * 2.0, ROUNDING);
    assert_close(i.cav_trapezoid, 2.0, ROUNDING);
}

// v = t - t^2 / 2 is largest at t = 1, where the sign changes.
static void a_change_of_sign_within_a_step_is_exact(void **state) {
    (void)state;
    const struct intensity i = intensity_of_values((const double[]){1.0, -1.0}, 2, 2.0);
    assert_close(i.pgv, 0.5, ROUNDING);
    assert_close(i.pgv_time, 1.0, ROUNDING);
    assert_close(i.pgd, 2.0 / 3.0, ROUNDING);
    assert_close(i.cav, 1.0, ROUNDING);
    assert_close(i.arias, M_PI / (2.0 * G) * 2.0 / 3.0, ROUNDING);
    assert_close(i.time_5, 1.0 - cbrt(0.9), 10.0 * ROUNDING);
}

// u = t^2 / 2 - t^3 / 4 turns at t = 4/3 and is back at 0 at the end.
static void a_displacement_that_turns_within_a_step_is_exact(void **state) {
    (void)state;
    const struct intensity i = intensity_of_values((const double[]){1.0, -2.0}, 2, 2.0);
    assert_close(i.pgd, 8.0 / 27.0, ROUNDING);
    assert_close(i.pgd_time, 4.0 / 3.0, ROUNDING);
    assert_close(i.pga, 2.0, ROUNDING);
    assert_close(i.pga_time, 2.0, ROUNDING);
}

static void a_constant_acceleration_has_its_integrals(void **state) {
    (void)state;
    const struct intensity i = intensity_of_values((const double[]){-3.0, -3.0, -3.0}, 3, 0.5);
    assert_close(i.pgv, 3.0, ROUNDING);
    assert_close(i.pgd, 1.5, ROUNDING);
    assert_close(i.cav, 3.0, ROUNDING);
    assert_close(i.time_5, 0.05, ROUNDING);
    assert_close(i.d5_75, 0.70, ROUNDING);
    assert_close(i.d5_95, 0.90, ROUNDING);
}

// Ten cycles of 2000 straight lines: off the sine by (pi / 2000)^2 / 2, 1.2e-6 of its integrals.
static void a_sine_has_its_integrals(void **state) {
    (void)state;
    enum { N = 20001 };
    static const double amplitude = 2.0, cycle = 0.5, within = 3e-6;
    double value[N];
    const double omega = 2.0 * M_PI / cycle, dt = cycle / 2000.0, length = 10.0 * cycle;
    for (int j = 0; j < N; j++) {
        value[j] = amplitude * sin(omega * j * dt);
    }
    const struct intensity i = intensity_of_values(value, N, dt);
    assert_close(i.pga, amplitude, ROUNDING);
    assert_close(i.pgv, 2.0 * amplitude / omega, within);
    assert_close(i.pgd, amplitude / omega * length, within);
    assert_close(i.cav, amplitude * 2.0 / M_PI * length, within);
    assert_close(i.arias, M_PI / (2.0 * G) * amplitude * amplitude / 2.0 * length, within);
    // Energy comes in equal shares each half cycle: 5, 75 and 95 % are at ends of half cycles.
    assert_close(i.time_5, 0.05 * length, 1e-3);
    assert_close(i.d5_75, 0.70 * length, 1e-3);
    assert_close(i.d5_95, 0.90 * length, 1e-3);
}

static void a_record_of_zeros_has_no_intensity(void **state) {
    (void)state;
    const struct intensity i = intensity_of_values((const double[]){0.0, 0.0, 0.0}, 3, 0.5);
    const double all[] = {i.pga, i.pgv, i.pgd, i.arias, i.cav, i.time_5, i.d5_75, i.d5_95};
    for (size_t k = 0; k < sizeof all / sizeof all[0]; k++) {
        assert_true(all[k] == 0.0);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_triangle_has_its_integrals),
        cmocka_unit_test(the_trapezoidal_rule_is_told_apart),
        cmocka_unit_test(a_change_of_sign_within_a_step_is_exact),
        cmocka_unit_test(a_displacement_that_turns_within_a_step_is_exact),
        cmocka_unit_test(a_constant_acceleration_has_its_integrals),
        cmocka_unit_test(a_sine_has_its_integrals),
        cmocka_unit_test(a_record_of_zeros_has_no_intensity),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
