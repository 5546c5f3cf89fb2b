// SPDX-License-Identifier: GPL-3.0-or-later
// Storeys that yield under the method of Dormand & Prince: where their branches end and turns are
// found, however small they are to the tolerance and however short or long the steps.
#include <math.h>
#include <stdio.h>

#include "support/analysis.h"
#include "support/support.h"

// 2 Hz.
#define OSCILLATOR "building A -floors 1 -mass 1000 -stiffness 157913.67041742973\n"

static void yielding_and_unloading_are_located(void **state) {
    (void)state;
    struct analysis a = analysis_of(OSCILLATOR "storey A:1 bilinear -yield 5000 -hardening 0.1\n"
                                               "ground sine -amplitude 0.8g -frequency 1.5Hz\n"
                                               "step adaptive -tolerance 1e-10\nduration 4\n");
    const struct results *r = a.results;
    assert_true(r->totals.events >= 10);
    assert_true(r->energy[ENERGY_HYSTERETIC] > 0.1 * r->energy[ENERGY_INPUT]);
    assert_true(r->residual_peak < 1e-8 * r->energy[ENERGY_INPUT]);
    struct analysis fixed =
        analysis_of(OSCILLATOR "storey A:1 bilinear -yield 5000 -hardening 0.1\n"
                               "ground sine -amplitude 0.8g -frequency 1.5Hz\n"
                               "step fixed 0.02ms\noutput -interval 0.01\nduration 4\n");
    assert_close(r->peak[PEAK_DRIFT][0], fixed.results->peak[PEAK_DRIFT][0], 1e-6);
    assert_close(r->peak[PEAK_SHEAR][0], fixed.results->peak[PEAK_SHEAR][0], 1e-6);
    assert_close(r->energy[ENERGY_HYSTERETIC], fixed.results->energy[ENERGY_HYSTERETIC], 1e-6);
    analysis_free(&a);
    analysis_free(&fixed);
}

static struct analysis bilinear_run(const char *tolerance) {
    return analysis_of("building A -floors 1 -mass 627292 -stiffness 8.21804e8\n"
                       "storey A:1 bilinear -yield 425666 -hardening 0.1\n"
                       "ground sine -amplitude 3.499 -frequency 2.396 -cycles 1\n"
                       "integrator dormand-prince\nstep adaptive -tolerance %s\n"
                       "output -interval 0.05\nduration 3.348\n",
                       tolerance);
}

// A step that ends right behind a turn, by less than the error allowed, is followed by one in which
// the storey comes to yield the other way, with the same tangent: it had gone on along the line of
// the first yielding, and erred by 0.4 of the largest drift. 1e-4 leaves a hundred times the
// tolerance for its growth in eight periods without damping.
static void a_storey_that_has_turned_within_the_error_of_a_step_unloads(void **state) {
    (void)state;
    struct analysis a = bilinear_run("1e-6");
    struct analysis b = bilinear_run("1e-11");
    assert_int_equal(a.rows.n, b.rows.n);
    for (long i = 0; i < a.rows.n; i++) {
        assert_near(a.rows.drift[i], b.rows.drift[i], 1e-4 * b.results->peak[PEAK_DRIFT][0]);
    }
    analysis_free(&a);
    analysis_free(&b);
}

// After a quiet beginning the first step is long, and the drift of a storey between floors that
// move alike grows like t^5, less than the step may be wrong. Its turns are none: steps went to one
// after the other, 1e-10 s apart, and never on.
static void a_drift_within_the_error_of_the_step_does_not_turn(void **state) {
    (void)state;
    static const char *const law[] = {"clough -yield 1.5e6 -hardening 0.05",
                                      "takeda -yield 1.5e6 -hardening 0.05",
                                      "bouc-wen -yield 1.5e6 -hardening 0.05",
                                      "bouc-wen -yield 1.5e6 -hardening 0.05 -zeta-s 0.8 -q 0.1",
                                      "multilinear -yield 1.5e6 -hardening 0.05",
                                      "ramberg-osgood -yield 1.5e6 -eta 0.1 -r 6"};
    static const double tolerance[] = {1e-4, 1e-6, 1e-8, 1e-10};
    for (int i = 0; i < 24; i++) {
        struct analysis a =
            analysis_of("building A -floors 3 -mass 1e5 2e5 1.2e5 -stiffness 2.5e8\nstorey A:2 %s\n"
                        "ground sine -amplitude 5 -frequency 8 -delay 20ms\nduration 0.1\n"
                        "step adaptive -tolerance %g\n",
                        law[i % 6], tolerance[i / 6]);
        assert_in_range(a.results->totals.steps, 1, 300);
        assert_in_range(a.results->totals.events, 0, 2);
        analysis_free(&a);
    }
}

// A storey of 4e6 N/m that yields at 20 kN and is left with 5 % of that. In steps in which drifts
// move by less than they may be wrong, events add up until they count: it stayed elastic.
// The drift is as wrong as the tolerance lets it be at each of its events.
static void a_storey_yields_however_short_the_steps(void **state) {
    (void)state;
    // The drift at rest, from v^2 m = V d_y + (2 V + 0.05 k x) x, x beyond the yield drift d_y.
    const double k = 4e6, yield = 20e3, hard = 0.05 * k, v = 0.3, m = 1e5;
    const double rest = v * v * m - yield * yield / k;
    const double want = yield / k + (sqrt(yield * yield + hard * rest) - yield) / hard;
    for (int i = 2; i <= 4; i++) {
        struct analysis a = analysis_of("building A -floors 1 -mass 1e5 -stiffness 4e6\n"
                                        "storey A:1 bilinear -yield 20e3 -hardening 0.05\n"
                                        "initial A:1 -velocity 0.3\nduration 3\n"
                                        "step adaptive -tolerance %g -max 1e-4\n",
                                        pow(10.0, -i));
        assert_in_range(a.results->totals.events, 4, 4);
        assert_close(a.results->peak[PEAK_DRIFT][0], want, pow(10.0, -i));
        analysis_free(&a);
    }
}

