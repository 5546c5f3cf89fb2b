// SPDX-License-Identifier: GPL-3.0-or-later
// Newmark's method with adaptive steps: its errors go with the tolerance, it agrees with the method
// of Dormand & Prince, closures are located, limits of the step are kept, the account of energy
// closes to rounding, and what that method refuses is done.
#include <gsl/gsl_math.h>
#include <math.h>
#include <string.h>

#include "support/analysis.h"
#include "support/random_deck.h"
#include "support/support.h"

// 2 Hz: omega = 4 pi.
#define OSCILLATOR "building A -floors 1 -mass 1000 -stiffness 157913.67041742973\n"
static const double OMEGA = 4.0 * M_PI;

#define POUNDING                                                                                   \
    "building A -floors 2 -mass 3e5 -stiffness 3.45e8\ndamping A rayleigh 0.05 -modes 1 2\n"       \
    "building B -floors 1 -mass 2e5 -stiffness 4e8\ndamping B modal 0.03\n"                        \
    "initial A:2 -velocity 2\ncontact A:1 B:1 -gap 5mm -law %s\n"                                  \
    "ground sine -amplitude 0.3g -frequency 2.5Hz -cycles 4\nduration 2\n"

static double largest_difference(const struct analysis *a, const struct analysis *b) {
    double largest = 0.0;
    assert_int_equal(a->rows.n, b->rows.n);
    for (long i = 0; i < a->rows.n * a->model->n_dof; i++) {
        largest = fmax(largest, fabs(a->rows.displacement[i] - b->rows.displacement[i]));
    }
    return largest;
}

// The period is wrong by (omega h)^2 / 12, and the step goes with the cube root of the tolerance.
static void a_free_vibration_is_right_to_the_tolerance_to_the_two_thirds(void **state) {
    (void)state;
    double error[3];
    for (int i = 0; i < 3; i++) {
        struct analysis a = analysis_of(OSCILLATOR "initial A:1 -displacement 0.1\n"
                                                   "integrator newmark\n"
                                                   "step adaptive -tolerance %g\nduration 3\n",
                                        pow(10.0, -5.0 - 1.5 * i));
        error[i] = 0.0;
        for (long k = 0; k < a.rows.n; k++) {
            double want = 0.1 * cos(OMEGA * a.rows.time[k]);
            error[i] = fmax(error[i], fabs(a.rows.displacement[k] - want));
        }
        analysis_free(&a);
    }
    assert_close(log10(error[0] / error[1]), 1.0, 0.1);  // the steps are parts of rows
    assert_close(log10(error[1] / error[2]), 1.0, 0.1);
}

static void it_converges_to_what_dormand_prince_gives(void **state) {
    (void)state;
    static const char *const law[] = {
        "jankowski -k 2.75e9 -e 0.65",
        "kelvin-voigt -k 3e8 -e 0.6",
        "hertz -k 2e9",
        "hunt-crossley -k 3e9 -e 0.7",
        "komodromos -k 3e8 -e 0.6",
        "mahmoud-jankowski -k 3e8 -e 0.6",
        "wang -k 3e8 -e 0.6 -residual 0.1",
    };
    for (size_t k = 0; k < sizeof law / sizeof law[0]; k++) {
        struct analysis exact = analysis_of(POUNDING "step adaptive -tolerance 1e-11\n", law[k]);
        double error[2];
        for (int i = 0; i < 2; i++) {
            double tolerance = i == 0 ? 1e-5 : 1e-8;
            struct analysis a = analysis_of(
                POUNDING "integrator newmark\nstep adaptive -tolerance %g\n", law[k], tolerance);
            const struct results *r = a.results;
            error[i] = largest_difference(&a, &exact);
            assert_int_equal(r->n_impact, exact.results->n_impact);
            assert_int_equal(r->totals.unsolved, 0);
            assert_true(r->residual_peak < 1e-11 * r->energy[ENERGY_INPUT]);
            for (long n = 0; n < r->n_impact; n++) {
                assert_near(r->impact[n].t_start, exact.results->impact[n].t_start,
                            20.0 * pow(tolerance, 2.0 / 3.0));
            }
            analysis_free(&a);
        }
        assert_true(error[0] < 3e-4);  // displacements are about 0.1 m
        assert_true(error[1] < error[0] / 30.0);
        analysis_free(&exact);
    }
}

