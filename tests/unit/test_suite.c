// SPDX-License-Identifier: GPL-3.0-or-later
// Demand parameters by name, and how the runs of a study are arranged for statistics.
#include <gsl/gsl_errno.h>
#include <math.h>
#include <string.h>

#include "core/arena.h"
#include "jostle/result.h"
#include "study/fragility_runs.h"
#include "study/suite.h"
#include "support/suite.h"
#include "support/support.h"

// Rows of a hundredth of a radian and Newmark's period miss a peak by 1e-4 at most.
static const double PEAK = 1e-4;

static struct suite *arranged(struct study_file *f, struct suite_request q) {
    struct suite *s;
    struct error e = {.message = ""};
    if (suite_create(f, &q, &s, &e) != STATUS_OK) {
        fail_msg("%s", e.message);
    }
    return s;
}

static void refused(struct study_file *f, struct suite_request q, const char *message) {
    struct suite *s;
    struct error e;
    assert_int_equal(suite_create(f, &q, &s, &e), STATUS_INPUT);
    if (!strstr(e.message, message)) {
        fail_msg("'%s' is not in '%s'", message, e.message);
    }
}

static void runs_are_arranged_by_ascending_intensity_and_sample(void **state) {
    (void)state;
    struct study_file *f = suite_ran(suite_oscillators);
    struct suite *s = arranged(f, (struct suite_request){.over = "k"});
    static const double k[] = {2500, 100, 400, 900, 1600};
    assert_string_equal(s->abscissa->name, "im");
    assert_string_equal(s->edp.text, "drift");
    assert_string_equal(s->over, "k");
    assert_true(s->is_intensity);
    assert_true(s->n_point == 3 && s->n_sample == 5 && s->n_group == 1 && s->n_run == 15);
    for (int j = 0; j < 3; j++) {
        assert_close(s->point[j], j + 1.0, 0);
        for (int i = 0; i < 5; i++) {
            if (i != 1 || j < 2) {
                assert_close(suite_value(s, 0, i, j), (j + 1.0) / sqrt(k[i]), PEAK);
            }
        }
    }
    assert_string_equal(s->sample[1], "k 100");
    suite_free(s);
    study_file_close(f);
}

static void failed_runs_are_named_and_count_as_asked_for(void **state) {
    (void)state;
    struct study_file *f = suite_ran(suite_oscillators);
    struct suite *s = arranged(f, (struct suite_request){.over = "k"});
    double work[5];
    assert_int_equal(s->n_failed, 1);
    assert_non_null(strstr(s->failed[0], "run 4 (k = 100, im = 3): "));
    assert_non_null(strstr(s->failed[0], "gap is"));
    assert_true(isinf(suite_value(s, 0, 1, 2)));
    assert_int_equal(suite_samples(s, 0, 2, work), 5);
    // 3 / 50, 3 / 40, 3 / 30, 3 / 20, failed: the median is the third, 84 % reaches the failed one.
    assert_close(suite_percentile(s, 0, 2, 0.5, work), 0.1, PEAK);
    assert_true(isinf(suite_percentile(s, 0, 2, 0.84, work)));
    suite_free(s);
    s = arranged(f, (struct suite_request){.over = "k", .failed = SUITE_FAILED_LEFT_OUT});
    assert_int_equal(s->n_failed, 1);
    assert_true(isnan(suite_value(s, 0, 1, 2)));
    assert_int_equal(suite_samples(s, 0, 2, work), 4);
    assert_close(suite_percentile(s, 0, 2, 0.5, work), (0.075 + 0.1) / 2, PEAK);
    assert_close(suite_percentile(s, 0, 2, 1.0, work), 0.15, PEAK);
    suite_free(s);
    study_file_close(f);
}

