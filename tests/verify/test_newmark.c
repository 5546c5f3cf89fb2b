// SPDX-License-Identifier: GPL-3.0-or-later
// The integrator against closed forms of linear vibration: orders of accuracy for several beta and
// gamma, damping, resonance, modes, numerical damping, and what different grounds do.
#include <math.h>

#include "support/analysis.h"
#include "support/support.h"

static const double PI = 3.141592653589793;

// omega = 2 pi: one cycle a second from u = 1 without damping. The error at t = 1.3 s.
static double free_error(double beta, double gamma, double dt) {
    struct analysis a = analysis_of(
        "building A -floors 1 -mass 1 -stiffness ${4*pi^2}\ninitial A:1 -displacement 1\n"
        "integrator newmark -beta %.17g -gamma %.17g\nduration 1.3\nstep fixed %.17g\n",
        beta, gamma, dt);
    double error = fabs(a.rows.displacement[a.rows.n - 1] - cos(2.0 * PI * 1.3));
    analysis_free(&a);
    return error;
}

// From n to 2 n steps.
static double order(double beta, double gamma, int n) {
    return log2(free_error(beta, gamma, 1.3 / n) / free_error(beta, gamma, 1.3 / (2 * n)));
}

static void gamma_of_one_half_is_second_order(void **state) {
    (void)state;
    const double beta[] = {0.0, 1.0 / 6.0, 0.25, 0.5};
    for (size_t i = 0; i < sizeof beta / sizeof beta[0]; i++) {
        assert_near(order(beta[i], 0.5, 64), 2.0, 0.06);
    }
}

// Fox & Goodwin: beta = 1/12 cancels the leading error of the period.
static void beta_of_one_twelfth_is_fourth_order_without_damping(void **state) {
    (void)state;
    assert_near(order(1.0 / 12.0, 0.5, 64), 4.0, 0.1);
}

static void gamma_above_one_half_is_first_order_and_damps(void **state) {
    (void)state;
    assert_near(order(0.3025, 0.6, 4096), 1.0, 0.01);
    struct analysis a = analysis_of(
        "building A -floors 1 -mass 1 -stiffness ${4*pi^2}\ninitial A:1 -displacement 1\n"
        "integrator newmark -beta 0.3025 -gamma 0.6\nduration 20\nstep fixed 0.02\n");
    assert_true(fabs(a.rows.displacement[a.rows.n - 1]) < 0.9);
    assert_true(a.results->energy[ENERGY_RESIDUAL] > 0.1 * 2.0 * PI * PI);
    analysis_free(&a);
}

// u = e^(-zeta w t) (cos wd t + zeta w / wd sin wd t).
static void free_vibration_decays_as_its_ratio_says(void **state) {
    (void)state;
    struct analysis a = analysis_of(
        "building A -floors 1 -mass 2t -stiffness ${2000*(2*pi)^2}\n"
        "damping A rayleigh 5%%\ninitial A:1 -displacement 10mm\nduration 5\nstep fixed 1e-4\n");
    double zeta = 0.05;
    double w = 2.0 * PI;
    double wd = w * sqrt(1.0 - zeta * zeta);
    for (long i = 0; i < a.rows.n; i += 25) {
        double t = a.rows.time[i];
        double exact = 0.01 * exp(-zeta * w * t) * (cos(wd * t) + zeta * w / wd * sin(wd * t));
        assert_near(a.rows.displacement[i], exact, 1e-8);
    }
    analysis_free(&a);
}

// At resonance the steady amplitude is (A / w^2) / (2 zeta).
static void resonance_reaches_its_steady_amplitude(void **state) {
    (void)state;
    struct analysis a =
        analysis_of("building A -floors 1 -mass 1 -stiffness ${(2*pi)^2}\ndamping A rayleigh 10%%\n"
                    "ground sine -amplitude 1 -frequency 1\nduration 20\nstep fixed 0.5ms\n");
    double steady = 1.0 / (4.0 * PI * PI) / 0.2;
    assert_close(a.results->peak[PEAK_DISPLACEMENT][0], steady, 2e-5);
    analysis_free(&a);
}