// A sine that begins and ends with its full amplitude, under buildings at rest. Newmark's method
// goes on from the accelerations at the start of a step, which have to be those after the jump:
// steps that begin or end with those before it have an error of the first order, and the error
// control made 38 attempts at them with 1e-6, and had no step short enough for 1e-9.
static void a_jump_of_the_ground_is_no_error_of_the_steps(void **state) {
    (void)state;
    static const char *const ground[] = {"", " -buildings A\nground sine -amplitude 1 -frequency 2 "
                                             "-phase 90deg -delay 0.31 -cycles 1 -buildings B"};
    static const char *const damping[] = {"rayleigh 3%", "modal 3%"};
    for (int i = 0; i < 4; i++) {
        static const char *const deck =
            "building A -floors 2 -mass 3e5 -stiffness 3.45e8\ndamping A %s\n"
            "building B -floors 1 -mass 2e5 -stiffness 4e8\n"
            "contact A:1 B:1 -gap 2mm -law hertz -k 2e9\nload A:2 sine -amplitude 1e3 -frequency 3 "
            "-cycles 2.25\nground sine -amplitude 2 -frequency 1.6 -phase 90deg -cycles 1.3 "
            "-delay 0.2367%s\nduration 1.5\nstep adaptive -tolerance %g\n%s";
        struct analysis exact = analysis_of(deck, damping[i / 2], ground[i % 2], 1e-11, "");
        struct analysis a =
            analysis_of(deck, damping[i / 2], ground[i % 2], 1e-9, "integrator newmark\n");
        assert_true(largest_difference(&a, &exact) < 1e-7);  // of 10 mm; some 1e-5 of it, as above
        assert_true(a.results->residual_peak < 1e-11 * a.results->energy[ENERGY_INPUT]);
        assert_in_range(a.results->totals.rejected, 0, 30);
        for (int j = 0; j < a.model->n_dof; j++) {
            assert_close(a.results->peak[PEAK_ACCELERATION][j],
                         exact.results->peak[PEAK_ACCELERATION][j], 1e-4);
        }
        analysis_free(&a);
        analysis_free(&exact);
    }
}

// Delays and samples in seconds add up to rows but for rounding, in milliseconds exactly. A step
// from the one to the other is the first of twenty, each at most four times longer than the last.
static void a_row_beside_a_corner_costs_no_steps(void **state) {
    (void)state;
    static const char *const units[] = {"N m s", "kN m ms"};
    long steps[2];
    for (int i = 0; i < 2; i++) {
        struct analysis a = analysis_of("units %s\nbuilding A -floors 1 -mass 1000kg "
                                        "-stiffness 157913N/m\nintegrator newmark\n"
                                        "ground record input/records/ELCENTRO_1940_NS.AT2 "
                                        "-delay 0.2s\nstep adaptive\nduration 5s\n",
                                        units[i]);
        steps[i] = a.results->totals.steps;
        analysis_free(&a);
    }
    assert_close((double)steps[0], (double)steps[1], 0.01);  // steps may go on a little differently
}

// A force presses two bodies together, and ends at 2 s while they rest.
static void bodies_at_rest_that_a_jump_parts_have_ended_their_impact(void **state) {
    (void)state;
    struct analysis a =
        analysis_of("building A -floors 1 -mass 1e5 -stiffness 4e6\ndamping A modal 0.3\n"
                    "building B -floors 1 -mass 1e5 -stiffness 1e6\n"
                    "contact A:1 B:1 -gap 0 -law stereomechanical -e 0\n"
                    "load A:1 sine -amplitude 100kN -frequency 0.001 -phase 90deg -cycles 0.002\n"
                    "duration 3.5\nintegrator newmark\nstep adaptive -tolerance 1e-6\n");
    const struct impact *impact = a.results->impact;
    assert_int_equal(a.results->n_impact, 2);
    assert_true(impact[0].complete && impact[1].complete);
    assert_close(impact[0].t_end, 2.0, 1e-12);
    // That of steps of 0.1 ms; both are of the second order.
    assert_close(impact[1].t_start, 2.58141, 1e-5);
    analysis_free(&a);
}

static void every_storey_law_agrees_with_dormand_prince(void **state) {
    (void)state;
    // An error of 1e-9 a step, of second order, is some 1e-5 at the end; see the orders above.
    analysis_storey_laws_agree("step adaptive -tolerance 1e-8",
                               "integrator newmark\nstep adaptive -tolerance 1e-9", 1e-5);
}