// Records are samples also where a factor goes together with each, and texts that stand twice
// choose nothing.
static void what_goes_together_plays_one_part(void **state) {
    (void)state;
    struct study_file *f = suite_ran("sweep k values 2500 100 400 -as specimen\n"
                                     "sweep im values 3 1\n"
                                     "sweep record values a b a -as specimen\n"
                                     "title \"$record\"\n"
                                     "building A -floors 1 -mass 1 -stiffness $k\n"
                                     "initial A:1 -velocity $im\n"
                                     "step fixed 0.0005\n"
                                     "duration 1\n");
    const char *at[] = {"im=1", "record=b", "record=a"};
    struct suite *s = arranged(f, (struct suite_request){.edp = "drift"});
    assert_string_equal(s->over, "specimen");
    assert_true(s->n_point == 2 && s->n_sample == 3 && s->n_group == 1);
    assert_string_equal(s->sample[1], "specimen 2 (k 100, record b)");
    assert_close(suite_value(s, 0, 1, 1), 3.0 / 10.0, PEAK);
    suite_free(s);
    s = arranged(f,
                 (struct suite_request){.abscissa = "specimen", .over = "", .at = at, .n_at = 1});
    assert_true(s->n_point == 3 && s->n_group == 1);
    assert_string_equal(s->point_name[2], "3: 400, a");
    assert_non_null(s->mixed);
    suite_free(s);
    s = arranged(f, (struct suite_request){.at = at + 1, .n_at = 1, .edp = "drift"});
    assert_string_equal(s->fixed, "specimen = 2 (k = 100, record = b)");
    assert_close(suite_value(s, 0, 0, 0), 1.0 / 10.0, PEAK);
    suite_free(s);
    s = arranged(f, (struct suite_request){.abscissa = "k", .edp = "drift"});
    assert_true(s->point[0] == 100 && s->n_group == 2 && !s->point_name);
    assert_non_null(s->mixed);
    suite_free(s);
    s = arranged(f, (struct suite_request){.over = "k"});
    assert_string_equal(s->over, "specimen");
    suite_free(s);
    refused(f, (struct suite_request){.at = at + 2, .n_at = 1},
            "--at record=a: this occurs more than once; give a number of 'specimen'");
    study_file_close(f);
}

static void sweeps_play_the_parts_they_are_given(void **state) {
    (void)state;
    struct study_file *f = suite_ran(suite_oscillators);
    const char *at[] = {"im=1.0", "k=400"};
    struct suite *s = arranged(f, (struct suite_request){.abscissa = "k", .at = at, .n_at = 1});
    assert_true(s->n_point == 5 && s->n_sample == 1 && s->n_group == 1 && s->n_failed == 0);
    assert_string_equal(s->fixed, "im = 1");
    assert_false(s->is_intensity);
    for (int j = 0; j < 5; j++) {
        assert_close(s->point[j], 100.0 * (j + 1) * (j + 1), 0);
        assert_close(suite_value(s, 0, 0, j), 0.1 / (j + 1), PEAK);
    }
    suite_free(s);
    s = arranged(f, (struct suite_request){.abscissa = "im"});
    assert_true(s->n_sample == 1 && s->n_group == 5);
    assert_string_equal(s->group[4], "k = 1600");
    assert_close(suite_value(s, 4, 0, 1), 2.0 / 40.0, PEAK);
    suite_free(s);
    refused(f, (struct suite_request){.abscissa = "in"}, "no sweep 'in'; there are k, im");
    refused(f, (struct suite_request){.over = "k,g"}, "no sweep 'g'");
    refused(f, (struct suite_request){.over = "k", .abscissa = "k"}, "two different parts");
    refused(f, (struct suite_request){.at = at + 1, .n_at = 1, .over = "im"}, "no sweep 'im'");
    at[0] = "im=1.5";
    refused(f, (struct suite_request){.at = at, .n_at = 1}, "'im' has 3 values, from 3 to 2");
    at[0] = "im=1m";
    refused(f, (struct suite_request){.at = at, .n_at = 1}, "'im' has 3 values");
    at[0] = "im";
    refused(f, (struct suite_request){.at = at, .n_at = 1}, "--at takes NAME=VALUE");
    study_file_close(f);
}

