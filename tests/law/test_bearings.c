// SPDX-License-Identifier: GPL-3.0-or-later
// The law of bearings that slide, whose friction depends on the velocity: loops and cuts by hand.
#include <math.h>

#include "support/storey.h"
#include "support/support.h"

// W = 3e6, R = 2, k0 = 1.85e7, mu 0.03 at rest and 0.05 when fast.
static const double STIFFNESS = 2e7, W = 3e6, R = 2.0, SLOW = 0.03, FAST = 0.05, A = 20.0;

static struct test_storey bearing(void) {
    return test_storey_of("fps", STIFFNESS, "weight 3e6 radius 2 mu 0.05 mu-slow 0.03 rate 20");
}

static struct storey_rate_response at(const struct test_storey *s, double drift, double rate) {
    return s->law->respond_at_rate(s->constant, s->history, drift, rate, NULL);
}

static void the_dashpot_is_the_slope_over_the_rate(void **state) {
    (void)state;
    const double rate[] = {-0.7, -0.05, -0.002, 0.003, 0.04, 0.5}, drift[] = {-0.03, 0.001, 0.04};
    struct test_storey s = bearing();
    for (int k = 0; k < 2; k++) {
        for (int i = 0; i < 3; i++) {
            for (int j = 0; j < 6; j++) {
                const double h = 1e-5 * fabs(rate[j]);
                const double up = at(&s, drift[i], rate[j] + h).shear;
                const double down = at(&s, drift[i], rate[j] - h).shear;
                // Truncation is of the order of (a h)^2; the shear rounds to 1e-16 of itself.
                assert_near(at(&s, drift[i], rate[j]).dashpot, (up - down) / (2 * h), 0.1);
            }
        }
        test_storey_go(&s, 0.02, 1);
    }
}

// At rest the law has the friction of slow sliding, and any rate gives the same shear as long as it
// does not slide.
static void a_storey_at_rest_has_the_slow_friction(void **state) {
    (void)state;
    struct test_storey s = bearing();
    assert_close(test_storey_at(&s, 0.1).shear, W / R * 0.1 + SLOW * W, 1e-14);
    assert_close(at(&s, 0.1, -1e9).shear, W / R * 0.1 + FAST * W, 1e-14);
    assert_close(at(&s, 0.1, 0.05).shear, W / R * 0.1 + (FAST - (FAST - SLOW) * exp(-A * 0.05)) * W,
                 1e-14);
    assert_close(at(&s, 0.004, 3.0).shear, STIFFNESS * 0.004, 1e-14);
    assert_close(at(&s, 0.004, 0.3).tangent, STIFFNESS, 1e-14);
    assert_close(test_storey_at(&s, 0.1).tangent, W / R, 1e-14);
}

// It slides fast to 0.1 and stops there: friction is cut back to that of slow sliding, and the slip
// grows by the difference.
static void friction_is_cut_back_where_the_bound_shrinks(void **state) {
    (void)state;
    struct test_storey s = bearing();
    const double k0 = STIFFNESS - W / R;
    s.law->respond_at_rate(s.constant, s.history, 0.1, 1e9, s.history);
    assert_close(s.history[0], 0.1 - FAST * W / k0, 1e-14);
    assert_close(test_storey_at(&s, 0.1).shear, W / R * 0.1 + SLOW * W, 1e-14);
    s.law->respond_at_rate(s.constant, s.history, 0.1, 0.0, s.history);
    assert_close(s.history[0], 0.1 - SLOW * W / k0, 1e-14);
    // What it stores is the pendulum's lift and the elastic part of friction.
    assert_close(s.law->stored(s.constant, s.history, 0.1),
                 W / R * 0.01 / 2 + SLOW * W * SLOW * W / k0 / 2, 1e-13);
}

// A closed loop between -u and u dissipates 4 mu W (u - u_y), with the yield drift u_y = mu W / k0.
// The mean of the shears is exact but in the steps with a corner, 2 in 4000.
static void a_loop_dissipates_what_friction_does(void **state) {
    (void)state;
    static const char *const surface[] = {"weight 3e6 radius 2 mu 0.05", "weight 3e6 mu 0.05"};
    for (int i = 0; i < 2; i++) {
        struct test_storey s = test_storey_of("fps", STIFFNESS, surface[i]);
        const double k0 = STIFFNESS - (i == 0 ? W / R : 0.0), u = 0.08;
        test_storey_go(&s, u, 1);
        const double work = test_storey_work(&s, -u, 4000) + test_storey_work(&s, u, 4000);
        assert_close(work, 4 * FAST * W * (u - FAST * W / k0), 1e-6);
    }
}

static void values_that_make_no_bearing_are_refused(void **state) {
    (void)state;
    static const char *const text[] = {
        "weight 3e6 radius 2 mu 0.05 mu-slow 0.03", "weight 3e6 radius 2 mu 0.05 rate 20",
        "weight 3e6 radius 2 mu 0.05 mu-slow 0.06 rate 20", "weight 3e6 radius 0.15 mu 0.05"};
    const struct storey_law *law = storey_law_find("fps");
    for (int i = 0; i < 4; i++) {
        double value[STOREY_ROWS_MAX], constant[STOREY_CONSTANTS_MAX];
        struct error e;
        test_storey_values(law, text[i], value);
        assert_int_equal(law->prepare(value, STIFFNESS, constant, &e), STATUS_INPUT);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_dashpot_is_the_slope_over_the_rate),
        cmocka_unit_test(a_storey_at_rest_has_the_slow_friction),
        cmocka_unit_test(friction_is_cut_back_where_the_bound_shrinks),
        cmocka_unit_test(a_loop_dissipates_what_friction_does),
        cmocka_unit_test(values_that_make_no_bearing_are_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
