// SPDX-License-Identifier: GPL-3.0-or-later
// Gaps: closing displacements of motions in closed form, their percentiles, and searches for a gap
// whose threshold is known.
#include <math.h>
#include <string.h>

#include "study/contact_free.h"
#include "study/gap_search.h"
#include "support/analysis.h"
#include "support/support.h"

// Undamped oscillators let go: u = a cos(2 pi t / T). By adaptive steps, whose peaks are located
// between steps; with a tolerance of 1e-10 a step, the motion errs by some 1e-8.
static const double RTOL = 1e-6;

// A of 1 s from 0.1 and B of 0.5 s from 0.05.
#define TWO                                                                                        \
    "building A -floors 1 -mass 1 -stiffness ${4 * pi^2}\n"                                        \
    "building B -floors 1 -mass 1 -stiffness ${16 * pi^2}\n"                                       \
    "initial A -displacement 0.1\n"                                                                \
    "initial B -displacement 0.05\n"
#define STEPS "integrator dormand-prince\nstep adaptive -tolerance 1e-10\nduration 3\n"

static struct plan plan_of(const struct model *m) {
    return (struct plan){.first = m, .n_run = m->deck->n_run};
}

static void run_contact_free(const struct model *m, int n_thread, struct contact_free *a) {
    struct error e;
    const struct plan p = plan_of(m);
    const struct gap_runs how = {.n_thread = n_thread};
    static const struct separation_site site = {.metre = 1.0};
    assert_int_equal(contact_free_run(&p, &how, &site, a, &e), STATUS_OK);
}

static void closing_displacements_are_those_of_the_closed_form(void **state) {
    (void)state;
    struct model *m = analysis_model(TWO "contact A B -gap 0.06 -law linear -k 1e4\n"
                                         "contact A wall -gap 0.2 -law linear -k 1e4\n" STEPS);
    struct contact_free a;
    run_contact_free(m, 1, &a);
    assert_int_equal(a.n_failed, 0);
    const double *pair = contact_free_values(&a, 0, 0), *wall = contact_free_values(&a, 0, 1);
    // f = a cos x - b cos 2x is largest where cos x = a / (4 b): a^2 / (8 b) + b
    assert_close(pair[FREE_CLOSING], 0.01 / 0.4 + 0.05, RTOL);
    assert_close(pair[FREE_GAP], 0.06, 1e-15);
    assert_close(pair[FREE_LEFT], 0.1, RTOL);
    assert_close(pair[FREE_RIGHT], 0.05, RTOL);
    assert_close(pair[FREE_PERIOD_LEFT], 1.0, 1e-13);
    assert_close(pair[FREE_PERIOD_RIGHT], 0.5, 1e-13);
    assert_true(pair[FREE_RHO] == 0.0);  // undamped
    assert_close(pair[FREE_RULE], 0.15, RTOL);
    assert_close(pair[FREE_RULE + 1], hypot(0.1, 0.05), RTOL);
    assert_int_equal(contact_free_hits(&a, 0), 1);
    assert_close(wall[FREE_CLOSING], 0.1, RTOL);
    assert_close(wall[FREE_RULE + 3], 0.1, RTOL);
    assert_true(isnan(wall[FREE_PERIOD_RIGHT]));
    assert_int_equal(contact_free_hits(&a, 1), 0);
    contact_free_close(&a);
    model_free(m);
}

// Both buildings joined by a spring so stiff that they move as one do not close.
static void links_act_although_contacts_do_not(void **state) {
    (void)state;
    struct model *m = analysis_model("building A -floors 1 -mass 1 -stiffness 40\n"
                                     "building B -floors 1 -mass 1 -stiffness 160\n"
                                     "initial A -velocity 1\n"
                                     "initial B -velocity 1\n"
                                     "link A B -stiffness 1e8\n"
                                     "contact A B -gap 0.01 -law linear -k 1e4\n"
                                     "step adaptive\nduration 3\n");
    struct contact_free a;
    run_contact_free(m, 1, &a);
    assert_true(contact_free_values(&a, 0, 0)[FREE_CLOSING] < 1e-5);
    assert_true(contact_free_values(&a, 0, 0)[FREE_LEFT] > 0.05);
    contact_free_close(&a);
    model_free(m);
}

// Runs of a sweep whose closing displacements are 0.1 ... 0.5.
static const char five[] = "sweep a values 0.3 0.1 0.5 0.2 0.4\n"
                           "building A -floors 1 -mass 1 -stiffness ${4 * pi^2}\n"
                           "initial A -displacement ${-a}\n"
                           "contact A wall -gap 0.25 -law linear -k 1e4\n" STEPS;

