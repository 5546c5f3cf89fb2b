// SPDX-License-Identifier: GPL-3.0-or-later
// Links within one building against the same stiffness and dashpot in its storeys.
#include <math.h>
#include <stdio.h>

#include "support/analysis.h"
#include "support/support.h"

static const char *const step[] = {"step fixed 1ms\n", "integrator newmark\nstep adaptive\n",
                                   "integrator dormand-prince\nstep adaptive -tolerance 1e-12\n"};
enum { N_STEP = sizeof step / sizeof step[0] };

// One building of four floors; B is there so that floors are not the first ones.
#define FRAME "building B -floors 2 -mass 300 -stiffness 2e5\n"
static void assert_twins(const char *chain, const char *linked, double tolerance) {
    for (int i = 0; i < N_STEP; i++) {
        struct analysis a[2];
        for (int k = 0; k < 2; k++) {
            a[k] = analysis_of(FRAME
                               "%s\nground sine -amplitude 3 -frequency 1.9 -cycles 3\nduration 3\n"
                               "initial A:4 -velocity 1\noutput -interval 10ms\n%s",
                               k == 0 ? chain : linked, step[i]);
        }
        double most = 0.0, apart = 0.0;
        assert_int_equal(a[0].rows.n, a[1].rows.n);
        for (long j = 0; j < 6 * a[0].rows.n; j++) {
            most = fmax(most, fabs(a[0].rows.displacement[j]));
            apart = fmax(apart, fabs(a[0].rows.displacement[j] - a[1].rows.displacement[j]));
        }
        assert_true(most > 0.01);
        assert_true(apart <= tolerance * most);
        analysis_free(&a[0]);
        analysis_free(&a[1]);
    }
}

static void a_damper_between_two_floors_is_a_dashpot_of_the_storey(void **state) {
    (void)state;
    const char *const chain = "building A -floors 4 -mass 80 -stiffness 9e4\n";
    char linked[500], dashpots[500];
    snprintf(dashpots, sizeof dashpots, "%sdamping A dashpot 70 0 0 900", chain);
    snprintf(linked, sizeof linked, "%slink A:0 A:1 -dashpot 70\nlink A:3 A:4 -dashpot 900", chain);
    assert_twins(dashpots, linked, 1e-12);
    snprintf(linked, sizeof linked, "%slink A:1 A:0 -dashpot 70\nlink A:4 A:3 -dashpot 900", chain);
    assert_twins(dashpots, linked, 1e-12);
    snprintf(dashpots, sizeof dashpots, "%sdamping A dashpot 70 0 0 900\ndamping A modal 5%%",
             chain);
    snprintf(linked, sizeof linked,
             "%sdamping A modal 5%%\nlink A:0 A:1 -dashpot 70\nlink A:4 A:3 -dashpot 900", chain);
    assert_twins(dashpots, linked, 1e-12);
}

static void a_spring_between_two_floors_adds_to_the_storey(void **state) {
    (void)state;
    assert_twins("building A -floors 4 -mass 80 -stiffness 9e4 10e4 9e4 9e4",
                 "building A -floors 4 -mass 80 -stiffness 9e4\nlink A:2 A:1 -stiffness 1e4",
                 1e-12);
    assert_twins("building A -floors 4 -mass 80 -stiffness 12e4 12e4 9e4 9e4",
                 "building A -floors 4 -mass 80 -stiffness 9e4\nlink A:0:1 A:1:2 -stiffness 3e4",
                 1e-12);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_damper_between_two_floors_is_a_dashpot_of_the_storey),
        cmocka_unit_test(a_spring_between_two_floors_adds_to_the_storey),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
