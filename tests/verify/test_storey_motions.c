// SPDX-License-Identifier: GPL-3.0-or-later
// One storey (T = 0.6 s, 5 %) of each law of straight lines under El Centro against independent
// solutions, with Newmark's method and with that of Dormand & Prince.
#include <math.h>

#include "support/analysis.h"
#include "support/support.h"

struct motion_case {
    const char *law;
    double scale, peak, digits;  // the largest drift [m] with its error
};

#define IMK                                                                                        \
    "imk -yield 147099.75 -hardening 0.03 -capping 0.05365555482 -post-capping -0.08 "             \
    "-residual 0.2 -kf 0.4 -kd 0.3 -cycle "
#define GAMMA " -gamma-s 100 -gamma-c 100 -gamma-a 100 -gamma-k 100"
#define LINES "trilinear -crack 49033.25 -yield 147099.75 -cracked 0.3 -hardening 0.02"

static const struct motion_case cases[] = {
    {IMK "bilinear", 1, 0.0464869817, 2e-7},
    {IMK "bilinear", 2, 0.1319483184, 5e-7},
    {LINES " -origin", 1, 0.07363445962, 2e-7},
    {LINES " -origin", 2, 0.1510948737, 5e-7},
    {LINES, 1, 0.05128735028, 2e-7},
    {LINES, 2, 0.1590618934, 5e-7},
    // Five digits.
    {IMK "peak", 1, 0.049561, 1e-6},
    {IMK "peak", 2, 0.39418, 1e-5},
    {IMK "peak" GAMMA, 1, 0.050343, 1e-6},
    {IMK "peak" GAMMA, 2, 0.37625, 1e-5},
    {IMK "pinched", 1, 0.059458, 1e-6},
    {IMK "pinched", 2, 0.29986, 1e-5},
    {IMK "pinched" GAMMA, 1, 0.062738, 1e-6},
    {IMK "pinched" GAMMA, 2, 0.28016, 1e-5},
};

static void largest_drifts_are_those_of_independent_solutions(void **state) {
    (void)state;
    static const char *const step[] = {"fixed 0.05ms", "adaptive -tolerance 1e-9"};
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        const struct motion_case *c = &cases[i];
        for (int j = 0; j < 2; j++) {
            struct analysis a = analysis_of(
                "building A -floors 1 -mass 1e5 -stiffness 10966227.11\nstorey A:1 %s\n"
                "damping A dashpot 104719.7551\noutput -interval 0.02\n"
                "ground record tests/verify/reference/elcentro_led_by_zero.txt -format series "
                "-unit g -dt 0.02 -scale %g\nduration 31.18\nstep %s\n",
                c->law, c->scale, step[j]);

            assert_near(a.results->peak[PEAK_DRIFT][0], c->peak, c->digits);
            assert_true(a.results->residual_peak < 1e-7 * a.results->energy[ENERGY_INPUT]);
            analysis_free(&a);
        }
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(largest_drifts_are_those_of_independent_solutions),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
