// SPDX-License-Identifier: GPL-3.0-or-later
// What is estimated of a model before it runs, against closed forms and spectra.
#include "model/guidance.h"

#include <math.h>

#include "jostle/spectrum.h"
#include "support/analysis.h"
#include "support/support.h"

static const double PI = 3.141592653589793;

static struct guidance guidance_of(const struct model *m) {
    struct guidance g;
    struct error e;
    assert_int_equal(guidance_find(m, &g, &e), STATUS_OK);
    return g;
}

// Two free bodies of 25 t and 40 t, the first at 0.5 m/s.
static struct model *two_bodies(const char *law, double dt) {
    return analysis_model("building A -floors 1 -mass 25t -stiffness 0\n"
                          "building B -floors 1 -mass 40t -stiffness 0\n"
                          "initial A:1 -velocity 0.5\ncontact A B -gap 10mm -law %s\n"
                          "duration 0.1\nstep fixed %.17g\n",
                          law, dt);
}

static const double MASS = 25e3 * 40e3 / 65e3;

static void a_linear_contact_lasts_half_a_period(void **state) {
    (void)state;
    struct model *m = two_bodies("linear -k 93.5e6", 1e-3);
    struct guidance g = guidance_of(m);
    assert_int_equal(g.n_contact, 1);
    assert_int_equal(g.shortest, 0);
    assert_close(g.contact[0].velocity, 0.5, 1e-12);
    assert_close(g.contact[0].duration, PI * sqrt(MASS / 93.5e6), 1e-9);
    assert_close(g.step, 5e-4, 1e-12);  // 40.3 ms / 50 = 0.806 ms
    assert_true(isinf(g.period) && isinf(g.sampling) && isinf(g.sine));
    model_free(m);
}

static void a_contact_of_hertz_depends_on_the_velocity(void **state) {
    (void)state;
    struct model *m = two_bodies("hertz -k 2.75e9", 1e-3);
    double depth = pow(1.25 * MASS * 0.25 / 2.75e9, 0.4);
    assert_close(guidance_of(m).contact[0].duration, 2.943275 * depth / 0.5, 1e-6);
    model_free(m);
}

static void a_rigid_contact_asks_for_no_step(void **state) {
    (void)state;
    struct model *m = two_bodies("stereomechanical -e 0.5", 1e-3);
    struct guidance g = guidance_of(m);
    assert_int_equal(g.shortest, -1);
    assert_near(g.contact[0].duration, 0.0, 0.0);
    assert_true(isinf(g.step));
    model_free(m);
}

static void bodies_that_never_part_have_no_duration(void **state) {
    (void)state;
    struct model *m = two_bodies("kelvin-voigt -k 93.5e6 -zeta 1.5", 1e-3);
    struct guidance g = guidance_of(m);
    assert_int_equal(g.shortest, -1);
    assert_true(isnan(g.contact[0].duration));
    model_free(m);
}

static void a_model_at_rest_has_no_duration(void **state) {
    (void)state;
    struct model *m = analysis_model(
        "building A -floors 1 -mass 25t -stiffness 1e6\n"
        "contact A wall -gap 10mm -law linear -k 1e6\nduration 1\nstep fixed 0.01\n");
    struct guidance g = guidance_of(m);
    assert_near(g.contact[0].velocity, 0.0, 0.0);
    assert_true(isnan(g.contact[0].duration));
    assert_close(g.step, 0.02, 1e-12);  // of the period, 2 pi sqrt(25e3 / 1e6) = 0.99 s
    model_free(m);
}

// One storey is one oscillator: its velocity is the spectrum of the record.
static void a_storey_moves_as_the_spectrum_says(void **state) {
    (void)state;
    struct model *m =
        analysis_model("building A -floors 1 -mass 100t -stiffness 20MN/m\ndamping A rayleigh 5%%\n"
                       "ground record %s -unit g -dt 0.02\nstep fixed 0.001\n",
                       support_write("record.txt", "0\n0.1\n-0.3\n0.2\n0.25\n-0.1\n0.05\n0\n"));
    double velocity, rate;
    struct error e;
    assert_int_equal(floor_velocity(m, 0, &velocity, &rate, &e), STATUS_OK);
    double period = 2.0 * PI / m->building[0].omega[0];
    struct spectrum_point p = spectrum_at(&m->ground[0].signal[0], period, 0.05);
    assert_true(velocity > 0.0);
    assert_close(velocity, p.value[SPECTRUM_SV], 1e-9);
    assert_close(guidance_of(m).sampling, 0.02, 1e-9);
    model_free(m);
}

// A pulse of 0.04 s at 1 s acts in an analysis of 1.1 s, but not in one of 0.5 s.
static void what_comes_after_the_end_moves_nothing(void **state) {
    (void)state;
    const char text[] = "0\n0\n0\n0\n0\n0\n0\n0\n0\n0\n0\n0\n0\n0\n0\n0\n0\n0\n0\n0\n"
                        "0\n0\n0\n0\n0\n0\n0\n0\n0\n0\n0\n0\n0\n0\n0\n0\n0\n0\n0\n0\n"
                        "0\n0\n0\n0\n0\n0\n0\n0\n0\n0\n0\n0.5\n0\n";
    const char *record = support_write("late.txt", text);
    double velocity[2], rate[2];
    for (int i = 0; i < 2; i++) {
        struct model *m =
            analysis_model("building A -floors 1 -mass 100t -stiffness 20MN/m\n"
                           "ground record %s -unit g -dt 0.02\nstep fixed 0.001\nduration %g\n",
                           record, i == 0 ? 0.5 : 1.1);
        struct error e;
        assert_int_equal(floor_velocity(m, 0, &velocity[i], rate, &e), STATUS_OK);
        model_free(m);
    }
    assert_near(velocity[0], 0.0, 0.0);
    assert_true(velocity[1] > 0.0);
}

