// SPDX-License-Identifier: GPL-3.0-or-later
// The order of accuracy of an isolated impact, law by law: the error of the restitution, its root
// mean square over closures at eight different phases of the step, for steps of 1/40 and 1/80 of
// the contact.
#include <math.h>
#include <stdio.h>

#include "support/analysis.h"
#include "support/support.h"

enum { PHASES = 8 };

static double restitution(const char *law, double dt, double gap) {
    struct analysis a = analysis_of(
        "building A -floors 1 -mass 25t -stiffness 0\nbuilding B -floors 1 -mass 40t -stiffness 0\n"
        "initial A:1 -velocity 0.5\ncontact A B -gap %.17g -law %s\n"
        "duration 0.08\nstep fixed %.17g\noutput -every 1000\n",
        gap, law, dt);
    assert_int_equal(a.results->n_impact, 1);
    double e = a.results->impact[0].v_rebound / a.results->impact[0].v_approach;
    analysis_free(&a);
    return e;
}

static double error(const char *law, double dt, double exact) {
    double sum = 0.0;
    for (int i = 0; i < PHASES; i++) {
        double e = restitution(law, dt, 0.01 + 0.5 * dt * i / PHASES) - exact;
        sum += e * e;
    }
    return sqrt(sum / PHASES);
}

static double order(const char *law, double exact) {
    return log2(error(law, 1e-3, exact) / error(law, 5e-4, exact));
}

static void linear_springs_are_second_order(void **state) {
    (void)state;
    assert_near(order("linear -k 93.5e6", 1.0), 2.0, 0.1);
}

// Splitting steps where the force jumps keeps the second order; stepping over a jump gives the
// first.
static void dashpots_that_jump_are_second_order(void **state) {
    (void)state;
    assert_near(order("kelvin-voigt -k 93.5e6 -e 0.65", 0.65), 2.0, 0.1);
    assert_near(order("komodromos -k 93.5e6 -zeta 0.14993876", 0.65), 2.0, 0.1);
    assert_near(order("mahmoud-jankowski -k 93.5e6 -e 0.65 -calibrate", 0.65), 2.0, 0.1);
}

// q of 0.65: root of q (1 + e) = ln((1 + q) / (1 - e q)).
static void the_laws_of_hertz_are_second_order(void **state) {
    (void)state;
    assert_true(order("hertz -k 2.75e9", 1.0) > 1.9);
    assert_near(order("hertz-damp -k 2.75e9 -zeta 0.79310091", 0.65), 2.0, 0.1);
}

// The dashpot grows like d^(1/4): a closure that the step passes over costs h^(5/4).
static void jankowski_is_of_order_five_quarters(void **state) {
    (void)state;
    assert_near(order("jankowski -k 2.75e9 -zeta 0.36816161", 0.65), 1.25, 0.05);
}

// The branch and the history change at v = 0, where the slope of the force jumps. The exact values
// are the closed form of khatami, e^2 = 1 - R, and an independent integration.
static void laws_that_turn_at_rest_are_second_order(void **state) {
    (void)state;
    assert_near(order("khatami -k 2.75e9 -e 0.65 -calibrate", 0.65), 2.0, 0.1);
    assert_near(order("wang -k 2.75e9 -zeta 0 -residual 0.5", sqrt(0.5)), 2.0, 0.1);
    assert_near(order("wang -k 2.75e9 -zeta 2.75e9 -residual 0.25", 0.7531330236771263), 2.0, 0.1);
}

static void the_family_with_hysteresis_damping_is_second_order(void **state) {
    (void)state;
    assert_near(order("ye-kelvin -k 93.5e6 -e 0.65 -calibrate", 0.65), 2.0, 0.1);
    assert_near(order("power -k 2.75e9 -n 1.5 -e 0.65", 0.65), 2.0, 0.1);
}

// A bumper that delivers e exactly, its release on another branch.
static void the_bumper_is_second_order(void **state) {
    (void)state;
    assert_near(order("rubber -k 20e9 -n 2 -e 0.5", 0.5), 2.0, 0.1);
}

// The force has kinks at dy, after 1 ms, and at the turn. The error depends on where in the step
// they are, so only the mean over several halvings tells, at steps far below 1 ms. E = m v^2 / 2 =
// k1 dy^2 / 2 + k1 dy x + k2 x^2 / 2 gives x = d_max - dy, and (k1 - k2) dy x is lost.
static void kinks_leave_the_second_order_in_the_mean(void **state) {
    (void)state;
    const double k1 = 560e6, k2 = 60e6, dy = 0.5e-3;
    const double energy = 25e3 * 40e3 / 65e3 * 0.5 * 0.5 / 2.0;
    const double force = k1 * dy, rest = energy - force * dy / 2.0;
    const double x = (sqrt(force * force + 2.0 * k2 * rest) - force) / k2;
    const double e = sqrt(1.0 - (k1 - k2) * dy * x / energy);
    const char *law = "bilinear -k1 560e6 -k2 60e6 -dy 0.5e-3";
    const double mean = log2(error(law, 1e-3 / 32, e) / error(law, 1e-3 / 512, e)) / 4.0;
    // The factor of h^2 varies by 2 from one step to another: log2(2) / 4.
    assert_near(mean, 2.0, 0.25);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(linear_springs_are_second_order),
        cmocka_unit_test(dashpots_that_jump_are_second_order),
        cmocka_unit_test(the_laws_of_hertz_are_second_order),
        cmocka_unit_test(jankowski_is_of_order_five_quarters),
        cmocka_unit_test(laws_that_turn_at_rest_are_second_order),
        cmocka_unit_test(the_family_with_hysteresis_damping_is_second_order),
        cmocka_unit_test(the_bumper_is_second_order),
        cmocka_unit_test(kinks_leave_the_second_order_in_the_mean),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
