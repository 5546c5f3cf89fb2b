// SPDX-License-Identifier: GPL-3.0-or-later
// The method of Dormand & Prince with adaptive steps: errors go with the tolerance, events are
// located, peaks are those between the steps, the account of energy closes, and what it cannot do
// ends with advice.
#include <gsl/gsl_math.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "support/analysis.h"
#include "support/random_deck.h"
#include "support/support.h"

// 2 Hz: omega = 4 pi.
#define OSCILLATOR "building A -floors 1 -mass 1000 -stiffness 157913.67041742973\n"
static const double OMEGA = 4.0 * M_PI;

static void a_free_vibration_follows_the_cosine_and_its_peaks_are_exact(void **state) {
    (void)state;
    struct analysis a = analysis_of(OSCILLATOR "initial A:1 -displacement 0.1 -velocity 0.5\n"
                                               "step adaptive -tolerance 1e-10\nduration 3\n");
    double amplitude = hypot(0.1, 0.5 / OMEGA);
    for (long i = 0; i < a.rows.n; i++) {
        double t = a.rows.time[i];
        assert_near(a.rows.displacement[i], 0.1 * cos(OMEGA * t) + 0.5 / OMEGA * sin(OMEGA * t),
                    1e-8 * amplitude);
    }
    assert_close(a.results->peak[PEAK_DISPLACEMENT][0], amplitude, 1e-8);
    assert_close(a.results->peak[PEAK_VELOCITY][0], OMEGA * amplitude, 1e-8);
    assert_close(a.results->peak[PEAK_ACCELERATION][0], OMEGA * OMEGA * amplitude, 1e-8);
    assert_close(a.results->peak[PEAK_DRIFT][0], amplitude, 1e-8);
    assert_true(a.results->totals.steps < 2000);
    analysis_free(&a);
}

// Without damping the roof's mass has the acceleration that its storey's shear gives it; the peaks
// of shears are those of the interpolated drift.
static void peaks_of_accelerations_are_those_of_forces(void **state) {
    (void)state;
    for (int i = 0; i < 20; i++) {
        struct analysis a =
            analysis_of("building A -floors 2 -mass 3e5 -stiffness 3.45e8\n"
                        "ground sine -amplitude 0.3g -frequency %g -cycles 4 -phase 1\n"
                        "step adaptive -tolerance 1e-9\nduration 2\n",
                        1.0 + 0.37 * i);
        assert_close(a.results->peak[PEAK_ACCELERATION][1], a.results->peak[PEAK_SHEAR][1] / 3e5,
                     1e-7);
        analysis_free(&a);
    }
}

// u = (v / omega) sin(omega t): the acceleration is largest, v omega, at a quarter of the period,
// inside one of a few steps. With a second ground that hardly moves, other bounds tell that a peak
// may be there.
static void peaks_of_accelerations_between_steps_are_exact(void **state) {
    (void)state;
    static const char *const other[] = {
        "", "building B -floors 1 -mass 1 -stiffness 100\n"
            "ground sine -amplitude 1e-9 -frequency 1Hz -buildings B\n"};
    for (int i = 0; i < 2; i++) {
        struct analysis a = analysis_of(OSCILLATOR "initial A:1 -velocity 0.3\n%s"
                                                   "step adaptive -tolerance 1e-7\nduration 0.3\n",
                                        other[i]);
        const double omega = 4.0 * acos(-1.0);
        assert_close(a.results->peak[PEAK_ACCELERATION][0], 0.3 * omega, 1e-7);
        assert_close(a.results->peak_time[PEAK_ACCELERATION][0], 0.125, 1e-4);
        analysis_free(&a);
    }
}

// A mass of 2 under 10 for half a second, after which it keeps its velocity; so says the impulse.
static void a_load_that_ends_at_once_leaves_a_constant_velocity(void **state) {
    (void)state;
    const char *path = support_write("load.txt", "10\n10\n");
    struct analysis a = analysis_of("building A -floors 1 -mass 2 -stiffness 0\n"
                                    "load A:1 history %s -dt 0.5\nintegrator dormand-prince\n"
                                    "step adaptive -tolerance 1e-6\nduration 2\n",
                                    path);
    assert_close(a.rows.velocity[a.rows.n - 1], 2.5, 1e-13);
    assert_close(analysis_displacement(&a, 0, 2.0), 0.625 + 2.5 * 1.5, 1e-13);
    analysis_free(&a);
}

