// SPDX-License-Identifier: GPL-3.0-or-later
// Instants at which the method of Dormand & Prince has to tell one side from the other: touches of
// bodies at rest, events by rounding, and jumps of the forcing.
#include <math.h>

#include "support/analysis.h"
#include "support/support.h"

// A is pushed into B, which stands still until then, and both move by rounding before. The contacts
// of gap 0 counted up to 36 touches of 1e-30 N, or rattled at one instant for ever.
static void bodies_at_rest_that_touch_do_not_hit(void **state) {
    (void)state;
    for (int i = 4; i <= 10; i += 2) {
        struct analysis a = analysis_of("building A -floors 2 -mass 2e5 -stiffness 2.7e8\n"
                                        "building B -floors 4 -mass 2e5 -stiffness 1.8e8\n"
                                        "contact A B -gap 0 -law rubber -k 2e9 -n 2 -e 0.8\n"
                                        "ground sine -amplitude 3 -frequency 2 -buildings A "
                                        "-delay 0.02\n"
                                        "ground sine -amplitude 3 -frequency 2 -buildings B "
                                        "-delay 0.19\nduration 0.5\n"
                                        "step adaptive -tolerance %g\n",
                                        pow(10.0, -i));
        assert_int_equal(a.results->link[0].impacts, 1);
        assert_int_equal(a.results->link[1].impacts, 1);
        analysis_free(&a);
    }
}

// The force of komodromos has no jump at v = 0, but its dashpot has one in forces of 1e-300 where
// d = 0: bodies that turned there were said to stick.
static void bodies_that_turn_where_they_touch_do_not_stick(void **state) {
    (void)state;
    struct analysis a = analysis_of(
        "building A -floors 4 -mass 164856 94952 407862 95433 -stiffness 110649859 150726280 "
        "102450219 142363455\n"
        "building B -floors 4 -mass 210954 289389 181117 22766 -stiffness 320856251 380131877 "
        "441145006 445198773\n"
        "damping A rayleigh 5%%\ndamping B modal 0.05\n"
        "contact A B -gap 0 -law komodromos -k 4e8 -e 0.543\n"
        "ground sine -amplitude 4.98 -frequency 3.4 -phase 1.5707963 -buildings B\n"
        "initial A:4 -velocity 0.915\nduration 0.1\nstep adaptive -tolerance 1e-10\n");
    assert_true(a.results->totals.events > 0);
    analysis_free(&a);
}

// A load of 1000 N on 10 kg ends at 0.5 s, in a row: that shows what is from then on, whatever the
// method.
static void a_row_at_a_jump_shows_what_is_after_it(void **state) {
    (void)state;
    static const char *const method[] = {"newmark", "dormand-prince"};
    for (int i = 0; i < 2; i++) {
        struct analysis a =
            analysis_of("building A -floors 1 -mass 10 -stiffness 0\n"
                        "load A:1 sine -amplitude 1000 -frequency 2 -phase 1.5707963267948966 "
                        "-cycles 1\nduration 1\noutput -interval 0.25\n"
                        "integrator %s\nstep adaptive -tolerance 1e-6\n",
                        method[i]);
        assert_near(a.rows.time[2], 0.5, 1e-15);
        assert_close(a.rows.acceleration[0], 100.0, 1e-12);
        assert_close(a.rows.acceleration[1], -100.0, 1e-12);
        assert_near(a.rows.acceleration[2], 0.0, 0.0);
        assert_close(a.results->peak[PEAK_ACCELERATION][0], 100.0, 1e-12);
        analysis_free(&a);
    }
}

// The load ends at 2.7 / 9 = 0.30000000000000004, and the row is at 0.3.
static void a_row_at_a_jump_but_for_rounding_shows_what_is_after_it(void **state) {
    (void)state;
    static const char *const method[] = {"newmark", "dormand-prince"};
    for (int i = 0; i < 2; i++) {
        struct analysis a =
            analysis_of("building A -floors 1 -mass 10 -stiffness 0\n"
                        "load A:1 sine -amplitude 1000 -frequency 9 -phase 1.5707963267948966 "
                        "-cycles 2.7\nduration 0.6\noutput -interval 0.3\n"
                        "integrator %s\nstep adaptive -tolerance 1e-6\n",
                        method[i]);
        assert_near(a.rows.time[1], 0.3, 0.0);
        assert_near(a.rows.acceleration[1], 0.0, 0.0);
        analysis_free(&a);
    }
}

// A mass under a constant force meets a stop with 1 m/s, and another one 1e-12 s later. Its
// velocity turns between them. In so short a step displacements are rounded by more than they
// change, so that velocities on the path between them are wrong: by 1e-8 here.
static void a_step_between_events_at_one_instant_has_no_peaks_by_rounding(void **state) {
    (void)state;
    struct analysis a =
        analysis_of("building A -floors 1 -mass 1 -stiffness 0\nload A:1 constant 1\n"
                    "contact A:1 wall -gap 0.5 -law linear -k 1e10 -name one\n"
                    "contact A:1 wall -gap ${0.5 + 1e-12} -law linear -k 1e9 -name two\n"
                    "integrator dormand-prince\nstep adaptive -tolerance 1e-9\nduration 1.5\n");
    // Energy: until the first stop pushes with 1 N, the velocity grows by 5e-11 of itself.
    assert_close(a.results->peak[PEAK_VELOCITY][0], 1.0, 1e-10);
    // Then v^2 = K x^2 - 2 x with both stops, but for the 1e-12 m between them.
    const double k = 1.1e10, depth = (1.0 + sqrt(1.0 + k)) / k;
    assert_close(a.results->peak[PEAK_DISPLACEMENT][0], 0.5 + depth, 1e-12);
    assert_close(a.results->peak[PEAK_ACCELERATION][0], k * depth - 1.0, 1e-6);
    analysis_free(&a);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(bodies_at_rest_that_touch_do_not_hit),
        cmocka_unit_test(bodies_that_turn_where_they_touch_do_not_stick),
        cmocka_unit_test(a_row_at_a_jump_shows_what_is_after_it),
        cmocka_unit_test(a_row_at_a_jump_but_for_rounding_shows_what_is_after_it),
        cmocka_unit_test(a_step_between_events_at_one_instant_has_no_peaks_by_rounding),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
