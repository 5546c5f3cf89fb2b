// SPDX-License-Identifier: GPL-3.0-or-later
// Published tables of A. K. Chopra, Dynamics of Structures: the single-degree-of-freedom system of
// chapter 5 (tables E5.3, E5.4 and E5.5) under half a cycle of sine, and the five-storey building
// of chapter 13 under El Centro.
#include <math.h>
#include <string.h>

#include "support/analysis.h"
#include "support/support.h"

// m 0.2533 kip s2/in, k 10 kip/in, zeta 0.05, p = 10 sin(pi t / 0.6) kip for t < 0.6 s.
static const char oscillator[] = "units kip in s\n"
                                 "building A -floors 1 -mass 0.2533 -stiffness 10\n"
                                 "damping A modal 0.05\n"
                                 "load A:1 sine -amplitude 10 -frequency ${1/1.2} -cycles 0.5\n"
                                 "duration 1\nstep fixed 0.1\noutput -every 1\n";

// Tables print four decimals.
static const double FOUR_DECIMALS = 0.5e-4;

static void average_acceleration_gives_table_e5_3(void **state) {
    (void)state;
    struct analysis a = analysis_of("%s", oscillator);
    assert_near(analysis_displacement(&a, 0, 0.5), 1.4310, FOUR_DECIMALS);
    assert_near(analysis_displacement(&a, 0, 1.0), -1.1442, FOUR_DECIMALS);
    analysis_free(&a);
}

static void linear_acceleration_gives_table_e5_4(void **state) {
    (void)state;
    struct analysis a = analysis_of("%sintegrator newmark -beta ${1/6}\n", oscillator);
    assert_near(analysis_displacement(&a, 0, 0.5), 1.4782, FOUR_DECIMALS);
    assert_near(analysis_displacement(&a, 0, 1.0), -1.2208, FOUR_DECIMALS);
    analysis_free(&a);
}

static void an_elastoplastic_spring_gives_table_e5_5(void **state) {
    (void)state;
    struct analysis a = analysis_of("%sstorey A:1 bilinear -yield 7.5 -hardening 0\n", oscillator);
    assert_near(analysis_displacement(&a, 0, 0.7), 2.0952, FOUR_DECIMALS);
    assert_near(analysis_displacement(&a, 0, 1.0), 1.1416, FOUR_DECIMALS);
    analysis_free(&a);
}

// The same in SI with rounded values, computed independently to ten digits.
static void the_elastoplastic_spring_in_si_agrees_to_ten_digits(void **state) {
    (void)state;
    struct analysis a =
        analysis_of("building A -floors 1 -mass 45594kg -stiffness 18e5\n"
                    "damping A modal 0.05\n"
                    "load A:1 sine -amplitude 50000 -frequency ${1/1.2} -cycles 0.5\n"
                    "storey A:1 bilinear -yield 36000 -hardening 0\n"
                    "duration 1\nstep fixed 0.1\noutput -every 1\n");
    assert_near(analysis_displacement(&a, 0, 1.0), 0.0360632810, 0.5e-10);
    analysis_free(&a);
}

// Five storeys of 45 t and 5.482e6 N/m, 5 % in every mode; a zero sample before the 1559 values.
static void the_five_storey_building_under_el_centro_agrees_to_eight_digits(void **state) {
    (void)state;
    struct analysis a = analysis_of("gravity 9.81\n"
                                    "building A -floors 5 -mass 45t -stiffness 5.482e6\n"
                                    "damping A modal 5%%\n"
                                    "ground record input/records/ELCENTRO_1940_NS.AT2 -delay 0.02\n"
                                    "step fixed 0.02\noutput -every 1\n");
    const struct results *r = a.results;
    assert_close(r->peak[PEAK_DISPLACEMENT][4], 0.1733029624, 1e-8);
    assert_close(r->peak[PEAK_SHEAR][0], 323561.21325, 1e-8);
    assert_close(r->peak[PEAK_SHEAR][4], 153613.93762, 1e-8);
    analysis_free(&a);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(average_acceleration_gives_table_e5_3),
        cmocka_unit_test(linear_acceleration_gives_table_e5_4),
        cmocka_unit_test(an_elastoplastic_spring_gives_table_e5_5),
        cmocka_unit_test(the_elastoplastic_spring_in_si_agrees_to_ten_digits),
        cmocka_unit_test(the_five_storey_building_under_el_centro_agrees_to_eight_digits),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