static void the_longest_step_is_kept_and_the_shortest_ends_the_run(void **state) {
    (void)state;
    struct analysis a = analysis_of(OSCILLATOR "initial A:1 -displacement 0.1\nintegrator newmark\n"
                                               "step adaptive -tolerance 1e-2 -max 1ms\n"
                                               "duration 1\n");
    assert_true(a.results->totals.steps >= 1000);
    analysis_free(&a);
    struct error e = {0};
    a = analysis_try(OSCILLATOR "initial A:1 -displacement 0.1\nintegrator newmark\n"
                                "step adaptive -tolerance 1e-10 -min 1ms\nduration 1\n",
                     &e);
    assert_non_null(strstr(e.message, "a step of 0.001 s is still too long for the tolerance; "
                                      "use a larger -tolerance, a smaller -min or step fixed DT"));
    analysis_free(&a);
}

// Of ways a little longer than the longest step, the equal parts are shorter, not longer: 10 rows
// of 10.9 ms, and one way of 10.9 ms.
static void equal_parts_are_no_longer_than_the_longest_step(void **state) {
    (void)state;
    struct analysis a = analysis_of(OSCILLATOR "initial A:1 -displacement 0.1\nintegrator newmark\n"
                                               "step adaptive -tolerance 1e-2 -max 10ms\n"
                                               "output -interval 10.9ms\nduration 0.109\n");
    assert_true(a.results->totals.steps >= 20);
    analysis_free(&a);
    a = analysis_of(OSCILLATOR "initial A:1 -displacement 0.1\n"
                               "step adaptive -tolerance 1e-2 -max 10ms\nduration 10.9ms\n");
    assert_true(a.results->totals.steps >= 2);
    analysis_free(&a);
}

// Central differences are stable up to omega h = 2, and the error control alone would go beyond it
// once the fast mode has died out.
static void an_explicit_method_stays_below_its_limit(void **state) {
    (void)state;
    struct analysis a = analysis_of("building A -floors 2 -mass 1 1 -stiffness 10 1e4\n"
                                    "damping A rayleigh 2%%\n"
                                    "load A:2 sine -amplitude 1 -frequency 0.1Hz\n"
                                    "integrator newmark -beta 0\n"
                                    "step adaptive -tolerance 1e-2\nduration 100\n");
    assert_true(a.results->peak[PEAK_DISPLACEMENT][1] < 1.0);
    analysis_free(&a);
}

// The body is pressed against the wall by 20 N: it bounces, and rests there.
static void rigid_bodies_come_to_rest(void **state) {
    (void)state;
    struct analysis a = analysis_of("building A -floors 1 -mass 2 -stiffness 0\n"
                                    "load A:1 constant 20\n"
                                    "contact A wall -gap 0.05 -law stereomechanical -e 0.65\n"
                                    "integrator newmark\nstep adaptive\nduration 1\n");
    const struct results *r = a.results;
    assert_near(r->impact[0].t_start, 0.1, 1e-8);
    assert_close(r->impact[0].v_rebound, 0.65, 1e-8);
    assert_near(analysis_displacement(&a, 0, 1.0), 0.05, 1e-9);
    assert_close(r->link[0].dissipated, 20.0 * 0.05, 1e-9);  // all that the load has done
    assert_false(r->impact[r->n_impact - 1].complete);
    analysis_free(&a);
}

// Bodies that stick between the branches of a law that jumps at v = 0 are under a constraint, on
// which accelerations of the trapezoidal rule go to and fro from step to step: two of the decks.
static void every_random_deck_ends_with_a_closed_account_or_advice(void **state) {
    (void)state;
    int given_up = 0;
    for (uint64_t seed = 1; seed <= 60; seed++) {
        char text[4096];
        struct error e = {0};
        random_deck_stepped(seed, "integrator newmark\nstep adaptive", text, sizeof text);
        struct analysis a = analysis_try(text, &e);
        if (e.status == STATUS_OK) {
            assert_true(a.results->residual_peak < 1e-9 * analysis_flow(&a));
        } else {
            assert_non_null(strstr(e.message, "-gamma above 0.5"));
            assert_non_null(strstr(e.message, "step fixed DT"));
            given_up++;
        }
        analysis_free(&a);
    }
    assert_true(given_up <= 2);
}

