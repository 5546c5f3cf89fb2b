// SPDX-License-Identifier: GPL-3.0-or-later
// Rigid contacts at rest: steps hold them, with forces that the motion demands and no others.
#include <math.h>

#include "support/analysis.h"
#include "support/support.h"

// A floor comes to rest at a wall under every member of Newmark's family, and its force is smooth.
static void a_body_stays_at_rest_under_every_newmark_method(void **state) {
    (void)state;
    const double beta_gamma[][2] = {
        {0.25, 0.5}, {1.0 / 6.0, 0.5}, {0.0, 0.5}, {0.3025, 0.6}, {0.402, 0.5194}};
    for (size_t q = 0; q < sizeof beta_gamma / sizeof beta_gamma[0]; q++) {
        struct analysis a =
            analysis_of("building A -floors 2 -mass 1 -stiffness 100\ninitial A:2 -velocity 2\n"
                        "load A:2 constant 30\nload A:1 sine -amplitude 5 -frequency 2\n"
                        "damping A rayleigh 5%%\n"
                        "contact A:2 wall -gap 0.1 -law stereomechanical -e 0.4\n"
                        "integrator newmark -beta %.17g -gamma %g\n"
                        "duration 8\nstep fixed 1ms\noutput -every 1\n",
                        beta_gamma[q][0], beta_gamma[q][1]);
        long last = a.rows.n - 1;
        assert_near(a.rows.displacement[2 * last + 1], 0.1, 1e-8);
        assert_true(a.rows.force[last] > 1.0);
        const double *f = a.rows.force + last;
        assert_near(f[0] - 2.0 * f[-1] + f[-2], 0.0, 2e-3);  // smooth: (4 pi)^2 5 dt^2 = 8e-4
        analysis_free(&a);
    }
}

// Three bodies in touch that begin pressed to a wall by 5 N each, beside one that is pulled away:
// those three never move, and the wall bears them from the first row on. They were shown, and
// taken for peaks, as if they were free at t = 0.
static void bodies_pressed_together_at_the_start_rest_from_the_first_row_on(void **state) {
    (void)state;
    const char *const method[] = {"step fixed 1ms\noutput -every 1",
                                  "integrator newmark\nstep adaptive\noutput -interval 1ms"};
    for (size_t q = 0; q < sizeof method / sizeof method[0]; q++) {
        struct analysis a = analysis_of("building A -floors 1 -mass 4 -stiffness 0\n"
                                        "building B -floors 1 -mass 3 -stiffness 0\n"
                                        "building C -floors 1 -mass 1 -stiffness 10\n"
                                        "building D -floors 1 -mass 2 -stiffness 0\n"
                                        "load A:1 constant -2\nload B:1 constant 5\n"
                                        "load C:1 constant 5\nload D:1 constant 5\n"
                                        "contact A B -gap 0 -law stereomechanical -e 0.5\n"
                                        "contact B C -gap 0 -law stereomechanical -e 0.5\n"
                                        "contact C D -gap 0 -law stereomechanical -e 0.5\n"
                                        "contact D wall -gap 0 -law stereomechanical -e 0.5\n"
                                        "duration 0.1\n%s\n",
                                        method[q]);
        assert_int_equal(a.results->n_impact, 3);
        assert_close(a.results->peak[PEAK_ACCELERATION][0], 0.5, 1e-12);
        for (int i = 1; i < 4; i++) {
            // Sweeps end where they change forces by 1e-12 of the largest, 15 N; 10 times that.
            assert_near(a.results->peak[PEAK_ACCELERATION][i], 0.0, 1.5e-10);
            assert_close(a.rows.force[i], 5.0 * i, 1e-12);
            assert_close(a.results->link[i].impulse, 0.1 * 5.0 * i, 3e-11);
        }
        assert_true(analysis_deepest(&a) < 1e-12);
        analysis_free(&a);
    }
}

// A force that lets a body part at the start of a long step, and at its end presses 3 N: the body
// is held. Newmark's formulas with a = -1 at the start and v = 0 at the end give a = (1 - gamma) /
// gamma there; for 2 beta > gamma that leads inside, and d = 0 gives a = (1/2 - beta) / beta.
static void a_body_that_parts_for_less_than_a_step_is_held(void **state) {
    (void)state;
    const double beta_gamma[][2] = {
        {0.25, 0.5}, {1.0 / 6.0, 0.5}, {0.3025, 0.6}, {0.402, 0.5194}, {0.5384, 0.8189}};
    for (size_t q = 0; q < sizeof beta_gamma / sizeof beta_gamma[0]; q++) {
        double beta = beta_gamma[q][0];
        double gamma = beta_gamma[q][1];
        struct analysis a =
            analysis_of("building A -floors 1 -mass 1 -stiffness 0\n"
                        "load A:1 constant -1\nload A:1 sine -amplitude 4 -frequency 5\n"
                        "contact A wall -gap 0 -law stereomechanical -e 0.5\n"
                        "integrator newmark -beta %.17g -gamma %g\n"
                        "duration 1\nstep fixed 50ms\noutput -every 1\n",
                        beta, gamma);
        double acceleration = fmin((1.0 - gamma) / gamma, (0.5 - beta) / beta);
        assert_true(analysis_deepest(&a) < 1e-15);
        assert_close(a.rows.acceleration[1], acceleration, 1e-12);
        assert_close(a.rows.force[1], 3.0 - acceleration, 1e-12);
        assert_true(a.rows.displacement[analysis_row(&a, 0.2)] < -1e-3);  // the load has turned
        analysis_free(&a);
    }
}