static double end_of_impacts(double tolerance, double *residual) {
    struct analysis a = analysis_of(
        "building A -floors 2 -mass 3e5 -stiffness 3.45e8\ndamping A rayleigh 0.05 -modes 1 2\n"
        "building B -floors 1 -mass 2e5 -stiffness 4e8\ndamping B modal 0.03\n"
        "initial A:2 -velocity 2\ncontact A:1 B:1 -gap 5mm -law jankowski -k 2.75e9 -e 0.65\n"
        "ground sine -amplitude 0.3g -frequency 2.5Hz -cycles 4\n"
        "step adaptive -tolerance %g\nduration 2\n",
        tolerance);
    assert_true(a.results->n_impact >= 5);
    *residual = a.results->residual_peak / a.results->energy[ENERGY_INPUT];
    double end = analysis_displacement(&a, 1, 2.0);
    analysis_free(&a);
    return end;
}

static void error_and_energy_residual_go_with_the_tolerance(void **state) {
    (void)state;
    double residual[4];
    double error[4];
    double converged = end_of_impacts(1e-12, &residual[3]);
    for (int i = 0; i < 3; i++) {
        double tolerance = pow(10.0, -4.0 - 2.0 * i);
        error[i] = fabs(end_of_impacts(tolerance, &residual[i]) - converged);
        assert_true(error[i] < 10.0 * tolerance * 0.1);  // displacements are about 0.1 m
        assert_true(residual[i] < 20.0 * tolerance);
    }
    assert_true(error[2] < error[0] / 100.0);
    assert_true(residual[3] < residual[0] / 1e5);
}

// Largest difference of displacements in the rows of two runs, from time t on.
static double difference(const struct analysis *a, const struct analysis *b, double t) {
    double largest = 0.0;
    assert_int_equal(a->rows.n, b->rows.n);
    for (long i = analysis_row(a, t) * a->rows.n_dof; i < a->rows.n * a->rows.n_dof; i++) {
        largest = fmax(largest, fabs(a->rows.displacement[i] - b->rows.displacement[i]));
    }
    return largest;
}

// What docs/performance.md measures: 68 impacts, and 9 s after the record.
static void two_buildings_are_followed_to_less_than_a_micrometre(void **state) {
    (void)state;
    static const char *const tolerance[] = {"3e-6", "1e-11"};
    struct analysis a[2];
    for (int i = 0; i < 2; i++) {
        a[i] = analysis_of("building A -floors 8 -mass 300t -stiffness 345MN/m\n"
                           "building B -floors 5 -mass 300t -stiffness 345MN/m\n"
                           "damping A rayleigh 5%%\ndamping B rayleigh 5%%\n"
                           "contact A B -gap 20mm -law jankowski -k 2.75e9N/m^1.5 -zeta 0.35\n"
                           "ground record input/records/ELCENTRO_1940_NS.AT2\nduration 40s\n"
                           "step adaptive -tolerance %s\n",
                           tolerance[i]);
        assert_int_equal(a[i].results->n_impact, 68);
    }
    // The tolerance times the largest displacement, 0.14 m, which one step may err by.
    assert_true(difference(&a[0], &a[1], 0.0) < 0.42e-6);
    // Few steps are rejected: less than 4 % of all.
    assert_true((double)a[0].results->totals.rejected < 0.04 * (double)a[0].results->totals.steps);
    for (int i = 0; i < 5; i++) {
        assert_close(a[0].results->link[i].penetration, a[1].results->link[i].penetration, 1e-5);
        assert_close(a[0].results->link[i].impulse, a[1].results->link[i].impulse, 1e-5);
    }
    analysis_free(&a[0]);
    analysis_free(&a[1]);
}

// Nothing ends the steps but their errors. The motion has died away by the factor 1e-5 after 33 s,
// and steps that are not stable would keep the fastest mode at the size of the tolerance.
static void a_motion_dies_away_however_long_steps_may_be(void **state) {
    (void)state;
    static const char *const tolerance[] = {"1e-3", "1e-9"};
    struct analysis a[2];
    for (int i = 0; i < 2; i++) {
        a[i] = analysis_of("building A -floors 8 -mass 300t -stiffness 345MN/m\n"
                           "damping A rayleigh 5%%\ninitial A:8 -displacement 0.1\n"
                           "duration 40\noutput -interval 0.1\nstep adaptive -tolerance %s\n",
                           tolerance[i]);
    }
    assert_true(difference(&a[0], &a[1], 33.0) < 1e-2 * 1e-3 * 0.1);
    assert_true(a[0].results->totals.rejected < 10);
    analysis_free(&a[0]);
    analysis_free(&a[1]);
}