static void percentiles_are_over_the_runs(void **state) {
    (void)state;
    struct model *m = analysis_model("%s", five);
    struct contact_free a, other;
    double scratch[5];
    run_contact_free(m, 1, &a);
    const struct contact_free_summary s =
        contact_free_summarise(&a, 0, FREE_CLOSING, FREE_VALUES, scratch);
    assert_close(s.mean, 0.3, RTOL);
    // Between sorted values, at 4 p of their numbers from 0.
    assert_close(s.low, 0.1 + 0.64 * 0.1, RTOL);
    assert_close(s.median, 0.3, RTOL);
    assert_close(s.high, 0.4 + 0.36 * 0.1, RTOL);
    assert_close(s.largest, 0.5, RTOL);
    assert_int_equal(s.run, 2);
    assert_int_equal(contact_free_hits(&a, 0), 3);
    const struct contact_free_summary ratio =
        contact_free_summarise(&a, 0, FREE_RULE, FREE_CLOSING, scratch);
    assert_close(ratio.mean, 1.0, RTOL);
    run_contact_free(m, 3, &other);
    assert_memory_equal(a.value, other.value, (size_t)5 * FREE_VALUES * sizeof *a.value);
    contact_free_close(&other);
    contact_free_close(&a);
    model_free(m);
}

// Without contact the gap is nothing; each run counts as often as it differs.
static void sweeps_that_change_nothing_count_once(void **state) {
    (void)state;
    struct model *m = analysis_model("sweep a values 0.1 0.2 0.4\n"
                                     "sweep gap values 0.11 0.15 0.3 0.5\n"
                                     "building A -floors 1 -mass 1 -stiffness ${4 * pi^2}\n"
                                     "initial A -displacement ${-a}\n"
                                     "contact A wall -gap $gap -law linear -k 1e4\n" STEPS);
    struct contact_free a;
    double scratch[12];
    run_contact_free(m, 1, &a);
    assert_int_equal(a.n_run, 12);
    assert_true(a.counts[4] && !a.counts[5]);
    assert_false(a.idle[0]);
    assert_true(a.idle[1]);
    const struct contact_free_summary s =
        contact_free_summarise(&a, 0, FREE_CLOSING, FREE_VALUES, scratch);
    assert_close(s.mean, 0.7 / 3, RTOL);
    assert_close(s.low, 0.1 + 0.32 * 0.1, RTOL);
    assert_int_equal(s.run, 8);
    assert_close(contact_free_summarise(&a, 0, FREE_GAP, FREE_VALUES, scratch).mean, 1.06 / 4,
                 1e-14);
    // 0.2 is beyond 0.11 and 0.15, 0.4 beyond 0.3, too
    assert_int_equal(contact_free_hits(&a, 0), 5);
    contact_free_close(&a);
    model_free(m);
}

static int try_search(const struct model *m, const char *edp, struct gap_search_request q,
                      struct gap_search *out, struct error *e) {
    const struct gap_runs how = {.n_thread = 2};
    const struct study_request study = {.first = m, .result = {.version = ""}};
    struct plan p;
    assert_int_equal(plan_init(&p, &study, e), STATUS_OK);
    const struct study_view view = plan_view(&p);
    assert_int_equal(edp_parse(&view, edp, p.table->arena, &q.edp, e), STATUS_OK);
    q.plan = &p;
    const int status = gap_search_run(&q, &how, out, e);
    plan_close(&p);
    return status;
}

static struct gap_search search(const struct model *m, const char *edp,
                                struct gap_search_request q) {
    struct gap_search s;
    struct error e;
    assert_int_equal(try_search(m, edp, q, &s, &e), STATUS_OK);
    return s;
}

static struct gap_search_request up_to_zero(double percentile, const char *parameter) {
    return (struct gap_search_request){.parameter = parameter,
                                       .limit = 0.0,
                                       .percentile = percentile,
                                       .from = 0.0,
                                       .to = 0.6,
                                       .n = 8,
                                       .tolerance = 1e-4};
}

// A swing to 0.5 hits if and only if the gap is below 0.5; the median one if below 0.3.
static void bisection_finds_a_threshold_that_is_known(void **state) {
    (void)state;
    struct model *m = analysis_model("%s", five);
    struct gap_search s = search(m, "impacts", up_to_zero(100.0, NULL));
    assert_true(s.found);
    assert_true(s.gap >= 0.5 - 1e-6 && s.below <= 0.5 + 1e-6 && s.gap - s.below <= 1e-4);
    assert_int_equal(s.point[0].stage, GAP_SCAN);
    assert_true(s.point[7].gap == 0.6 && s.point[7].kept && !s.point[0].kept);
    gap_search_close(&s);
    s = search(m, "impacts", up_to_zero(50.0, NULL));
    assert_true(s.gap >= 0.3 - 1e-6 && s.below <= 0.3 + 1e-6 && s.gap - s.below <= 1e-4);
    gap_search_close(&s);
    model_free(m);
}