// In the first 20 us of the motion, of 1e-13 m, floors that touch come apart by rounding, which was
// up to 16 impacts of 1e-18 N. When A hits B later, which touches C, both closed and opened 25
// times at that instant.
static void bodies_that_touch_do_not_hit_before_they_are_pushed(void **state) {
    (void)state;
    static const char *const step[] = {"fixed 0.1ms", "adaptive -tolerance 1e-4",
                                       "adaptive -tolerance 1e-6", "adaptive -tolerance 1e-8"};
    static const char *const damping[] = {"", "damping A rayleigh 5%\ndamping B rayleigh 5%\n"
                                              "damping C rayleigh 5%\n"};
    for (int i = 0; i < 8; i++) {
        struct analysis a = analysis_of("building A -floors 2 -mass 1.37e5 -stiffness 1.813e8\n"
                                        "building B -floors 3 -mass 2e5 -stiffness 2.7e8\n"
                                        "building C -floors 3 -mass 2e5 -stiffness 2.7e8\n%s"
                                        "contact A B -gap 0 -law kelvin-voigt -k 2e8 -e 0.6\n"
                                        "contact B C -gap 0 -law kelvin-voigt -k 2e8 -e 0.6\n"
                                        "ground sine -amplitude 3 -frequency 2 -delay 0.1\n"
                                        "duration 0.6\nintegrator newmark\nstep %s\n",
                                        damping[i / 4], step[i % 4]);
        assert_int_equal(a.results->n_impact, i < 4 ? 6 : 5);
        for (long j = 0; j < a.results->n_impact; j++) {
            assert_true(a.results->impact[j].peak_force > 1.0);
        }
        analysis_free(&a);
    }
}

// A damper that is nearly dry friction: Dormand & Prince's method would take more steps than are
// allowed, so the method that gets through is the default. The deck's word is kept.
static void the_default_for_dampers_near_friction_is_newmark(void **state) {
    (void)state;
    static const struct {
        const char *statement;
        double exponent;
        enum integrator want;
    } cases[] = {{"", 0.2, INTEGRATOR_NEWMARK},
                 {"", 0.49, INTEGRATOR_NEWMARK},
                 {"", 0.5, INTEGRATOR_DORMAND_PRINCE},
                 {"integrator dormand-prince\n", 0.2, INTEGRATOR_DORMAND_PRINCE}};
    for (int i = 0; i < 4; i++) {
        struct model *m = analysis_model("building A -floors 1 -mass 3e5 -stiffness 3e8\n"
                                         "building B -floors 1 -mass 2e5 -stiffness 4e8\n"
                                         "link A B -dashpot 1e6 -exponent %g\n%sstep adaptive\n"
                                         "duration 1\n",
                                         cases[i].exponent, cases[i].statement);
        assert_int_equal(m->integrator, cases[i].want);
        model_free(m);
    }
    struct analysis a = analysis_of("building A -floors 3 -mass 3e5 -stiffness 3e8\n"
                                    "building B -floors 2 -mass 2e5 -stiffness 4e8\n"
                                    "link A:2 B:2 -dashpot 1e6 -exponent 0.2\n"
                                    "ground record input/records/ELCENTRO_1940_NS.AT2\n"
                                    "step adaptive\nduration 5\n");
    assert_true(a.results->residual_peak < 1e-9 * a.results->energy[ENERGY_INPUT]);
    assert_true(a.results->link[0].dissipated > 0.0);
    analysis_free(&a);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_free_vibration_is_right_to_the_tolerance_to_the_two_thirds),
        cmocka_unit_test(it_converges_to_what_dormand_prince_gives),
        cmocka_unit_test(the_default_for_dampers_near_friction_is_newmark),
        cmocka_unit_test(a_jump_of_the_ground_is_no_error_of_the_steps),
        cmocka_unit_test(a_row_beside_a_corner_costs_no_steps),
        cmocka_unit_test(bodies_at_rest_that_a_jump_parts_have_ended_their_impact),
        cmocka_unit_test(every_storey_law_agrees_with_dormand_prince),
        cmocka_unit_test(the_longest_step_is_kept_and_the_shortest_ends_the_run),
        cmocka_unit_test(equal_parts_are_no_longer_than_the_longest_step),
        cmocka_unit_test(an_explicit_method_stays_below_its_limit),
        cmocka_unit_test(rigid_bodies_come_to_rest),
        cmocka_unit_test(bodies_that_touch_do_not_hit_before_they_are_pushed),
        cmocka_unit_test(every_random_deck_ends_with_a_closed_account_or_advice),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