// An oscillator of mass 1 that starts with the velocity v reaches v / omega, omega v and k v /
// omega.
static void demands_on_an_oscillator_are_those_of_the_closed_form(void **state) {
    (void)state;
    struct study_file *f = suite_ran(suite_oscillators);
    static const struct {
        const char *edp;
        double value;  // of v = 2 and k = 400
    } demand[] = {
        {"displacement", 0.1}, {"velocity", 2.0},      {"acceleration", 40.0},
        {"drift", 0.1},        {"storey-shear", 40.0},
    };
    for (size_t i = 0; i < sizeof demand / sizeof demand[0]; i++) {
        struct suite *s = arranged(f, (struct suite_request){.edp = demand[i].edp, .over = "k"});
        assert_close(suite_value(s, 0, 2, 1), demand[i].value, PEAK);
        suite_free(s);
    }
    study_file_close(f);
}

// Of v = 1: drifts of 1/50, 1/10, 1/20, 1/30 and 1/40. Of v = 3 the run of k = 100 failed.
static void runs_at_the_limit_do_not_exceed_it(void **state) {
    (void)state;
    struct study_file *f = suite_ran(suite_oscillators);
    struct suite *s = arranged(f, (struct suite_request){.over = "k"});
    struct fragility_level level[15];
    struct fragility_runs runs;
    struct error e;
    assert_int_equal(fragility_runs_create(s, &runs, &e), STATUS_OK);
    fragility_runs_take(&runs, s, 0);
    assert_int_equal(fragility_runs_count(&runs, suite_value(s, 0, 3, 0), NULL, level), 3);
    assert_true(level[0].n == 5 && level[0].exceeded == 2);
    assert_true(level[2].n == 5 && level[2].exceeded == 5);
    suite_free(s);
    s = arranged(f, (struct suite_request){.over = "k", .failed = SUITE_FAILED_LEFT_OUT});
    assert_int_equal(fragility_runs_create(s, &runs, &e), STATUS_OK);
    fragility_runs_take(&runs, s, 0);
    assert_int_equal(fragility_runs_count(&runs, suite_value(s, 0, 3, 0), NULL, level), 3);
    assert_true(level[2].n == 4 && level[2].exceeded == 4);
    suite_free(s);
    study_file_close(f);
}

static const char pairs[] = "units kN m s\n"
                            "sweep sa values 1m/s^2 2m/s^2\n"
                            "building A -floors 2 -mass 100t -stiffness 50MN/m -height 4 2\n"
                            "building B -floors 3 -mass 80t -stiffness 20MN/m -height 3\n"
                            "contact A B -gap 1mm -law linear -k 1e5\n"
                            "link A:1 B:1 -dashpot 100 -name damper\n"
                            "link A:2 B:2 -stiffness 100 -name spring\n"
                            "ground sine -amplitude $sa -frequency 2 -cycles 4\n"
                            "step fixed 2ms\n";

static double value_of(struct study_file *f, const char *edp) {
    struct suite *s = arranged(f, (struct suite_request){.edp = edp});
    const double value = suite_value(s, 0, 0, 1);
    suite_free(s);
    return value;
}

