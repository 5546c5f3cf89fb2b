// SPDX-License-Identifier: GPL-3.0-or-later
// `ground record ... -sa`: records scaled to a spectral acceleration.
#include <gsl/gsl_math.h>
#include <stdio.h>
#include <string.h>

#include "jostle/spectrum.h"
#include "support/analysis.h"
#include "support/support.h"

// First periods: A (two storeys, k/m = 400) 2 pi / (20 sqrt((3 - sqrt 5) / 2)) s = 0.5083 s;
// B (one storey) 2 pi / 10 s.
#define TWO                                                                                        \
    "building A -floors 2 -mass 2 -stiffness 800\n"                                                \
    "building B -floors 1 -mass 2 -stiffness 200\n"
#define STEP "step fixed 0.01s\n"
#define RECORD "ground record input/records/ELCENTRO_1940_NS.AT2 "

static const struct signal *signal_under(const struct model *m, int building) {
    return &m->ground[m->building[building].ground].signal[0];
}

static double psa(const struct signal *s, double period, double damping) {
    return spectrum_at(s, period, damping).value[SPECTRUM_PSA];
}

static double first_period_of_a(void) {
    return 2.0 * M_PI / (20.0 * sqrt((3.0 - sqrt(5.0)) / 2.0));
}

// The response is linear in the record, so that what is left is the rounding of a few thousand
// steps of the recurrence.
static const double ROUNDING = 1e-12;

static void the_scaled_record_has_the_acceleration_asked_for_at_the_period(void **state) {
    (void)state;
    struct model *m = analysis_model(TWO RECORD "-sa 0.4g -period 1.3s -damping 2%%\n" STEP);
    assert_close(psa(signal_under(m, 0), 1.3, 0.02), 0.4 * 9.80665, ROUNDING);
    model_free(m);
}

static void without_a_period_it_is_that_of_the_first_building(void **state) {
    (void)state;
    struct model *m = analysis_model(TWO RECORD "-sa 3\n" STEP);
    assert_close(psa(signal_under(m, 0), first_period_of_a(), 0.05), 3.0, ROUNDING);
    model_free(m);
    m = analysis_model(TWO RECORD "-sa 3 -buildings B\n" STEP);
    assert_close(psa(signal_under(m, 1), 2.0 * M_PI / 10.0, 0.05), 3.0, ROUNDING);
    model_free(m);
    m = analysis_model(TWO RECORD "-sa 3 -building B\n" STEP);
    assert_close(psa(signal_under(m, 0), 2.0 * M_PI / 10.0, 0.05), 3.0, ROUNDING);
    model_free(m);
}

static void units_of_the_deck_do_not_matter(void **state) {
    (void)state;
    struct model *m = analysis_model("units kN mm ms\n"
                                     "building A -floors 1 -mass 2t -stiffness 200kN/m\n" RECORD
                                     "-sa 0.4g\nstep fixed 10\n");
    // One mm/ms^2 is 1000 m/s^2.
    assert_close(psa(signal_under(m, 0), 1000.0 * 2.0 * M_PI / 10.0, 0.05), 0.4 * 9.80665e-3,
                 ROUNDING);
    model_free(m);
}

static void it_is_the_record_scaled_by_hand(void **state) {
    (void)state;
    struct model *plain = analysis_model(TWO RECORD "-delay 2\n" STEP);
    const struct signal *raw = signal_under(plain, 0);
    const double factor = 3.0 / psa(raw, 0.7, 0.05);
    char text[512];
    snprintf(text, sizeof text, TWO RECORD "-delay 2 -scale %.17g\n" STEP, factor);
    struct model *by_hand = analysis_model("%s", text);
    struct model *m = analysis_model(TWO RECORD "-delay 2 -sa 3 -period 0.7\n" STEP);
    const struct signal *got = signal_under(m, 0), *want = signal_under(by_hand, 0);
    assert_int_equal(got->n, want->n);
    assert_close(got->start, 2.0, 0);
    for (size_t j = 0; j < got->n; j++) {
        // The two differ in the order of two products; sums of a thousand such may cancel.
        assert_close(got->value[j], want->value[j], 1e-15);
        assert_near(got->displacement[j], want->displacement[j], 1e-12);
    }
    assert_string_equal(got->name, want->name);
    assert_non_null(strstr(got->scaled, "to a PSA of 3 m/s^2 at a period of 0.7 s, 5 % damping"));
    assert_null(want->scaled);
    model_free(plain);
    model_free(by_hand);
    model_free(m);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_scaled_record_has_the_acceleration_asked_for_at_the_period),
        cmocka_unit_test(without_a_period_it_is_that_of_the_first_building),
        cmocka_unit_test(units_of_the_deck_do_not_matter),
        cmocka_unit_test(it_is_the_record_scaled_by_hand),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
