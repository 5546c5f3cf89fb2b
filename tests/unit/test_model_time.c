// SPDX-License-Identifier: GPL-3.0-or-later
// Ground motions, loads, initial state, steps and output as the statements of a deck make them, and
// parameters on their way into the model.
#include <gsl/gsl_math.h>
#include <stdio.h>
#include <string.h>

#include "support/analysis.h"
#include "support/support.h"

#define TWO                                                                                        \
    "building A -floors 2 -mass 2 -stiffness 800\n"                                                \
    "building B -floors 1 -mass 2 -stiffness 800\n"
#define STEP "step fixed 0.01s\n"
// 300 samples of 0.01 s; `series` holds 0, 1, -4, 2 m/s2.
#define RECORD "tests/records/good/7line_header.at2"

static const char *series(void) {
    return support_write("series.txt", "0.0\n1.0\n-4.0\n2.0\n");
}

// The model of `text` with -D arguments. To be given to model_free.
static struct model *defined_model(const char *text, const char *const *define, int n_define) {
    struct deck *deck = NULL;
    struct model *m = NULL;
    struct error e;
    assert_int_equal(deck_open_text("test.deck", text, define, n_define, &deck, &e), STATUS_OK);
    if (model_build(deck, &m, &e) != STATUS_OK) {
        fail_msg("%s: %s", e.message,
                 deck->diagnostics.n_item ? deck->diagnostics.item[0].message : "");
    }
    return m;
}

static double ground_at(const struct model *m, int building, double t) {
    const struct ground *g = &m->ground[m->building[building].ground];
    double sum = 0.0;
    for (int i = 0; i < g->n_signal; i++) {
        sum += signal_value(&g->signal[i], t);
    }
    return sum;
}

static void buildings_with_the_same_motions_share_a_ground(void **state) {
    (void)state;
    struct model *m =
        analysis_model(TWO "building C -floors 1 -mass 2 -stiffness 800\n"
                           "building D -floors 1 -mass 2 -stiffness 800\n"
                           "ground sine -amplitude 1 -frequency 0.25\n"
                           "ground sine -amplitude 2 -frequency 0.25 -buildings D B\n"
                           "contact A B -gap 1 -law linear -k 1\n"
                           "contact C D -gap 1 -law linear -k 1\n"
                           "contact A:1 C -gap 1 -law linear -k 1\n" STEP "duration 4\n");
    assert_int_equal(m->n_ground, 2);
    assert_int_equal(m->building[0].ground, m->building[2].ground);
    assert_int_equal(m->building[1].ground, m->building[3].ground);
    assert_close(ground_at(m, 0, 1.0), 1.0, 1e-14);
    assert_close(ground_at(m, 1, 1.0), 3.0, 1e-14);
    assert_true(m->link[0].moving_ground && m->link[1].moving_ground);
    assert_false(m->link[2].moving_ground);
    model_free(m);
}

static void a_building_without_a_motion_is_at_rest(void **state) {
    (void)state;
    struct model *m = analysis_model(
        TWO "ground sine -amplitude 1 -frequency 0.25 -buildings B\n" STEP "duration 4\n");
    assert_int_equal(m->n_ground, 2);
    assert_int_equal(m->ground[m->building[0].ground].n_signal, 0);
    assert_close(ground_at(m, 1, 1.0), 1.0, 1e-14);
    model_free(m);
}

static void a_sine_has_amplitude_frequency_phase_delay_and_cycles(void **state) {
    (void)state;
    struct model *m = analysis_model(
        TWO "ground sine -amplitude 0.1g -frequency 2Hz -phase 0.3 -delay 1s -cycles 3\n" STEP);
    double a = 0.980665;
    assert_true(ground_at(m, 0, 0.99) == 0.0);
    assert_close(ground_at(m, 0, 1.2), a * sin(4.0 * M_PI * 0.2 + 0.3), 1e-13);
    assert_true(ground_at(m, 0, 2.51) == 0.0);
    assert_close(m->duration, 2.5, 1e-14);
    assert_int_equal(m->n_step, 250);
    model_free(m);
}

