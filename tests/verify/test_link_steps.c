// SPDX-License-Identifier: GPL-3.0-or-later
// Steps of models whose links have laws: rejected steps, events, and what limits adaptive steps.
#include <math.h>

#include "support/analysis.h"
#include "support/support.h"

// Fixed steps, and both methods of adaptive steps.
static const char *const step[] = {"step fixed 0.5ms\n",
                                   "integrator newmark\nstep adaptive -tolerance 1e-8\n",
                                   "integrator dormand-prince\nstep adaptive -tolerance 1e-9\n"};
enum { N_STEP = 3 };

// A brace that loses strength until it has none, so that its tangent is negative, with long steps.
static void a_link_that_softens_is_followed(void **state) {
    (void)state;
    double peak[N_STEP];
    for (int s = 0; s < N_STEP; s++) {
        struct analysis a = analysis_of(
            "units N m s\nbuilding A -floors 1 -mass 50t -stiffness 4MN/m\ndamping A dashpot 50e3\n"
            "link A:0 A:1 -law imk -stiffness 10MN/m -yield 80kN -hardening 0.05 -capping 18mm "
            "-post-capping -0.15\nground sine -amplitude 0.6g -frequency 1.4 -cycles 5\n"
            "duration 5\noutput -interval 10ms\n%s",
            s == 0 ? "step fixed 1ms" : step[s]);
        peak[s] = a.results->peak[PEAK_DISPLACEMENT][0];
        assert_true(a.results->link[0].residual > 1e-3);
        analysis_free(&a);
    }
    assert_close(peak[0], peak[2], 1e-4);
    assert_close(peak[1], peak[2], 1e-5);
}

// A brace that loses strength under a slow load. Steps of 20 ms, in which its tangent takes more
// than half of the effective stiffness, are rejected.
static void a_step_that_is_too_long_for_a_link_that_softens_is_rejected(void **state) {
    (void)state;
    double drift[2];
    for (int i = 0; i < 2; i++) {
        struct analysis a = analysis_of(
            "units N m s\nbuilding A -floors 1 -mass 500 -stiffness 9MN/m\n"
            "damping A dashpot 9e3\nlink A:0 A:1 -law imk -stiffness 10MN/m -yield 60kN "
            "-hardening 0.05 -capping 8mm -post-capping -0.8\n"
            "load A:1 sine -amplitude 140kN -frequency 0.25\nduration 1.5\nstep fixed %s",
            i == 0 ? "20ms" : "1ms");
        assert_true((a.results->totals.rejected > 0) == (i == 0));
        assert_true(a.results->totals.unsolved == 0 && a.results->link[0].lost > 0.0);
        drift[i] = a.results->peak[PEAK_DRIFT][0];
        analysis_free(&a);
    }
    assert_close(drift[0], drift[1], 1e-2);
    assert_true(drift[1] > 9e-3);
}

// Dampers with springs beside hooks and contacts, whose events interrupt the steps.
static void links_of_several_laws_act_together(void **state) {
    (void)state;
    double peak[N_STEP], work[N_STEP], residual[N_STEP];
    for (int s = 0; s < N_STEP; s++) {
        struct analysis a = analysis_of(
            "units N m s\nbuilding A -floors 2 -mass 60t -stiffness 30MN/m\n"
            "building B -floors 2 -mass 90t -stiffness 80MN/m\n"
            "damping A rayleigh 2%%\ndamping B rayleigh 2%%\n"
            "link A:0 A:1 -law maxwell -stiffness 30MN/m -dashpot 200kN*s^0.7/m^0.7 -exponent 0.7\n"
            "link A:2 B:2 -law hook -stiffness 60MN/m -slack 4mm\n"
            "link A:1 B:1 -law gap -stiffness 60MN/m -slack 4mm -yield 80kN -hardening 0.05\n"
            "contact A:2 B:2 -gap 12mm -law linear -k 300MN/m\n"
            "ground sine -amplitude 0.5g -frequency 1.7 -cycles 4\nduration 4\n%s",
            s == 0 ? "step fixed 0.2ms\noutput -interval 10ms" : step[s]);
        peak[s] = a.results->peak[PEAK_DISPLACEMENT][1];
        work[s] = a.results->link[1].dissipated;
        residual[s] = a.results->link[1].residual;
        assert_true(a.results->link[0].impacts > 0 && a.results->link[2].force > 0.0);
        assert_true(a.results->link[3].residual > 1e-4);
        analysis_free(&a);
    }
    for (int s = 0; s < 2; s++) {
        assert_close(peak[s], peak[2], 1e-4);
        assert_close(work[s], work[2], 1e-4);
        assert_close(residual[s], residual[2], 1e-3);
    }
}

