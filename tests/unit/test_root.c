// SPDX-License-Identifier: GPL-3.0-or-later
// The search for a root, on functions that are hard to search.
#include <float.h>
#include <gsl/gsl_errno.h>
#include <gsl/gsl_math.h>
#include <math.h>

#include "core/root.h"
#include "support/support.h"

enum { CALLS_MAX = 120 };

struct counted {
    double (*value)(double x);
    double (*slope)(double x);
    int calls;
};

static double look(double x, void *context, double *slope) {
    struct counted *c = context;
    c->calls++;
    *slope = c->slope(x);
    return c->value(x);
}

static double value_only(double x, void *context) {
    return ((struct counted *)context)->value(x);
}

static double flat(double x) {
    return pow(x - 0.3, 9.0);
}
static double flat_slope(double x) {
    return 9.0 * pow(x - 0.3, 8.0);
}
static double steep(double x) {
    return tanh(1e6 * (x - 0.7));
}
static double steep_slope(double x) {
    return 1e6 * (1.0 - steep(x) * steep(x));
}
static double jump(double x) {
    return x < 0.123 ? -1.0 : 2.0;
}
static double no_slope(double x) {
    (void)x;
    return 0.0;
}
static double falling(double x) {
    return cbrt(0.4 - x);  // its slope is infinite at the root
}
static double falling_slope(double x) {
    return -1.0 / (3.0 * pow(cbrt(0.4 - x), 2.0));
}
static double straight(double x) {
    return 3.0 * (x - 0.25);
}
static double wrong_slope(double x) {
    (void)x;
    return -3.0;
}
static double undefined_slope(double x) {
    (void)x;
    return NAN;
}
static double cycling(double x) {
    return (x - 0.5) / sqrt(fabs(x - 0.5) + DBL_MIN);  // Newton's method alone goes to and fro
}
static double cycling_slope(double x) {
    return 0.5 / sqrt(fabs(x - 0.5) + DBL_MIN);
}

static const struct {
    struct counted f;
    double root, rise, error;
} hard[] = {
    {{flat, flat_slope, 0}, 0.3, 1.0, 1e-5},  // by 8/9 from look to look
    {{steep, steep_slope, 0}, 0.7, 1.0, 1e-11},
    {{jump, no_slope, 0}, 0.123, 1.0, 1e-11},
    {{falling, falling_slope, 0}, 0.4, -1.0, 1e-11},
    {{straight, wrong_slope, 0}, 0.25, 1.0, 1e-11},
    {{straight, undefined_slope, 0}, 0.25, 1.0, 1e-11},
    {{cycling, cycling_slope, 0}, 0.5, 1.0, 1e-11},
};
enum { N_HARD = sizeof hard / sizeof hard[0] };

static void newton_in_a_bracket_finds_every_root(void **state) {
    (void)state;
    for (int i = 0; i < N_HARD; i++) {
        struct counted f = hard[i].f;
        const struct root r = {0.0, 1.0, hard[i].rise};
        double x = root_newton(look, &f, r, root_between(&r, f.value(0.0), f.value(1.0)), 1e-12);
        assert_near(x, hard[i].root, hard[i].error);
        assert_true(f.calls <= CALLS_MAX);
    }
}

static void values_alone_find_every_root(void **state) {
    (void)state;
    for (int i = 0; i < N_HARD; i++) {
        struct counted f = hard[i].f;
        double x = root_find(value_only, &f, 0.0, 1.0, 1e-12);
        assert_near(x, hard[i].root, f.value == flat ? 1e-3 : 1e-11);  // flat: 1e-27 at 1e-3
    }
}

static void signs_alone_find_every_root(void **state) {
    (void)state;
    for (int i = 0; i < N_HARD; i++) {
        struct root r = {.high = 1.0};
        for (int n = 0; n < 60; n++) {
            root_halve(&r, hard[i].rise * hard[i].f.value(root_middle(&r)) < 0.0);
        }
        assert_near(r.low, hard[i].root, 2.0 * DBL_EPSILON);
        assert_true(r.low <= r.high);
    }
}

// A good start and a smooth function: the error is squared from look to look.
static void a_smooth_root_is_found_in_a_few_looks(void **state) {
    (void)state;
    struct counted f = {.value = sin, .slope = cos};
    const struct root r = {2.0, 4.0, -1.0};
    assert_near(root_newton(look, &f, r, 3.0, 1e-9), M_PI, 4.0 * DBL_EPSILON);
    assert_true(f.calls <= 4);
}

static void a_root_at_an_end_is_found_there(void **state) {
    (void)state;
    struct counted f = {.value = straight, .slope = wrong_slope};
    const struct root from = {0.25, 1.0, 1.0}, to = {0.0, 0.25, 1.0};
    assert_true(root_newton(look, &f, from, root_between(&from, 0.0, 2.25), 1e-12) == 0.25);
    assert_true(root_newton(look, &f, to, root_between(&to, -0.75, 0.0), 1e-12) == 0.25);
}

static void a_step_that_leaves_the_bracket_is_a_half(void **state) {
    (void)state;
    struct root r = {0.0, 1.0, 1.0};
    root_narrow(&r, 0.25, 1.0);
    assert_true(r.high == 0.25);
    assert_true(root_step(&r, 0.25, 1.0, 3.0) == 0.125);
    assert_true(root_step(&r, 0.25, 0.3, 3.0) == 0.25 - 0.3 / 3.0);
}

// Ends the other way round, as a drift that decreases has them.
static void halving_goes_either_way(void **state) {
    (void)state;
    struct root r = {.low = 2.0, .high = -1.0};
    for (int i = 0; i < 60; i++) {
        root_halve(&r, root_middle(&r) > 0.1);
    }
    assert_near(r.low, 0.1, 2.0 * DBL_EPSILON);
}

static void values_of_one_sign_have_no_root(void **state) {
    (void)state;
    struct counted f = {.value = cosh, .slope = sinh};
    assert_true(isnan(root_find(value_only, &f, -1.0, 1.0, 1e-12)));
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(newton_in_a_bracket_finds_every_root),
        cmocka_unit_test(values_alone_find_every_root),
        cmocka_unit_test(signs_alone_find_every_root),
        cmocka_unit_test(a_smooth_root_is_found_in_a_few_looks),
        cmocka_unit_test(a_root_at_an_end_is_found_there),
        cmocka_unit_test(a_step_that_leaves_the_bracket_is_a_half),
        cmocka_unit_test(halving_goes_either_way),
        cmocka_unit_test(values_of_one_sign_have_no_root),
    };
    gsl_set_error_handler_off();
    return cmocka_run_group_tests(tests, NULL, NULL);
}
