// SPDX-License-Identifier: GPL-3.0-or-later
// Elementary effects of functions for which they are known, and the design.
#include "study/morris.h"

#include <gsl/gsl_math.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "support/support.h"

enum { PARAMETERS = 3, LEVELS = 4, TRAJECTORIES = 20000, RUNS = PARAMETERS + 1 };
static unsigned char level[TRAJECTORIES * RUNS * PARAMETERS];
static double demand[TRAJECTORIES * RUNS];
static const double STEP = 1.0 / (LEVELS - 1);

typedef double function(const double *u);

static double ishigami(const double *u) {
    double x[PARAMETERS];
    for (int i = 0; i < PARAMETERS; i++) {
        x[i] = M_PI * (2.0 * u[i] - 1.0);
    }
    return sin(x[0]) + 7.0 * pow(sin(x[1]), 2.0) + 0.1 * pow(x[2], 4.0) * sin(x[0]);
}

static double linear(const double *u) {
    return 100.0 + 3.0 * u[0] - 4.0 * u[1];
}

static struct morris_design design_of(size_t n) {
    struct error e;
    const struct morris_design d = {
        .n_parameter = PARAMETERS, .n_level = LEVELS, .n = n, .level = level};
    assert_int_equal(morris_draw(&d, &e), STATUS_OK);
    return d;
}

static void run(const struct morris_design *d, function *f) {
    for (size_t k = 0; k < d->n * RUNS; k++) {
        double u[PARAMETERS];
        for (int i = 0; i < PARAMETERS; i++) {
            u[i] = STEP * d->level[k * PARAMETERS + (size_t)i];
        }
        demand[k] = f(u);
    }
}

static void effects_of(function *f, size_t n, struct morris_effect *effect) {
    size_t n_left_out;
    struct error e;
    const struct morris_design d = design_of(n);
    run(&d, f);
    assert_int_equal(morris_find(&d, demand, STEP, effect, &n_left_out, &e), STATUS_OK);
    assert_int_equal(n_left_out, 0);
}

// Each run differs from the one before in one parameter, by half of the levels; each parameter
// moves once in a trajectory.
static void a_trajectory_moves_each_parameter_once(void **state) {
    (void)state;
    const struct morris_design d = design_of(500);
    int up = 0;
    for (size_t t = 0; t < d.n; t++) {
        int moved[PARAMETERS] = {0};
        for (int k = 1; k < RUNS; k++) {
            const unsigned char *from = level + (t * RUNS + (size_t)k - 1) * PARAMETERS;
            for (int i = 0; i < PARAMETERS; i++) {
                const int jump = from[PARAMETERS + i] - from[i];
                assert_true(from[i] < LEVELS && (jump == 0 || abs(jump) == LEVELS / 2));
                moved[i] += jump != 0;
                up += jump > 0;
            }
        }
        for (int i = 0; i < PARAMETERS; i++) {
            assert_int_equal(moved[i], 1);
        }
    }
    // Half of 1500 jumps, within four standard deviations sqrt(1500) / 2.
    assert_near(up, 750.0, 78.0);
}

static void a_linear_function_has_its_slopes(void **state) {
    (void)state;
    struct morris_effect effect[PARAMETERS];
    const double slope[] = {3.0, -4.0, 0.0};
    effects_of(linear, 10, effect);
    for (int i = 0; i < PARAMETERS; i++) {
        assert_near(effect[i].mu, slope[i], 1e-12);
        assert_near(effect[i].mu_star.value, fabs(slope[i]), 1e-12);
        assert_near(effect[i].sigma, 0.0, 1e-12);
        assert_near(effect[i].mu_star.low, fabs(slope[i]), 1e-12);
        assert_near(effect[i].mu_star.high, fabs(slope[i]), 1e-12);
    }
}

// At x = -pi, -pi/3, pi/3, pi each jump is one of 2 pairs of levels. With s = sin(pi/3) and an
// effect of 3/2 of the change:
//     x1: 1.5 s (1 + 0.1 x3^4), x3^4 = pi^4 or (pi/3)^4, equally often
//     x2: 1.5 * 7 s^2, up or down
//     x3: 1.5 * 0.1 s (pi^4 - (pi/3)^4) up or down where sin(x1) is not 0, which is every other
//     time
static void ishigami_has_its_effects(void **state) {
    (void)state;
    struct morris_effect effect[PARAMETERS];
    const double s = sin(M_PI / 3.0), p4 = pow(M_PI, 4.0), q4 = p4 / 81.0;
    const double large = 1.5 * s * (1.0 + 0.1 * p4), small = 1.5 * s * (1.0 + 0.1 * q4);
    const double third = 0.15 * s * (p4 - q4);
    const double mu_star[] = {(large + small) / 2.0, 7.875, third / 2.0};
    const double mu[] = {mu_star[0], 0.0, 0.0};
    const double sigma[] = {(large - small) / 2.0, 7.875, third / sqrt(2.0)};
    effects_of(ishigami, TRAJECTORIES, effect);
    const double root = sqrt(TRAJECTORIES);
    for (int i = 0; i < PARAMETERS; i++) {
        // Four standard errors sigma / sqrt(n), which sigma has at most, too.
        assert_near(effect[i].mu, mu[i], 4.0 * sigma[i] / root);
        assert_near(effect[i].mu_star.value, mu_star[i], i == 1 ? 1e-12 : 4.0 * sigma[i] / root);
        assert_near(effect[i].sigma, sigma[i], 4.0 * sigma[i] / root);
    }
    // The interval is that of 95 %, 3.92 standard errors wide, of which bootstraps know 5 %.
    assert_close(effect[0].mu_star.high - effect[0].mu_star.low, 3.92 * sigma[0] / root, 0.15);
}

static void trajectories_without_numbers_do_not_count(void **state) {
    (void)state;
    struct morris_effect whole[PARAMETERS], cut[PARAMETERS];
    size_t n_left_out;
    struct error e;
    effects_of(ishigami, 20, whole);
    const struct morris_design d = design_of(22);
    run(&d, ishigami);
    demand[(size_t)20 * RUNS] = NAN;
    demand[(size_t)22 * RUNS - 1] = INFINITY;
    assert_int_equal(morris_find(&d, demand, STEP, cut, &n_left_out, &e), STATUS_OK);
    assert_int_equal(n_left_out, 2);
    for (int i = 0; i < PARAMETERS; i++) {
        assert_memory_equal(&whole[i], &cut[i], sizeof whole[i]);
    }
    for (size_t t = 1; t < 22; t++) {
        demand[t * RUNS] = NAN;
    }
    assert_int_equal(morris_find(&d, demand, STEP, cut, &n_left_out, &e), STATUS_FAILED);
    assert_string_equal(e.message, "only 1 of 22 trajectories have finite demands");
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_trajectory_moves_each_parameter_once),
        cmocka_unit_test(a_linear_function_has_its_slopes),
        cmocka_unit_test(ishigami_has_its_effects),
        cmocka_unit_test(trajectories_without_numbers_do_not_count),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