static void a_parameter_of_the_deck_can_be_the_gap(void **state) {
    (void)state;
    struct model *m = analysis_model("param half 0.1\n"
                                     "building A -floors 1 -mass 1 -stiffness ${4 * pi^2}\n"
                                     "initial A -displacement -0.5\n"
                                     "contact A wall -gap ${2 * half} -law linear -k 1e4\n" STEPS);
    struct gap_search s = search(m, "impacts", up_to_zero(100.0, "half"));
    assert_true(s.gap >= 0.25 - 1e-6 && s.below <= 0.25 + 1e-6);
    gap_search_close(&s);
    struct error e;
    assert_int_equal(try_search(m, "impacts", up_to_zero(100.0, "gap"), &s, &e), STATUS_INPUT);
    assert_non_null(strstr(e.message, "gap"));
    gap_search_close(&s);
    model_free(m);
}

static void a_limit_that_no_gap_keeps_is_not_found(void **state) {
    (void)state;
    struct model *m = analysis_model("%s", five);
    struct gap_search_request q = up_to_zero(100.0, NULL);
    q.limit = 0.45;
    struct gap_search s = search(m, "displacement:A:1", q);
    assert_false(s.found);
    assert_true(s.opened && !s.open.kept);
    assert_close(s.open.value, 0.5, RTOL);  // the largest swing, which no gap makes smaller
    assert_int_equal(s.n_point, q.n);
    gap_search_close(&s);
    q.limit = 10.0;
    s = search(m, "displacement", q);
    assert_true(s.found && s.gap == 0.0 && isnan(s.below));
    gap_search_close(&s);
    model_free(m);
}

// B stands 0.05 nearer to A than the gap of 0 allows: such runs fail, and keep no limit.
static void gaps_that_are_closed_at_the_start_fail(void **state) {
    (void)state;
    struct model *m = analysis_model(TWO "contact A B -gap 0.06 -law linear -k 1e4\n" STEPS);
    struct gap_search s = search(m, "impacts", up_to_zero(100.0, NULL));
    assert_int_equal(s.point[0].n_failed, 1);
    assert_false(s.point[0].kept);
    assert_non_null(strstr(s.point[0].message, "closed at t = 0"));
    assert_true(s.gap >= 0.075 - 1e-6 && s.below <= 0.075 + 1e-6);
    gap_search_close(&s);
    model_free(m);
}

static void demands_without_a_value_are_refused(void **state) {
    (void)state;
    struct model *m = analysis_model("%s", five);
    struct gap_search s;
    struct error e;
    assert_int_equal(try_search(m, "drift-ratio", up_to_zero(100.0, NULL), &s, &e), STATUS_INPUT);
    assert_string_equal(e.message, "drift-ratio: the deck gives no height of storey A:1");
    gap_search_close(&s);
    model_free(m);
}

// The values of a run stand where those of the first one do.
static void a_parameter_must_not_change_the_shape_of_the_model(void **state) {
    (void)state;
    struct model *m = analysis_model("param gap 0m\n"
                                     "building A -floors ${1 + gap / 1m} -mass 1 -stiffness 40\n"
                                     "initial A -velocity 0.1\n"
                                     "contact A:1 wall -gap $gap -law linear -k 1e4\n" STEPS);
    struct gap_search_request q = up_to_zero(100.0, "gap");
    struct gap_search s;
    struct error e;
    q.to = 1.0;
    q.n = 2;
    assert_int_equal(try_search(m, "impacts", q, &s, &e), STATUS_INPUT);
    assert_non_null(strstr(e.message, "floors in building A, the first run has 1"));
    gap_search_close(&s);
    model_free(m);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(closing_displacements_are_those_of_the_closed_form),
        cmocka_unit_test(links_act_although_contacts_do_not),
        cmocka_unit_test(percentiles_are_over_the_runs),
        cmocka_unit_test(sweeps_that_change_nothing_count_once),
        cmocka_unit_test(bisection_finds_a_threshold_that_is_known),
        cmocka_unit_test(a_parameter_of_the_deck_can_be_the_gap),
        cmocka_unit_test(a_limit_that_no_gap_keeps_is_not_found),
        cmocka_unit_test(gaps_that_are_closed_at_the_start_fail),
        cmocka_unit_test(demands_without_a_value_are_refused),
        cmocka_unit_test(a_parameter_must_not_change_the_shape_of_the_model),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