static void a_record_is_scaled_delayed_and_converted(void **state) {
    (void)state;
    struct model *m = analysis_model(
        "units kN mm s\n" TWO "ground record %s -unit m/s2 -dt 0.1s -scale -0.5 -delay 1\n" STEP,
        series());
    assert_close(ground_at(m, 0, 1.1), -500.0, 1e-13);
    assert_close(ground_at(m, 0, 1.15), 750.0, 1e-13);  // linear between samples
    assert_close(ground_at(m, 1, 1.2), 2000.0, 1e-13);
    assert_true(ground_at(m, 0, 0.9) == 0.0);
    assert_close(m->duration, 1.3, 1e-14);
    model_free(m);
}

static void a_pga_scales_the_largest_absolute_value_and_keeps_the_sign(void **state) {
    (void)state;
    struct model *m = analysis_model(
        TWO "ground record %s -unit g -dt 0.1 -pga 0.2g -buildings A\n" STEP, series());
    assert_close(ground_at(m, 0, 0.2), -0.2 * 9.80665, 1e-13);
    assert_close(ground_at(m, 0, 0.1), 0.05 * 9.80665, 1e-13);
    assert_close(signal_peak(&m->ground[0].signal[0]), 0.2 * 9.80665, 1e-13);
    model_free(m);
}

// Before, at, between and after samples.
static void values_at_many_times_are_those_at_each(void **state) {
    (void)state;
    struct model *m = analysis_model(TWO "ground record " RECORD " -delay 0.37\n" STEP);
    const struct signal *s = &m->ground[0].signal[0];
    enum { TIMES = 203 };
    double time[TIMES], sum[TIMES] = {0.0};
    for (int i = 0; i < TIMES; i++) {
        time[i] = s->start + (i - 20) * (s->end - s->start) / 160.0;
    }
    time[0] = s->end + 2e-7 * s->dt;
    time[1] = s->end + 2e-6 * s->dt;
    signal_add_values(s, TIMES, time, sum);
    double largest = 0.0;
    for (int i = 0; i < TIMES; i++) {
        assert_true(sum[i] == signal_value(s, time[i]));
        largest = fmax(largest, fabs(sum[i]));
    }
    assert_true(largest > 0.0);
    model_free(m);
}

// Next to a sample rounding decides which two samples a value lies between: everywhere in the same
// way, as runs in lockstep and alone ask in different ways.
static void values_next_to_samples_are_those_at_each(void **state) {
    (void)state;
    struct model *m = analysis_model(TWO "ground record " RECORD " -delay 0.37\n" STEP);
    const struct signal *s = &m->ground[0].signal[0];
    enum { TIMES = 3001, PER_SAMPLE = 10 };
    double time[TIMES], sum[TIMES] = {0.0};
    for (int i = 0; i < TIMES; i++) {
        time[i] = (double)i * (s->dt / PER_SAMPLE);
    }
    signal_add_values(s, TIMES, time, sum);
    for (int i = 0; i < TIMES; i++) {
        assert_true(sum[i] == signal_value(s, time[i]));
    }
    model_free(m);
}

static void gravity_sets_the_unit_g_of_records(void **state) {
    (void)state;
    struct model *m =
        analysis_model("gravity 10\n" TWO "ground record %s -unit g -dt 0.1\n" STEP, series());
    assert_close(ground_at(m, 0, 0.2), -40.0, 1e-14);
    model_free(m);
}

static void the_longest_motion_sets_the_duration(void **state) {
    (void)state;
    struct model *m = analysis_model(TWO "ground record %s -unit g -dt 0.1 -delay 4\n"
                                         "ground record " RECORD "\n"
                                         "load A:1 history %s -dt 1\n"
                                         "ground sine -amplitude 1 -frequency 1\n" STEP,
                                     series(), series());
    const struct ground *g = &m->ground[0];
    assert_close(g->signal[1].end, 0.01 * (double)(g->signal[1].n - 1), 1e-12);
    assert_close(m->duration, fmax(4.3, g->signal[1].end), 1e-12);
    model_free(m);
}