// In resonance the velocity of an oscillator of damping z tends to a / (2 z omega).
static void a_sine_in_resonance_is_amplified(void **state) {
    (void)state;
    struct model *m =
        analysis_model("building A -floors 1 -mass 1 -stiffness ${(2 * pi)^2}\n"
                       "damping A rayleigh 5%%\nload A:1 sine -amplitude 1 -frequency 1\n"
                       "duration 40\nstep fixed 0.01\n");
    double velocity, rate;
    struct error e;
    assert_int_equal(floor_velocity(m, 0, &velocity, &rate, &e), STATUS_OK);
    assert_close(velocity, 1.0 / (2.0 * 0.05 * 2.0 * PI), 0.01);  // samples are joined by lines
    assert_close(guidance_of(m).sine, 1.0, 1e-12);
    model_free(m);
}

// The modal masses of free vibration: both floors move alike, so the velocity is the initial one.
static void an_initial_velocity_of_a_mode_stays(void **state) {
    (void)state;
    struct model *m = analysis_model("building A -floors 2 -mass 1 -stiffness 0 1\n"
                                     "initial A -velocity 0.3\nduration 1\nstep fixed 0.01\n");
    double velocity[2], rate[2];
    struct error e;
    assert_int_equal(floor_velocity(m, 0, velocity, rate, &e), STATUS_OK);
    assert_close(velocity[0], 0.3, 1e-9);
    assert_close(velocity[1], 0.3, 1e-9);
    assert_close(rate[0], 0.3, 1e-9);
    assert_near(rate[1], 0.0, 1e-9);
    model_free(m);
}

static void a_spring_between_buildings_shortens_the_period(void **state) {
    (void)state;
    struct model *m = analysis_model("building A -floors 1 -mass 1 -stiffness 100\n"
                                     "building B -floors 1 -mass 1 -stiffness 100\n"
                                     "link A B -stiffness 50\nduration 1\nstep fixed 0.01\n");
    // Against each other they vibrate at omega^2 = 100 + 2 * 50; the bound is exact here.
    assert_close(guidance_of(m).period, 2.0 * PI / sqrt(200.0), 1e-12);
    model_free(m);
}

static void steps_are_rounded_down_to_one_two_or_five(void **state) {
    (void)state;
    assert_close(guidance_round(1e-3), 1e-3, 1e-14);
    assert_close(guidance_round(1.99e-3), 1e-3, 1e-14);
    assert_close(guidance_round(2e-4), 2e-4, 1e-14);
    assert_close(guidance_round(4.9e-4), 2e-4, 1e-14);
    assert_close(guidance_round(0.5), 0.5, 1e-14);
    assert_close(guidance_round(9.99), 5.0, 1e-14);
    assert_close(guidance_round(1000.0), 1000.0, 1e-14);
    assert_close(guidance_round(0.0099999), 0.005, 1e-14);
}

static void a_short_contact_is_warned_of_once(void **state) {
    (void)state;
    struct model *m = two_bodies("linear -k 93.5e6", 5e-3);
    struct guidance g = guidance_of(m);
    int before = m->deck->diagnostics.n_warning;
    guidance_warn(m, &g);
    assert_int_equal(m->deck->diagnostics.n_warning, before + 1);
    model_free(m);
    m = two_bodies("linear -k 93.5e6", 4e-3);
    g = guidance_of(m);
    before = m->deck->diagnostics.n_warning;
    guidance_warn(m, &g);
    assert_int_equal(m->deck->diagnostics.n_warning, before);
    model_free(m);
}

static void a_refined_model_ends_at_the_same_time(void **state) {
    (void)state;
    static const double duration[] = {1.0, 1.004, 1.0099};
    static const long steps[] = {100, 101, 101}, refined[] = {800, 804, 808};
    for (int i = 0; i < 3; i++) {
        struct model *m = analysis_model("building A -floors 1 -mass 1 -stiffness 1\n"
                                         "initial A -velocity 1\nduration %.17g\n"
                                         "step fixed 0.01\noutput -every 2\n",
                                         duration[i]);
        struct model finer = model_refined(m, 3);
        assert_int_equal(m->n_step, steps[i]);
        assert_int_equal(finer.n_step, refined[i]);
        assert_close(finer.dt, 0.00125, 1e-15);
        assert_int_equal(finer.output.every, 16);
        assert_close(model_time(&finer, finer.n_step), duration[i], 1e-15);
        assert_true(model_time(&finer, finer.n_step - 1) < duration[i]);
        model_free(m);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_linear_contact_lasts_half_a_period),
        cmocka_unit_test(a_contact_of_hertz_depends_on_the_velocity),
        cmocka_unit_test(a_rigid_contact_asks_for_no_step),
        cmocka_unit_test(bodies_that_never_part_have_no_duration),
        cmocka_unit_test(a_model_at_rest_has_no_duration),
        cmocka_unit_test(a_storey_moves_as_the_spectrum_says),
        cmocka_unit_test(what_comes_after_the_end_moves_nothing),
        cmocka_unit_test(a_sine_in_resonance_is_amplified),
        cmocka_unit_test(an_initial_velocity_of_a_mode_stays),
        cmocka_unit_test(a_spring_between_buildings_shortens_the_period),
        cmocka_unit_test(steps_are_rounded_down_to_one_two_or_five),
        cmocka_unit_test(a_short_contact_is_warned_of_once),
        cmocka_unit_test(a_refined_model_ends_at_the_same_time),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