static void impacts_against_a_wall_have_their_closed_forms(void **state) {
    (void)state;
    struct analysis a =
        analysis_of("building A -floors 1 -mass 2 -stiffness 0\ninitial A:1 -velocity 3\n"
                    "contact A wall -gap 0.3 -law kelvin-voigt -k 5e6 -e 0.65\n"
                    "step adaptive -tolerance 1e-10\nduration 0.15\n");
    const struct impact *p = &a.results->impact[0];
    assert_int_equal(a.results->n_impact, 1);
    assert_close(p->t_start, 0.1, 1e-12);
    assert_close(p->v_approach, 3.0, 1e-12);
    assert_close(p->v_rebound, 0.65 * 3.0, 1e-8);
    assert_close(p->impulse, 2.0 * 3.0 * 1.65, 1e-8);
    assert_close(p->dissipated, 9.0 * (1.0 - 0.65 * 0.65), 1e-8);
    assert_true(p->complete);
    analysis_free(&a);
    a = analysis_of("building A -floors 1 -mass 2 -stiffness 0\ninitial A:1 -velocity 3\n"
                    "contact A wall -gap 0.3 -law hertz -k 5e8\n"
                    "step adaptive -tolerance 1e-10\nduration 0.15\n");
    p = &a.results->impact[0];
    double deepest = pow(5.0 * 2.0 * 9.0 / (4.0 * 5e8), 0.4);
    assert_close(p->max_penetration, deepest, 1e-8);
    assert_close(p->peak_force, 5e8 * pow(deepest, 1.5), 1e-8);
    assert_close(p->t_end - p->t_start, 2.943275 * deepest / 3.0, 1e-6);
    analysis_free(&a);
}

// A mass under the constant force 20 N, 50 mm from a wall, meets it at 0.1 s with 1 m/s, and after
// n bounces with e^n; bounce n lasts 0.2 e^n s.
static void rigid_bodies_bounce_by_newton_s_law(void **state) {
    (void)state;
    const double e = 0.65;
    struct analysis a = analysis_of("building A -floors 1 -mass 2 -stiffness 0\n"
                                    "load A:1 constant 20\n"
                                    "contact A wall -gap 0.05 -law stereomechanical -e 0.65\n"
                                    "step adaptive\nduration 0.45\n");
    const struct results *r = a.results;
    double at = 0.1;
    assert_int_equal(r->n_impact, 7);
    for (int i = 0; i < 7; i++) {
        assert_near(r->impact[i].t_start, at, 1e-12);
        assert_close(r->impact[i].v_approach, pow(e, i), 1e-11);
        assert_close(r->impact[i].v_rebound, pow(e, i + 1), 1e-11);
        assert_close(r->impact[i].impulse, 2.0 * 1.65 * pow(e, i), 1e-11);
        assert_close(r->impact[i].dissipated, (1.0 - e * e) * pow(e, 2 * i), 1e-11);
        assert_true(isnan(r->impact[i].peak_force) && r->impact[i].complete);
        at += 0.2 * pow(e, i + 1);
    }
    assert_true(r->link[0].penetration < 1e-15);
    assert_true(r->residual_peak < 1e-12);
    analysis_free(&a);
}

// The oscillator, let go at -0.1 m, reaches the wall with a twentieth of its largest velocity and
// would leave it with less than the tolerance; its storey pulls it back at once.
static void rigid_bodies_that_part_where_they_come_to_rest_are_apart(void **state) {
    (void)state;
    struct analysis a =
        analysis_of("building A -floors 1 -mass 2 -stiffness 200\ninitial A:1 -displacement -0.1\n"
                    "contact A wall -gap 0.0999 -law stereomechanical -e 1e-3\n"
                    "step adaptive -tolerance 1e-4\nduration 0.8\n");
    double met = (M_PI - acos(0.999)) / 10.0;
    assert_int_equal(a.results->n_impact, 1);
    assert_true(a.results->impact[0].complete);
    // Each of the ten steps errs by up to 1e-4 of 0.1 m.
    assert_near(analysis_displacement(&a, 0, 0.8), 0.0999 * cos(10.0 * (0.8 - met)), 1e-4);
    analysis_free(&a);
}