static void loads_act_on_the_floors_named(void **state) {
    (void)state;
    struct model *m = analysis_model("units kN m s\n" TWO "load A constant 3\n"
                                     "load B:1 sine -amplitude 50kN -frequency 0.25 -cycles 1\n"
                                     "load A:2 history %s -dt 0.1s -scale 2\n" STEP "duration 8\n",
                                     series());
    const int dof[] = {0, 1, 2, 1};
    assert_int_equal(m->n_load, 4);
    for (int i = 0; i < 4; i++) {
        assert_int_equal(m->load[i].dof, dof[i]);
    }
    assert_true(signal_value(&m->load[0].signal, 0.0) == 3.0);
    assert_close(signal_value(&m->load[1].signal, 7.7), 3.0, 1e-14);
    assert_close(signal_value(&m->load[2].signal, 1.0), 50.0, 1e-14);
    assert_true(signal_value(&m->load[2].signal, 4.1) == 0.0);
    assert_close(signal_value(&m->load[3].signal, 0.2), -8.0, 1e-14);
    model_free(m);
}

static void the_initial_state_is_that_of_the_floors_named(void **state) {
    (void)state;
    struct model *m = analysis_model("units kN mm s\n" TWO "initial A:2 -displacement 2cm\n"
                                     "initial B -velocity -0.5m/s\n" STEP "duration 1\n");
    const double u[] = {0, 20, 0}, v[] = {0, 0, -500};
    for (int i = 0; i < 3; i++) {
        assert_near(m->displacement[i], u[i], 1e-12);
        assert_near(m->velocity[i], v[i], 1e-12);
    }
    model_free(m);
}

static void the_last_step_ends_at_the_duration(void **state) {
    (void)state;
    struct model *m = analysis_model(TWO "initial A:1 -velocity 1\nstep fixed 0.3\nduration 1\n");
    assert_int_equal(m->n_step, 4);
    assert_close(model_time(m, 3), 0.9, 1e-14);
    assert_true(model_time(m, 4) == 1.0);
    double time[4];
    model_times(m, 2, 4, time);
    for (int i = 0; i < 4; i++) {
        assert_true(time[i] == model_time(m, 2 + i));
    }
    model_times(m, 7, 1, time);
    assert_true(time[0] == 1.0);
    model_free(m);
    // 0.3 is 3 times 0.1 but for rounding: no fourth step of 4e-17 s.
    m = analysis_model(TWO "initial A:1 -velocity 1\nstep fixed 0.1\nduration 0.3\n");
    assert_int_equal(m->n_step, 3);
    model_free(m);
}

static void rows_are_0_01_s_apart_unless_told_otherwise(void **state) {
    (void)state;
    static const struct {
        const char *text;
        int every;
    } cases[] = {
        {"step fixed 0.5ms\n", 20},
        {"step fixed 0.01\n", 1},
        {"step fixed 0.02\n", 1},
        {"step fixed 0.003\n", 3},
        {"step fixed 0.01\noutput -every 7\n", 7},
        {"step fixed 0.1ms\noutput -interval 20ms\n", 200},
        {"step fixed ${1/3}\noutput -interval 1\n", 3},
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        struct model *m =
            analysis_model(TWO "initial A:1 -velocity 1\nduration 9s\n%s", cases[i].text);
        assert_int_equal(m->output.every, cases[i].every);
        model_free(m);
    }
    struct model *m =
        analysis_model("units N m ms\n" TWO "initial A:1 -velocity 1\nduration 9s\nstep fixed 2\n");
    assert_int_equal(m->output.every, 5);
    model_free(m);
}