// A mode shape given as initial state vibrates at its own frequency and stays a multiple of itself.
static void a_mode_vibrates_alone(void **state) {
    (void)state;
    struct analysis a =
        analysis_of("building A -floors 2 -mass 1 -stiffness 100\n"
                    "initial A:1 -displacement ${(sqrt(5)-1)/2}\ninitial A:2 -displacement 1\n"
                    "duration 3\nstep fixed 1e-4\n");
    double omega = 10.0 * 2.0 * sin(PI / 10.0);
    for (long i = 0; i < a.rows.n; i += 10) {
        double exact = cos(omega * a.rows.time[i]);
        assert_near(a.rows.displacement[2 * i + 1], exact, 1e-6);
        assert_near(a.rows.displacement[2 * i], exact * (sqrt(5.0) - 1.0) / 2.0, 1e-6);
    }
    analysis_free(&a);
}

// A free body stays where it is while the ground moves: u = -u_ground, and the gap to a body on
// another ground does not change. The sine under B starts with a jump of 1.7 m/s2, which a step
// takes half a step early or late: 1.7 / 2 x 1e-4 m/s, in 1.9 s 1.6e-4 m.
static void free_bodies_on_different_grounds_keep_their_distance(void **state) {
    (void)state;
    struct analysis a = analysis_of(
        "building A -floors 1 -mass 1 -stiffness 0\nbuilding B -floors 1 -mass 2 -stiffness 0\n"
        "ground sine -amplitude 3 -frequency 2 -buildings A\n"
        "ground sine -amplitude 2 -frequency 1 -delay 0.1 -phase 1 -buildings B\n"
        "contact A B -gap 0.4 -law linear -k 1e4\nduration 2\nstep fixed 1e-4\noutput -every 1\n");
    assert_int_equal(a.results->n_impact, 0);
    for (long i = 0; i < a.rows.n; i += 100) {
        assert_near(a.rows.penetration[i], -0.4, 1.7e-4);
    }
    assert_true(fabs(a.rows.displacement[2 * (a.rows.n - 1)]) > 0.3);
    analysis_free(&a);
}

// The same two bodies on the same and on no ground meet at the same instants.
static void a_ground_under_all_free_bodies_does_not_change_their_impacts(void **state) {
    (void)state;
    static const char bodies[] =
        "building A -floors 1 -mass 1 -stiffness 0\nbuilding B -floors 1 -mass 2 -stiffness 0\n"
        "initial A:1 -velocity 1\ncontact A B -gap 0.1 -law linear -k 1e4\n"
        "duration 0.3\nstep fixed 1e-4\n";
    struct analysis still = analysis_of("%s", bodies);
    struct analysis shaken = analysis_of("%sground sine -amplitude 3 -frequency 2\n", bodies);
    assert_int_equal(shaken.results->n_impact, 1);
    assert_near(shaken.results->impact[0].t_start, still.results->impact[0].t_start, 1e-12);
    assert_close(shaken.results->impact[0].peak_force, still.results->impact[0].peak_force, 1e-9);
    assert_true(shaken.results->residual_peak < 1e-12);
    analysis_free(&still);
    analysis_free(&shaken);
}

// A damper of a power below 1 is infinitely steep at rest: all digits of its force are those of a
// velocity that is a small difference of accelerations.
static void a_steep_damper_at_rest_is_solved_to_rounding(void **state) {
    (void)state;
    struct analysis a =
        analysis_of("units N m s\n"
                    "building A -floors 2 -mass 657.805 -stiffness 1025.44\n"
                    "building B -floors 5 -mass 7206.52 -stiffness 0\n"
                    "link A:1 B:1 -stiffness 7450.1 -dashpot 68715 -exponent 0.645\n"
                    "ground sine -amplitude 1.712 -frequency 14.25\n"
                    "step fixed 5.96317e-05\nduration 0.0149079\n");
    assert_int_equal(a.results->totals.rejected, 0);
    assert_int_equal(a.results->totals.unsolved, 0);
    analysis_free(&a);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(gamma_of_one_half_is_second_order),
        cmocka_unit_test(beta_of_one_twelfth_is_fourth_order_without_damping),
        cmocka_unit_test(gamma_above_one_half_is_first_order_and_damps),
        cmocka_unit_test(free_vibration_decays_as_its_ratio_says),
        cmocka_unit_test(resonance_reaches_its_steady_amplitude),
        cmocka_unit_test(a_mode_vibrates_alone),
        cmocka_unit_test(free_bodies_on_different_grounds_keep_their_distance),
        cmocka_unit_test(a_ground_under_all_free_bodies_does_not_change_their_impacts),
        cmocka_unit_test(a_steep_damper_at_rest_is_solved_to_rounding),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