static void demands_are_the_largest_or_the_sum_of_the_places_named(void **state) {
    (void)state;
    struct study_file *f = suite_ran(pairs);
    const double a1 = value_of(f, "drift:A:1"), a2 = value_of(f, "drift:A:2");
    assert_close(value_of(f, "drift:A"), fmax(a1, a2), 0);
    assert_close(value_of(f, "drift"), fmax(value_of(f, "drift:A"), value_of(f, "drift:B")), 0);
    assert_close(value_of(f, "drift-ratio:A:1"), a1 / 4.0, 0);
    assert_close(value_of(f, "drift-ratio:A"), fmax(a1 / 4.0, a2 / 2.0), 0);
    assert_close(value_of(f, "drift_ratio:A"), fmax(a1 / 4.0, a2 / 2.0), 0);
    const double one = value_of(f, "force:A:1-B:1"), two = value_of(f, "force:A:2-B:2");
    assert_true(one > 0 && two > 0);
    assert_close(value_of(f, "force"), fmax(one, two), 0);
    assert_close(value_of(f, "impacts"),
                 value_of(f, "impacts:A:1-B:1") + value_of(f, "impacts:A:2-B:2"), 0);
    assert_close(value_of(f, "impulse"),
                 value_of(f, "impulse:A:1-B:1") + value_of(f, "impulse:A:2-B:2"), 0);
    const double damper = value_of(f, "link-force:damper"),
                 spring = value_of(f, "link-force:spring");
    assert_close(value_of(f, "link-force"), fmax(damper, spring), 0);
    assert_close(100.0 * value_of(f, "link-deformation:spring"), spring, 1e-14);
    assert_close(value_of(f, "link-work"),
                 value_of(f, "link-work:damper") + value_of(f, "link-work:spring"), 0);
    assert_true(value_of(f, "link-work:damper") > 0 && value_of(f, "dissipated") >= 0);
    assert_close(value_of(f, "hysteretic"), 0, 0);
    struct suite *s = arranged(f, (struct suite_request){.edp = NULL});
    assert_string_equal(s->edp.text, "drift-ratio");
    suite_free(s);
    study_file_close(f);
}