// After such a step average acceleration keeps a velocity of zero by accelerations of +-1 for ever,
// which are no motion. In ten steps they are gone; meanwhile the body moves by less than the h^2
// |a| that the method errs by anyway.
static void accelerations_of_a_body_at_rest_do_not_alternate(void **state) {
    (void)state;
    struct analysis a = analysis_of("building A -floors 1 -mass 1 -stiffness 0\n"
                                    "load A:1 constant -1\n"
                                    "load A:1 sine -amplitude 40 -frequency 0.5\n"
                                    "contact A wall -gap 0 -law stereomechanical -e 0.5\n"
                                    "duration 0.5\nstep fixed 50ms\noutput -every 1\n");
    assert_int_equal(a.rows.n, 11);
    assert_near(a.rows.acceleration[10], 0.0, 0.1);
    assert_near(a.rows.force[10], 39.0, 0.1);
    for (int row = 0; row < 11; row++) {
        assert_near(a.rows.displacement[row], 0.0, 0.05 * 0.05);
    }
    analysis_free(&a);
}

// Two free bodies are pressed together by 12 N; their grounds move, which is none of their
// business, but that the contact at rest follows the integral of their accelerations. What it
// strays is given back at the pace of the steps of the deck, also where another contact splits one
// of them 1e-10 s after its start: given back in that time it was a force of 0.2 N for ever after.
static void a_contact_at_rest_takes_no_notice_of_steps_split_by_others(void **state) {
    (void)state;
    struct analysis a = analysis_of(
        "building A -floors 1 -mass 2 -stiffness 0\nbuilding B -floors 1 -mass 3 -stiffness 0\n"
        "building C -floors 1 -mass 1 -stiffness 0\n"
        "load A:1 constant 12\nload B:1 constant -12\ninitial C:1 -velocity 1\n"
        "contact A B -gap 0 -law stereomechanical -e 0.5\n"
        "contact C wall -gap 0.1000000001 -law mahmoud-jankowski -k 1e4 -e 0.5\n"
        "ground sine -amplitude 3 -frequency 2 -buildings A C\n"
        "ground sine -amplitude 3 -frequency 2 -phase 90deg -buildings B\n"
        "duration 0.2\nstep fixed 1ms\noutput -every 1\n");
    int k = a.model->link[0].law->rebound ? 0 : 1;
    assert_int_equal(a.results->n_impact, 2);
    for (long row = 1; row < a.rows.n; row++) {
        // The acceleration of the ground changes by 4 pi 3 h = 0.04 in a step, half of which the
        // trapezoidal rule may miss, a tenth of that in the mean; on m* = 6/5.
        assert_near(a.rows.force[row * a.rows.n_link + k], 12.0, 5e-3);
    }
    analysis_free(&a);
}

// Twice the same three bodies, A and B pressed together, struck by D from the right: 1e-10 s after
// those of the first floors D comes to rest on B on the second floors too, which splits the step.
// What the contacts at rest then give back, penetrations of up to 2e-9 m that the motions of the
// grounds and the location of the impact have left, must not show: no body is ever accelerated
// by more than its load. It was up to 7.4 m/s^2.
static void contacts_at_rest_accelerate_nobody_where_steps_are_split_to_nanoseconds(void **state) {
    (void)state;
    static const double limit[] = {6.0, 4.0, 3.0};
    static const char *const method[] = {"", "-beta 0.16666667 -gamma 0.5",
                                         "-beta 0.3025 -gamma 0.6"};
    for (int i = 0; i < 18; i++) {
        const int place = i / 3;
        const double gap = 0.02 + 0.03 * place;
        struct analysis a = analysis_of(
            "building A -floors 2 -mass 2 -stiffness 0\nbuilding B -floors 2 -mass 3 -stiffness 0\n"
            "building D -floors 2 -mass 1 -stiffness 0\ninitial D -velocity -1\n"
            "load A constant 12\nload B constant -12\nload D constant -3\n"
            "contact A B -gap 0 -law stereomechanical -e 0\n"
            "contact B:1 D:1 -gap %.17g -law stereomechanical -e 0\n"
            "contact B:2 D:2 -gap %.17g -law stereomechanical -e 0\n"
            "ground sine -amplitude 3 -frequency 2 -buildings A\n"
            "ground sine -amplitude 3 -frequency 2 -phase 90deg -buildings B D\n"
            "integrator newmark %s\nduration 0.3\nstep fixed 1ms\noutput -every 1\n",
            gap, gap + 1e-10, method[i % 3]);
        assert_int_equal(a.results->n_impact, 4);
        for (int j = 0; j < 6; j++) {
            // The contacts follow the grounds but for what the trapezoidal rule misses, 5e-3.
            assert_true(a.results->peak[PEAK_ACCELERATION][j] < limit[j / 2] + 5e-3);
        }
        analysis_free(&a);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_body_stays_at_rest_under_every_newmark_method),
        cmocka_unit_test(bodies_pressed_together_at_the_start_rest_from_the_first_row_on),
        cmocka_unit_test(a_body_that_parts_for_less_than_a_step_is_held),
        cmocka_unit_test(accelerations_of_a_body_at_rest_do_not_alternate),
        cmocka_unit_test(a_contact_at_rest_takes_no_notice_of_steps_split_by_others),
        cmocka_unit_test(contacts_at_rest_accelerate_nobody_where_steps_are_split_to_nanoseconds),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