// The oscillator swings to 0.1 m; the touch lasts 2 sqrt(2 depth / 0.1) / omega, far less than a
// step.
static void a_touch_within_a_step_is_found_and_one_that_fails_to_reach_is_not(void **state) {
    (void)state;
    for (int i = 0; i < 2; i++) {
        double gap = i == 0 ? 0.1 - 1e-7 : 0.1 + 1e-7;
        struct analysis a = analysis_of(
            OSCILLATOR
            "initial A:1 -displacement -0.1\ncontact A wall -gap %.10g -law linear -k 1\n"
            "step adaptive -tolerance 1e-10\nduration 2\n",
            gap);
        assert_int_equal(a.results->n_impact, i == 0 ? 4 : 0);
        assert_near(a.results->link[0].penetration, 0.1 - gap, 1e-9);
        if (i == 0) {
            const struct impact *p = &a.results->impact[0];
            assert_close(p->t_end - p->t_start, 2.0 * sqrt(2e-7 / 0.1) / OMEGA, 1e-2);
        }
        analysis_free(&a);
    }
}

// Loads, dampers with an exponent, two grounds, a full damping matrix.
static void whatever_a_deck_has_agrees_with_fixed_steps(void **state) {
    (void)state;
    static const char *const step[] = {"fixed 0.05ms", "adaptive -tolerance 1e-9"};
    struct analysis a[2];
    for (int i = 0; i < 2; i++) {
        a[i] = analysis_of(
            "building A -floors 3 -mass 3e5 -stiffness 3.45e8\ndamping A modal 0.05 0.03 0.02\n"
            "building B -floors 2 -mass 2e5 -stiffness 2e8\ndamping B dashpot 1e6 5e5\n"
            "load A:2 constant 1e5\nload B:1 sine -amplitude 4e5 -frequency 3Hz -cycles 5.5\n"
            "link A:3 B:2 -stiffness 1e6 -dashpot 2e5 -exponent 0.5\n"
            "contact wall A:1 -gap 1mm -law hunt-crossley -k 3e9 -e 0.7\n"
            "ground sine -amplitude 0.2g -frequency 2Hz\n"
            "ground sine -amplitude 0.1g -frequency 2Hz -delay 0.13 -buildings B\n"
            "step %s\noutput -interval 0.01\nduration 2\n",
            step[i]);
    }
    assert_int_equal(a[0].results->n_impact, a[1].results->n_impact);
    assert_true(a[0].results->n_impact > 3);
    for (int k = 0; k < 5; k++) {
        double size = a[0].results->peak[PEAK_DISPLACEMENT][k];
        assert_close(a[1].results->peak[PEAK_DISPLACEMENT][k], size, 1e-5);
        for (int q = 0; q < 20; q++) {
            double t = 0.1 * (q + 1);
            assert_near(analysis_displacement(&a[1], k, t), analysis_displacement(&a[0], k, t),
                        1e-5 * size);
        }
    }
    for (int i = 0; i < ENERGY_RESIDUAL; i++) {
        assert_near(a[1].results->energy[i], a[0].results->energy[i],
                    1e-5 * a[0].results->energy[ENERGY_INPUT]);
    }
    assert_true(a[1].results->residual_peak < 1e-6 * a[1].results->energy[ENERGY_INPUT]);
    analysis_free(&a[0]);
    analysis_free(&a[1]);
}

// A damper that moves by 1e-9 m/s at first, and whose ends hardly part: the slope of its force had
// no bound, and the first 20,000 steps came to 0.015 s only.
static void a_damper_that_holds_its_ends_together_does_not_stop_the_steps(void **state) {
    (void)state;
    // Steps of 0.05 ms err by 3e-7 of the drifts.
    static const char *const step[] = {"fixed 0.05ms",
                                       "adaptive -tolerance 1e-8\nintegrator dormand-prince"};
    struct analysis a[2];
    for (int i = 0; i < 2; i++) {
        a[i] = analysis_of("building A -floors 4 -mass 1e5 -stiffness 9e7\n"
                           "building B -floors 6 -mass 8e4 -stiffness 6e7\n"
                           "damping A rayleigh 0.05\ndamping B rayleigh 0.03 0.07\n"
                           "link A:4 B:4 -dashpot 2e6 -exponent 0.5 -name damper\n"
                           "ground record input/records/ELCENTRO_1940_NS.AT2 -pga 0.6g\n"
                           "step %s\nduration 4\n",
                           step[i]);
    }
    for (int k = 0; k < 10; k++) {
        assert_close(a[1].results->peak[PEAK_DRIFT][k], a[0].results->peak[PEAK_DRIFT][k], 1e-6);
    }
    assert_close(a[1].results->link[0].force, a[0].results->link[0].force, 1e-6);
    assert_close(a[1].results->link[0].dissipated, a[0].results->link[0].dissipated, 1e-6);
    assert_true(a[1].results->residual_peak < 1e-6 * a[1].results->energy[ENERGY_INPUT]);
    analysis_free(&a[0]);
    analysis_free(&a[1]);
}