// A spring that relaxes 15 000 times a second limits the steps of the explicit method.
static void steps_are_short_enough_for_a_spring_that_relaxes(void **state) {
    (void)state;
    struct analysis a = analysis_of(
        "units N m s\nbuilding A -floors 1 -mass 2 -stiffness 900\nduration 0.5\n"
        "link A:0 A:1 -law maxwell -stiffness 3e5 -dashpot 20\ninitial A:1 -velocity 1\n"
        "integrator dormand-prince\nstep adaptive");
    assert_true(a.results->totals.rejected < a.results->totals.steps / 50);
    assert_true(a.results->totals.steps < 20000);
    analysis_free(&a);
}

// Dormand & Prince's steps end where the force of the link is 0 to the last bit, and there this law
// would go on along the path of the other side.
static void a_loose_link_has_not_crossed_the_axis(void **state) {
    (void)state;
    double work[N_STEP];
    for (int s = 0; s < N_STEP; s++) {
        struct analysis a = analysis_of(
            "units N m s\nbuilding A -floors 4 -mass 62.491t -stiffness 127.844MN/m\n"
            "building B -floors 2 -mass 139.397t -stiffness 230.742MN/m\n"
            "damping A rayleigh 3%%\ndamping B rayleigh 3%%\n"
            "contact A B -gap 15mm -law komodromos -k 300MN/m -zeta 0.1\n"
            "link A:1 B:1 -law trilinear -crack 40kN -cracked 0.5 -yield 339.66kN -hardening 0.03 "
            "-stiffness 54.113MN/m -slack 1.01mm\n"
            "ground record %s -format series -dt 0.02 -unit g -scale 1.678\nduration 5\n%s",
            analysis_el_centro(), s == 0 ? "step fixed 0.2ms\noutput -interval 10ms" : step[s]);
        work[s] = a.results->link[1].dissipated;
        analysis_free(&a);
    }
    assert_close(work[0], work[2], 1e-4);
    assert_close(work[1], work[2], 1e-4);
}

// A heavy body that coasts draws the damper out at a constant rate. Its own motion would allow
// steps in which the force, F = c v (1 - exp(-k t / c)), is wrong.
static void the_state_of_a_damper_has_the_tolerance_of_a_displacement(void **state) {
    (void)state;
    const double k = 1e4, c = 100.0;
    struct analysis a = analysis_of(
        "units N m s\nbuilding A -floors 1 -mass 1e9 -stiffness 0\nduration 0.2\n"
        "link A:0 A:1 -law maxwell -stiffness %g -dashpot %g\ninitial A:1 -velocity 1\n"
        "output -interval 10ms\nintegrator dormand-prince\nstep adaptive -tolerance 1e-8",
        k, c);
    for (long i = 0; i < a.rows.n; i++) {
        assert_near(a.rows.force[i], -c * (1.0 - exp(-k * a.rows.time[i] / c)), 1e-5 * c);
    }
    analysis_free(&a);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_link_that_softens_is_followed),
        cmocka_unit_test(a_step_that_is_too_long_for_a_link_that_softens_is_rejected),
        cmocka_unit_test(links_of_several_laws_act_together),
        cmocka_unit_test(steps_are_short_enough_for_a_spring_that_relaxes),
        cmocka_unit_test(a_loose_link_has_not_crossed_the_axis),
        cmocka_unit_test(the_state_of_a_damper_has_the_tolerance_of_a_displacement),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