static void output_chooses_fields_precision_and_file(void **state) {
    (void)state;
    struct model *m = analysis_model(
        TWO "initial A:1 -velocity 1\nduration 1\noutput -fields drift force -precision single "
            "-compress 4 -file \"my result.h5\"\n" STEP);
    assert_int_equal(m->output.fields, FIELD_DRIFT | FIELD_FORCE);
    assert_true(m->output.single);
    assert_int_equal(m->output.compress, 4);
    assert_string_equal(m->output.file, "my result.h5");
    model_free(m);
    m = analysis_model(TWO "initial A:1 -velocity 1\nduration 1\n" STEP);
    assert_int_equal(m->output.fields, FIELD_ALL);
    assert_false(m->output.single);
    assert_int_equal(m->output.compress, 0);
    assert_null(m->output.file);
    model_free(m);
}

static void integrator_and_newton_have_defaults(void **state) {
    (void)state;
    struct model *m = analysis_model(TWO "initial A:1 -velocity 1\nduration 1\n" STEP);
    assert_true(m->beta == 0.25 && m->gamma == 0.5);
    assert_true(m->tolerance > 0.0 && m->iterations > 0);
    model_free(m);
    m = analysis_model(TWO "initial A:1 -velocity 1\nduration 1\n" STEP
                           "integrator newmark -beta ${1/6} -gamma 0.6\n"
                           "newton -tolerance 1e-9 -iterations 7\n");
    assert_true(m->beta == 1.0 / 6.0 && m->gamma == 0.6);
    assert_true(m->tolerance == 1e-9 && m->iterations == 7);
    model_free(m);
}

static void a_step_just_below_the_limit_of_stability_is_taken(void **state) {
    (void)state;
    // omega = 20 1/s: sqrt(12)/20 = 0.17321 s and 2/20 = 0.1 s
    static const char *const lines[] = {"integrator newmark -beta ${1/6}\nstep fixed 0.1732\n",
                                        "integrator newmark -beta 0\nstep fixed 0.0999\n",
                                        "step fixed 1\n"};
    for (size_t i = 0; i < sizeof lines / sizeof lines[0]; i++) {
        struct model *m = analysis_model("building A -floors 1 -mass 1 -stiffness 400\n"
                                         "initial A:1 -velocity 1\nduration 5\n%s",
                                         lines[i]);
        assert_true(m->n_step >= 5);
        model_free(m);
    }
}

static void parameters_and_expressions_reach_the_model(void **state) {
    (void)state;
    static const char text[] = "units kN mm s\n"
                               "param gap 20mm\nparam n 3\nparam left Tower\n"
                               "param m ${100t * 2}\nparam law linear\nparam storeylaw elastic\n"
                               "building $left -floors $n -mass $m ${m/2}\\\n $m -stiffness 1\n"
                               "building B -floors ${n+1} -mass 1 -stiffness 1\n"
                               "storey ${left}:1 $storeylaw\n"
                               "contact $left:$n B -gap ${gap/2} -law $law -k 1\n"
                               "initial $left -velocity 1\nstep fixed 1\nduration 10\n";
    struct model *m = defined_model(text, NULL, 0);
    assert_string_equal(m->building[0].name, "Tower");
    assert_int_equal(m->building[1].n_dof, 4);
    assert_close(m->mass[1], 0.1, 1e-14);  // 100 t in kN s^2/mm
    assert_close(m->link[0].gap, 10.0, 1e-14);
    assert_string_equal(m->link[0].name, "Tower:3-B:3");
    model_free(m);
}

static void a_define_overrides_a_parameter(void **state) {
    (void)state;
    static const char text[] = "param gap 20mm\nparam n 3\nparam name A\n"
                               "building $name -floors $n -mass 1 -stiffness 1\n"
                               "contact $name wall -gap $gap -law linear -k 1\n"
                               "initial $name -velocity 1\nstep fixed 1\nduration 10\n";
    static const char *const define[] = {"gap=${1cm/4}", "n=5", "name=T"};
    struct model *m = defined_model(text, define, 3);
    assert_string_equal(m->building[0].name, "T");
    assert_int_equal(m->n_dof, 5);
    assert_close(m->link[4].gap, 0.0025, 1e-14);
    model_free(m);
}

