// SPDX-License-Identifier: GPL-3.0-or-later
// Residual drifts: against closed forms, and against drifts at which buildings come to rest.
#include <math.h>

#include "support/analysis.h"
#include "support/support.h"

static const double M = 1000, K = 1e6, YIELD = 5000;

#define STOREY "building A -floors 1 -mass 1000 -stiffness 1e6\nstorey A:1 "
#define PUSHED "initial A:1 -velocity 0.5\n"

// The first swing ends where the kinetic energy at the start has gone into the storey.
static double first_swing(double v, double hardening) {
    const double at_yield = YIELD / K, left = (M * v * v - K * at_yield * at_yield) / 2;
    return at_yield + (hardening > 0 ? (sqrt(YIELD * YIELD + 2 * hardening * K * left) - YIELD) /
                                           (hardening * K)
                                     : left / YIELD);
}

static void an_elastoplastic_storey_keeps_its_plastic_drift(void **state) {
    (void)state;
    struct analysis a = analysis_of(STOREY "bilinear -yield 5000 -hardening 0\n" PUSHED
                                           "step adaptive -tolerance 1e-11\nduration 5\n");
    assert_close(a.results->residual_drift[0], first_swing(0.5, 0) - YIELD / K, 1e-9);
    assert_close(a.results->peak[PEAK_DRIFT][0], first_swing(0.5, 0), 1e-9);
    analysis_free(&a);
}

// It unloads by less than twice its yield, so that nothing yields on the way to zero.
static void a_hardening_storey_unloads_elastically(void **state) {
    (void)state;
    const double r = 0.1, plastic = first_swing(0.5, r) - YIELD / K;
    struct analysis a = analysis_of(STOREY "bilinear -yield 5000 -hardening 0.1\n" PUSHED
                                           "step adaptive -tolerance 1e-11\nduration 0.1\n");
    assert_close(a.results->residual_drift[0], (1 - r) * plastic, 1e-9);
    analysis_free(&a);
}

// Of 2.5 times the yield it yields back on the way: the plastic drift p leaves r K p of the back
// spring, more than the other one bears, (1 - r) YIELD, which it then holds against it.
static void a_hard_storey_yields_back(void **state) {
    (void)state;
    const double r = 0.5, plastic = first_swing(2, r) - YIELD / K;
    struct analysis a = analysis_of(STOREY "bilinear -yield 5000 -hardening 0.5\n"
                                           "initial A:1 -velocity 2\n"
                                           "step adaptive -tolerance 1e-11\nduration 0.06\n");
    assert_true(r * plastic > YIELD / K);
    assert_close(a.results->residual_drift[0], (1 - r) * YIELD / (r * K), 1e-9);
    analysis_free(&a);
}

// Damped beyond oscillation, a storey creeps back from its largest drift to where it has no shear.
static void a_storey_comes_to_rest_at_its_residual_drift(void **state) {
    (void)state;
    static const char *const law[] = {
        "bilinear -yield 5000 -hardening 0.05", "bilinear -yield 5000 -hardening 0",
        "bouc-wen -yield 5000 -hardening 0.05", "clough -yield 5000 -hardening 0.05",
        "takeda -yield 5000 -hardening 0.05",   "takeda -yield 5000 -hardening 0 -alpha 0.95",
    };
    static const char model[] = STOREY "%s\ndamping A dashpot 126491\n"
                                       "initial A:1 -velocity 3\nstep fixed 0.1ms\nduration %s\n";
    for (size_t i = 0; i < sizeof law / sizeof law[0]; i++) {
        struct analysis soon = analysis_of(model, law[i], "0.15");
        struct analysis rest = analysis_of(model, law[i], "30");
        const double drift = rest.rows.drift[rest.rows.n - 1];
        assert_true(drift > 0.1 * YIELD / K && drift < 0.9 * rest.results->peak[PEAK_DRIFT][0]);
        assert_true(soon.rows.drift[soon.rows.n - 1] > 1.05 * drift);
        assert_close(soon.results->residual_drift[0], drift, 1e-7);
        assert_close(rest.results->residual_drift[0], drift, 1e-9);
        analysis_free(&soon);
        analysis_free(&rest);
    }
}

static void elastic_storeys_keep_none(void **state) {
    (void)state;
    struct analysis a = analysis_of("building A -floors 2 -mass 1000 -stiffness 1e6\n"
                                    "storey A:2 bilinear -yield 5000 -hardening 0\n"
                                    "initial A:1:2 -velocity 0.5\nstep fixed 1ms\nduration 5\n");
    assert_true(a.results->residual_drift[0] == 0);
    assert_true(fabs(a.results->residual_drift[1]) > 1e-4);
    analysis_free(&a);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(an_elastoplastic_storey_keeps_its_plastic_drift),
        cmocka_unit_test(a_hardening_storey_unloads_elastically),
        cmocka_unit_test(a_hard_storey_yields_back),
        cmocka_unit_test(a_storey_comes_to_rest_at_its_residual_drift),
        cmocka_unit_test(elastic_storeys_keep_none),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