// A step may begin just before a turn that is too small to count, and go back through the whole
// elastic branch to yield the other way, where the tangent is the same: that was no event.
static void a_storey_that_yields_both_ways_in_a_step_unloads_between(void **state) {
    (void)state;
    double peak[2];
    for (int i = 0; i < 2; i++) {
        struct analysis a =
            analysis_of("building A -floors 3 -mass 1e5 -stiffness 4e7\n"
                        "storey A:1:3 bilinear -yield 60e3 -hardening 0.05\n"
                        "building B -floors 3 -mass 2e5 -stiffness 2e7\ndamping B modal 0.05\n"
                        "contact A B -gap 5mm -law jankowski -k 1e9 -e 0.6\n"
                        "ground sine -amplitude 2 -frequency 1.5 -cycles 6\nduration 2\n"
                        "step adaptive -tolerance %g\n",
                        i ? 1e-8 : 1e-4);
        peak[i] = a.results->peak[PEAK_ACCELERATION][0];
        analysis_free(&a);
    }
    assert_close(peak[0], peak[1], 1e-2);  // 1e-4 a step; it was 11.7 in place of 8 m/s^2
}

// The lines of a storey that remembers its largest drift end where they meet, too. Its acceleration
// is largest where it yields, of which steps over that missed up to 1e4 times the tolerance.
static void a_storey_that_remembers_ends_its_steps_at_its_kinks(void **state) {
    (void)state;
    static const char *const law[] = {"clough -yield 5000 -hardening 0.1",
                                      "takeda -yield 5000 -hardening 0.1 -beta 0.3"};
    for (int i = 0; i < 6; i++) {
        const double tolerance[] = {pow(10.0, -6 - i % 3), 1e-12};
        struct analysis a[2];
        for (int j = 0; j < 2; j++) {
            a[j] = analysis_of(OSCILLATOR "storey A:1 %s\nground sine -amplitude 8 -frequency 1.5\n"
                                          "duration 4\nstep adaptive -tolerance %g\n",
                               law[i / 3], tolerance[j]);
        }
        // The error of a step, through eight periods.
        for (int q = 0; q < PEAK_COUNT; q++) {
            assert_close(a[0].results->peak[q][0], a[1].results->peak[q][0], 20.0 * tolerance[0]);
        }
        assert_int_equal(a[0].results->totals.events, a[1].results->totals.events);
        analysis_free(&a[0]);
        analysis_free(&a[1]);
    }
}

// A takeda storey of large alpha unloads to the origin, where its drift and its shear are noise,
// but of the size of what they were: it took up to 73 more events to come past there, or it
// rattled, as at 3e-8. Before it unloaded to the origin at most, peaks differed by 5 % between
// tolerances.
static void a_storey_passes_the_origin_at_once(void **state) {
    (void)state;
    struct analysis a[4];
    for (int i = 0; i < 4; i++) {
        a[i] = analysis_of(
            "building A -floors 3 -mass 210530 -stiffness 3.43641e8\n"
            "storey A:all takeda -alpha 0.93 -beta 0.36 -yield 286273 -hardening 0.1\n"
            "ground sine -amplitude 0.7459 -frequency 2.248 -phase 1.5707963267948966 -cycles 3 "
            "-delay 0.1\n"
            "ground sine -amplitude 0.4806 -frequency 2 -phase 1.5707963267948966 -cycles 2 "
            "-delay 0.3\n"
            "duration 1\nstep adaptive -tolerance %g\n",
            (const double[]){1e-11, 3e-8, 1e-8, 1e-9}[i]);
        assert_int_equal(a[i].results->totals.events, a[0].results->totals.events);
        assert_close(a[i].results->peak[PEAK_DRIFT][0], a[0].results->peak[PEAK_DRIFT][0], 1e-6);
    }
    for (int i = 0; i < 4; i++) {
        analysis_free(&a[i]);
    }
}

// The smooth law, and those whose branches are made by each turn of the drift, against small fixed
// steps.
static void every_storey_law_agrees_with_newmark(void **state) {
    (void)state;
    // Steps of 1/9000 of the first period err by a few 1e-7 of the drift.
    analysis_storey_laws_agree("step adaptive -tolerance 1e-8", "step fixed 5e-5", 1e-6);
}
int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(yielding_and_unloading_are_located),
        cmocka_unit_test(a_storey_that_has_turned_within_the_error_of_a_step_unloads),
        cmocka_unit_test(a_drift_within_the_error_of_the_step_does_not_turn),
        cmocka_unit_test(a_storey_yields_however_short_the_steps),
        cmocka_unit_test(a_storey_that_yields_both_ways_in_a_step_unloads_between),
        cmocka_unit_test(a_storey_that_remembers_ends_its_steps_at_its_kinks),
        cmocka_unit_test(a_storey_passes_the_origin_at_once),
        cmocka_unit_test(every_storey_law_agrees_with_newmark),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