static void grounds_that_part_by_more_than_the_gap_are_warned_about(void **state) {
    (void)state;
    struct model *m = analysis_model(
        TWO "contact A B -gap 10mm -law linear -k 1e6\nground sine -amplitude 1 -frequency 1 "
            "-buildings A\n" STEP "duration 2\n");
    assert_int_equal(m->deck->diagnostics.n_warning, 2);
    // The sine drifts by amplitude / omega each second: 2 / (2 pi) = 0.3183 m.
    assert_non_null(strstr(m->deck->diagnostics.item[0].message, "end -0.3183 m apart"));
    assert_non_null(strstr(m->deck->diagnostics.item[1].message, "acts under building B"));
    model_free(m);
}

static void what_moves_nothing_or_skips_samples_is_warned_about(void **state) {
    (void)state;
    struct model *m = analysis_model(TWO STEP "duration 1\n");
    assert_string_equal(m->deck->diagnostics.item[0].message,
                        "nothing moves the buildings: no ground motion, load or initial state");
    model_free(m);
    m = analysis_model(TWO "ground record %s -unit m/s2 -dt 0.1\nstep fixed 0.15\nduration 0.2\n",
                       series());
    assert_int_equal(m->deck->diagnostics.n_warning, 2);
    assert_non_null(strstr(m->deck->diagnostics.item[1].message, "is too long for building A"));
    assert_non_null(strstr(m->deck->diagnostics.item[0].message,
                           "step 0.15 s is longer than the sampling 0.1 s of "));
    model_free(m);
    static const char *const ratios[] = {"1% 9%", "9% 1%"}, *const negative[] = {"alpha", "beta"};
    for (int i = 0; i < 2; i++) {
        m = analysis_model(
            TWO "damping A rayleigh %s\ninitial A:1 -velocity 1\n" STEP "duration 1\n", ratios[i]);
        char message[128];
        snprintf(message, sizeof message,
                 "Rayleigh coefficient %s is negative: some modes of building A gain energy",
                 negative[i]);
        assert_string_equal(m->deck->diagnostics.item[0].message, message);
        model_free(m);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(buildings_with_the_same_motions_share_a_ground),
        cmocka_unit_test(a_building_without_a_motion_is_at_rest),
        cmocka_unit_test(a_sine_has_amplitude_frequency_phase_delay_and_cycles),
        cmocka_unit_test(a_record_is_scaled_delayed_and_converted),
        cmocka_unit_test(a_pga_scales_the_largest_absolute_value_and_keeps_the_sign),
        cmocka_unit_test(values_at_many_times_are_those_at_each),
        cmocka_unit_test(values_next_to_samples_are_those_at_each),
        cmocka_unit_test(gravity_sets_the_unit_g_of_records),
        cmocka_unit_test(the_longest_motion_sets_the_duration),
        cmocka_unit_test(loads_act_on_the_floors_named),
        cmocka_unit_test(the_initial_state_is_that_of_the_floors_named),
        cmocka_unit_test(the_last_step_ends_at_the_duration),
        cmocka_unit_test(rows_are_0_01_s_apart_unless_told_otherwise),
        cmocka_unit_test(output_chooses_fields_precision_and_file),
        cmocka_unit_test(integrator_and_newton_have_defaults),
        cmocka_unit_test(a_step_just_below_the_limit_of_stability_is_taken),
        cmocka_unit_test(parameters_and_expressions_reach_the_model),
        cmocka_unit_test(a_define_overrides_a_parameter),
        cmocka_unit_test(grounds_that_part_by_more_than_the_gap_are_warned_about),
        cmocka_unit_test(what_moves_nothing_or_skips_samples_is_warned_about),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