static void demands_that_are_not_there_say_what_is(void **state) {
    (void)state;
    struct study_file *f = suite_ran(pairs);
    static const struct {
        const char *edp, *message;
    } cases[] = {
        {"drfit", "unknown EDP 'drfit'; did you mean 'drift'?"},
        {"", "unknown EDP ''"},
        {"nothing:A", "unknown EDP 'nothing'; jostle fragility --help lists them"},
        {"drift:", "unknown building; available: A, B"},
        {"drift:C:1", "unknown building; available: A, B"},
        {"drift:AB", "unknown building; available: A, B"},
        {"drift:A:3", "building A has 2 floors"},
        {"drift:A:0", "a floor is a number from 1"},
        {"drift:A:1x", "a floor is a number from 1"},
        {"drift:A:99999999999999999999", "building A has 2 floors"},
        {"force:A", "unknown contact; 2 available: A:1-B:1 ... A:2-B:2"},
        {"link-force:A", "unknown link; 2 available: damper ... spring"},
        {"hysteretic:A", "one number for the whole"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        refused(f, (struct suite_request){.edp = cases[i].edp}, cases[i].message);
    }
    study_file_close(f);
    f = suite_ran(suite_oscillators);
    refused(f, (struct suite_request){.edp = "drift-ratio"}, "gives no height of storey A:1");
    refused(f, (struct suite_request){.edp = "link-force"}, "there is no link");
    study_file_close(f);
}

// A rigid contact has an impulse in place of a force: its runs have not failed.
static void the_force_of_rigid_contacts_is_no_demand(void **state) {
    (void)state;
    struct study_file *f = suite_ran("sweep im values 1 2\n"
                                     "building A -floors 1 -mass 3 -stiffness 0\n"
                                     "contact A wall -gap 0.1 -law stereomechanical -e 0.5\n"
                                     "initial A:1 -velocity $im\n"
                                     "step fixed 0.01\nduration 1\n");
    refused(f, (struct suite_request){.edp = "force"},
            "force: A:1-wall is rigid: it has an impulse, but no force");
    struct suite *s = arranged(f, (struct suite_request){.edp = "impulse"});
    assert_true(s->n_failed == 0);
    assert_close(suite_value(s, 0, 0, 1), 3.0 * 1.5 * 2.0, 1e-12);  // m (1 + e) v
    suite_free(s);
    study_file_close(f);
}

// The storey or contact left out could be the one that counts.
static void a_demand_leaves_no_place_out(void **state) {
    (void)state;
    struct study_file *f = suite_ran("sweep im values 1 2\n"
                                     "building A -floors 1 -mass 3 -stiffness 40 -height 4\n"
                                     "building B -floors 1 -mass 3 -stiffness 10\n"
                                     "contact A B -gap 9 -law linear -k 1\n"
                                     "contact B wall -gap 0.1 -law stereomechanical -e 0.5\n"
                                     "initial B:1 -velocity $im\n"
                                     "step fixed 0.01\nduration 1\n");
    refused(f, (struct suite_request){.edp = "drift-ratio"}, "no height of storey B:1");
    refused(f, (struct suite_request){.edp = "force"}, "force: B:1-wall is rigid");
    static const char *const there[] = {"drift-ratio:A", "force:A:1-B:1", "impacts"};
    for (int i = 0; i < 3; i++) {
        struct suite *s = arranged(f, (struct suite_request){.edp = there[i]});
        assert_true(s->n_failed == 0);
        suite_free(s);
    }
    struct suite *s = arranged(f, (struct suite_request){.edp = NULL});
    assert_string_equal(s->edp.text, "drift");
    suite_free(s);
    study_file_close(f);
}

static void limits_have_the_dimension_of_their_demand(void **state) {
    (void)state;
    struct study_file *f = suite_ran(pairs);
    struct suite *s = arranged(f, (struct suite_request){.edp = "force"});
    const struct unit_system *u = &s->view->units;
    struct error e;
    double limit;
    assert_int_equal(edp_limit(&s->edp, u, "2MN", &limit, &e), STATUS_OK);
    assert_close(limit, 2000.0, 0);
    assert_int_equal(edp_limit(&s->edp, u, "2.5", &limit, &e), STATUS_OK);
    assert_close(limit, 2.5, 0);
    assert_int_equal(edp_limit(&s->edp, u, "2mm", &limit, &e), STATUS_INPUT);
    assert_string_equal(e.message, "limit 2mm is a length; force needs a force (kN)");
    assert_int_equal(edp_limit(&s->edp, u, "-2MN", &limit, &e), STATUS_INPUT);
    assert_string_equal(e.message, "limit -2MN is below 0, where force never is");
    assert_int_equal(edp_limit(&s->edp, u, "2MN!", &limit, &e), STATUS_INPUT);
    assert_int_equal(edp_limit(&s->edp, u, "many", &limit, &e), STATUS_INPUT);
    assert_int_equal(edp_limit(&s->edp, u, "1e308MN", &limit, &e), STATUS_INPUT);
    suite_free(s);
    s = arranged(f, (struct suite_request){.edp = "drift-ratio"});
    assert_int_equal(edp_limit(&s->edp, u, "2%", &limit, &e), STATUS_OK);
    assert_close(limit, 0.02, 1e-15);
    suite_free(s);
    s = arranged(f, (struct suite_request){.edp = "penetration"});
    assert_int_equal(edp_limit(&s->edp, u, "-2mm", &limit, &e), STATUS_OK);
    assert_close(limit, -0.002, 1e-15);
    suite_free(s);
    s = arranged(f, (struct suite_request){.edp = "acceleration"});
    assert_int_equal(edp_limit(&s->edp, u, "0.5g", &limit, &e), STATUS_OK);
    assert_close(limit, 0.5 * 9.80665, 1e-15);
    suite_free(s);
    study_file_close(f);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(runs_are_arranged_by_ascending_intensity_and_sample),
        cmocka_unit_test(failed_runs_are_named_and_count_as_asked_for),
        cmocka_unit_test(what_goes_together_plays_one_part),
        cmocka_unit_test(sweeps_play_the_parts_they_are_given),
        cmocka_unit_test(demands_on_an_oscillator_are_those_of_the_closed_form),
        cmocka_unit_test(runs_at_the_limit_do_not_exceed_it),
        cmocka_unit_test(demands_are_the_largest_or_the_sum_of_the_places_named),
        cmocka_unit_test(demands_that_are_not_there_say_what_is),
        cmocka_unit_test(the_force_of_rigid_contacts_is_no_demand),
        cmocka_unit_test(a_demand_leaves_no_place_out),
        cmocka_unit_test(limits_have_the_dimension_of_their_demand),
    };
    gsl_set_error_handler_off();
    return cmocka_run_group_tests(tests, NULL, NULL);
}
