// SPDX-License-Identifier: GPL-3.0-or-later
// Intensity measures: their names, and their values for a triangle of acceleration, whose integrals
// are known.
#include <gsl/gsl_math.h>
#include <math.h>
#include <string.h>

#include "core/arena.h"
#include "jostle/spectrum.h"
#include "study/measure.h"
#include "support/analysis.h"
#include "support/support.h"

static const double ROUNDING = 1e-13;

// In mm and ms, so that a forgotten unit shows: 1 m/s^2 is 1e-3 mm/ms^2.
static const char triangle[] = "units kN mm ms\n"
                               "building A -floors 1 -mass 1t -stiffness 1kN/mm\n"
                               "building B -floors 1 -mass 1t -stiffness 1kN/mm\n"
                               "step fixed 1ms\n";

// With the triangle as a record; analysis_model puts its path in.
#define RECORD "ground record %1$s -dt 1s -unit m/s2 "
static struct model *shaken(const char *ground) {
    char text[600];
    const char *path = support_write("triangle.txt", "0\n1\n0\n");
    snprintf(text, sizeof text, "%s%s", triangle, ground);
    return analysis_model(text, path);
}

static int measured(const struct model *m, const char *text, struct measure *out, double *value,
                    struct error *e) {
    struct arena *a = arena_create();
    assert_non_null(a);
    int status = measure_parse(&m->deck->units, text, a, out, e);
    if (status == STATUS_OK) {
        status = measure_of(out, m, value, e);
    }
    arena_free(a);
    return status;
}

static double value_of(const struct model *m, const char *text) {
    struct measure parsed;
    struct error e;
    double value = NAN;
    assert_int_equal(measured(m, text, &parsed, &value, &e), STATUS_OK);
    return value;
}

// 2 m/s^2 at the top, 1 s up and 1 s down.
static void measures_are_of_the_scaled_record_in_units_of_the_deck(void **state) {
    (void)state;
    struct model *m = shaken(RECORD "-scale 2\nduration 3s");
    assert_close(value_of(m, "PGA"), 2e-3, ROUNDING);
    assert_close(value_of(m, "pga"), 2e-3, ROUNDING);
    assert_close(value_of(m, "PGV"), 2.0, ROUNDING);
    assert_close(value_of(m, "PGD"), 2e3, ROUNDING);
    assert_close(value_of(m, "CAV"), 2.0, ROUNDING);
    assert_close(value_of(m, "Arias"), M_PI / (2.0 * 9.80665) * 4.0 * 2.0 / 3.0, ROUNDING);
    assert_close(value_of(m, "D5-95"), 1e3 * (2.0 - 2.0 * cbrt(0.1)), ROUNDING);
    assert_close(value_of(m, "D5-75:B"), 1e3 * (2.0 - cbrt(0.5) - cbrt(0.1)), ROUNDING);
    const struct signal *s = &m->ground[0].signal[0];
    const double one = spectrum_at(s, 700.0, 0.05).value[SPECTRUM_PSA];
    assert_close(value_of(m, "Sa(0.7s)"), one, ROUNDING);
    assert_close(value_of(m, "Sa(700)"), one, ROUNDING);
    assert_close(value_of(m, "Sa(700ms, 5%):A"), one, ROUNDING);
    assert_close(value_of(m, "Sa(0.7s,0.02)"), spectrum_at(s, 700.0, 0.02).value[SPECTRUM_PSA],
                 ROUNDING);
    double sum = 0.0;
    for (int i = 0; i < 20; i++) {
        sum += log(spectrum_at(s, 500.0 + 100.0 * i, 0.05).value[SPECTRUM_PSA]);
    }
    assert_close(value_of(m, "Sa_avg(0.5s:2.4s)"), exp(sum / 20.0), ROUNDING);
    model_free(m);
}

// The first half of the triangle: the run ends at its top, whenever it starts.
static void what_comes_after_the_run_does_not_count(void **state) {
    (void)state;
    struct model *m = shaken(RECORD "\nduration 1s");
    assert_close(value_of(m, "CAV"), 0.5, ROUNDING);
    assert_close(value_of(m, "PGV"), 0.5, ROUNDING);
    model_free(m);
    m = shaken(RECORD "-delay 0.5s\nduration 1.5s");
    assert_close(value_of(m, "CAV"), 0.5, ROUNDING);
    assert_close(value_of(m, "PGA"), 1e-3, ROUNDING);
    model_free(m);
}

static void grounds_without_a_measure_say_so(void **state) {
    (void)state;
    static const struct {
        const char *ground, *measure, *message;
    } cases[] = {
        {"ground sine -amplitude 1m/s2 -frequency 1Hz -cycles 2", "PGA",
         "PGA: the ground is not a single record, but sine"},
        {"initial A:1 -velocity 1m/s", "PGA",
         "PGA: the ground is not a single record, but at rest"},
        {RECORD "\n"
                "ground sine -amplitude 1m/s2 -frequency 1Hz -cycles 2",
         "CAV", "CAV: the ground is not a single record, but a sum of motions"},
        {RECORD "-buildings A\n" RECORD "-buildings B -delay 1s", "PGA",
         "PGA: the buildings have different grounds; name one: PGA:A"},
        {RECORD, "PGA:C", "PGA:C: the deck has no building C"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        struct measure parsed;
        struct error e;
        double value;
        char ground[300];
        snprintf(ground, sizeof ground, "%s\nduration 3s", cases[i].ground);
        struct model *m = shaken(ground);
        assert_int_equal(measured(m, cases[i].measure, &parsed, &value, &e), STATUS_INPUT);
        assert_string_equal(e.message, cases[i].message);
        model_free(m);
    }
}

static void other_texts_are_no_measures(void **state) {
    (void)state;
    static const char *const texts[] = {
        "PGA:",      "PGAX",          "Sa",        "Sa()",          "Sa(0s)",  "Sa(-1s)",
        "Sa(1m)",    "Sa(1s,100%)",   "Sa(1s,1s)", "Sa(1s",         "Sa(1s)A", "Sa(1s:2s)",
        "Sa_avg(1)", "Sa_avg(2s:1s)", "Sa(nan)",   "Sa_avg(1s:2)x", "gap",     "",
    };
    struct unit_system u;
    struct arena *a = arena_create();
    assert_non_null(a);
    unit_system_init(&u);
    for (size_t i = 0; i < sizeof texts / sizeof texts[0]; i++) {
        struct measure m;
        struct error e;
        assert_int_equal(measure_parse(&u, texts[i], a, &m, &e), STATUS_INPUT);
    }
    assert_false(measure_is_named("sa"));
    assert_false(measure_is_named("gap"));
    assert_true(measure_is_named("pgv:A"));
    assert_true(measure_is_named("Sa(1"));
    arena_free(a);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(measures_are_of_the_scaled_record_in_units_of_the_deck),
        cmocka_unit_test(what_comes_after_the_run_does_not_count),
        cmocka_unit_test(grounds_without_a_measure_say_so),
        cmocka_unit_test(other_texts_are_no_measures),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