static void fails_with(const char *text, const char *message) {
    struct error e = {0};
    struct analysis a = analysis_try(text, &e);
    assert_int_equal(e.status, STATUS_FAILED);
    if (!strstr(e.message, message)) {
        print_error("%s\n", e.message);
    }
    assert_non_null(strstr(e.message, message));
    analysis_free(&a);
}

static void what_takes_too_many_steps_ends_with_advice(void **state) {
    (void)state;
    fails_with(OSCILLATOR "initial A:1 -displacement 0.1\n"
                          "step adaptive -tolerance 1e-10 -min 0.05\nduration 2\n",
               "is still too long for the tolerance; use a larger -tolerance, a smaller -min");
    fails_with("building A -floors 1 -mass 1 -stiffness 100\n"
               "building B -floors 1 -mass 1 -stiffness 100\ninitial B:1 -velocity 1\n"
               "link A B -dashpot 1000 -exponent 0.1 -name brake\n"
               "integrator dormand-prince\nstep adaptive -tolerance 1e-9\nduration 20\n",
               "because of brake, which makes more than 2e+06 of them; use a larger -tolerance, "
               "integrator newmark or step fixed DT");
    // Between its branches at v = 0 this law holds any force: the bodies stick.
    fails_with("building A -floors 1 -mass 1 -stiffness 100\nload A:1 constant 100\n"
               "contact A wall -name stop -gap 0 -law khatami -k 1e5 -zeta 9\n"
               "step adaptive\nduration 20\n",
               "the bodies of contact stop stick together, where khatami jumps at v = 0, which "
               "dormand-prince does not follow; use integrator newmark or step fixed DT");
    fails_with("building A -floors 1 -mass 2 -stiffness 0\nload A:1 constant 20\n"
               "contact A wall -name stop -gap 0.05 -law stereomechanical -e 0.65\n"
               "step adaptive\nduration 1\n",
               "contact stop comes to rest, which dormand-prince does not follow; use integrator "
               "newmark or step fixed DT");
}

static void every_random_deck_ends_with_a_closed_account_or_advice(void **state) {
    (void)state;
    int given_up = 0;
    for (uint64_t seed = 1; seed <= 60; seed++) {
        char text[4096];
        struct error e = {0};
        random_deck_stepped(seed, "step adaptive", text, sizeof text);
        struct analysis a = analysis_try(text, &e);
        if (e.status == STATUS_OK) {
            assert_true(a.results->residual_peak < 1e-4 * analysis_flow(&a));
        } else {
            assert_non_null(strstr(e.message, "step fixed DT"));
            given_up++;
        }
        analysis_free(&a);
    }
    assert_true(given_up <= 10);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_free_vibration_follows_the_cosine_and_its_peaks_are_exact),
        cmocka_unit_test(peaks_of_accelerations_are_those_of_forces),
        cmocka_unit_test(peaks_of_accelerations_between_steps_are_exact),
        cmocka_unit_test(a_load_that_ends_at_once_leaves_a_constant_velocity),
        cmocka_unit_test(error_and_energy_residual_go_with_the_tolerance),
        cmocka_unit_test(two_buildings_are_followed_to_less_than_a_micrometre),
        cmocka_unit_test(a_motion_dies_away_however_long_steps_may_be),
        cmocka_unit_test(impacts_against_a_wall_have_their_closed_forms),
        cmocka_unit_test(rigid_bodies_bounce_by_newton_s_law),
        cmocka_unit_test(rigid_bodies_that_part_where_they_come_to_rest_are_apart),
        cmocka_unit_test(a_touch_within_a_step_is_found_and_one_that_fails_to_reach_is_not),
        cmocka_unit_test(whatever_a_deck_has_agrees_with_fixed_steps),
        cmocka_unit_test(a_damper_that_holds_its_ends_together_does_not_stop_the_steps),
        cmocka_unit_test(what_takes_too_many_steps_ends_with_advice),
        cmocka_unit_test(every_random_deck_ends_with_a_closed_account_or_advice),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
