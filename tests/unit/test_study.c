// SPDX-License-Identifier: GPL-3.0-or-later
// Studies from the library: the order of the runs, boxes over them, and the file.
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "jostle/study.h"
#include "jostle/study_file.h"
#include "result/study_sweep.h"
#include "study/plan.h"
#include "support/analysis.h"
#include "support/suite.h"
#include "support/support.h"

static const char text[] = "sweep k values 100 400 900 1600\n"
                           "sweep v range 1 3 3\n"
                           "building A -floors 1 -mass 1 -stiffness $k\n"
                           "initial A:1 -velocity $v\n"
                           "step fixed 0.0005\n"
                           "duration 1\n";

static struct model *build(const char *deck_text) {
    struct deck *d;
    struct model *m;
    struct error e;
    const char *path = support_write("study.deck", deck_text);
    assert_int_equal(deck_open(path, NULL, 0, &d, &e), STATUS_OK);
    assert_int_equal(model_build(d, &m, &e), STATUS_OK);
    return m;
}

static void the_last_sweep_varies_fastest(void **state) {
    (void)state;
    struct model *m = build(text);
    struct plan p;
    struct error e;
    struct plan_text t;
    const struct study_request q = {.first = m, .result = {.path = "a.h5", .version = "1"}};
    assert_int_equal(plan_init(&p, &q, &e), STATUS_OK);
    assert_int_equal(p.n_run, 12);
    for (long run = 0; run < 12; run++) {
        int choice[STUDY_SWEEPS_MAX];
        plan_choose(&p, run, choice);
        assert_int_equal(choice[0], run / 3);
        assert_int_equal(choice[1], run % 3);
    }
    assert_string_equal(plan_describe(&p, 4, &t), "run 5 (k = 400, v = 2)");
    plan_close(&p);
    model_free(m);
}

// Boxes of any capacity cover the runs one after the other.
static void boxes_cover_all_runs_in_order(void **state) {
    (void)state;
    static const int sizes[][3] = {{1, 1, 1}, {5, 1, 1}, {2, 3, 4}, {4, 1, 5}, {3, 7, 2}};
    for (size_t k = 0; k < sizeof sizes / sizeof sizes[0]; k++) {
        struct sweep s[3];
        const struct sweep *sweep[3] = {&s[0], &s[1], &s[2]};
        long n_run = 1;
        for (int i = 0; i < 3; i++) {
            s[i] = (struct sweep){.n = sizes[k][i]};
            n_run *= s[i].n;
        }
        for (long capacity = 1; capacity <= n_run + 1; capacity++) {
            long first = 0;
            while (first < n_run) {
                const struct h5_box box = study_sweep_box(sweep, 3, first, capacity);
                const hsize_t *a = box.start, *n = box.count;
                assert_int_equal((long)((a[0] * (hsize_t)s[1].n + a[1]) * (hsize_t)s[2].n + a[2]),
                                 first);
                assert_int_equal(n[0] * n[1] * n[2], box.n);
                assert_true(n[2] == 1 || n[2] == (hsize_t)s[2].n || n[0] * n[1] == 1);
                assert_true(n[1] == 1 || n[2] == (hsize_t)s[2].n);
                assert_true(n[0] == 1 || n[1] == (hsize_t)s[1].n);
                assert_in_range(box.n, 1, capacity);
                first += (long)box.n;
            }
            assert_int_equal(first, n_run);
        }
    }
}

static int item_of(const struct study_view *v, const char *name) {
    for (int i = 0; i < v->table.n_item; i++) {
        if (strcmp(v->table.item[i].name, name) == 0) {
            return i;
        }
    }
    fail_msg("there is no %s", name);
    return -1;
}

// A free oscillator with initial velocity v: the largest displacement is v / omega. The step of a
// hundredth of a radian and the largest row miss it by 1e-4 at most.
static void each_value_of_the_file_is_that_of_its_run(void **state) {
    (void)state;
    static const double k[] = {100, 400, 900, 1600};
    struct model *m = build(text);
    const char *path = support_path("study.h5");
    const struct study_request q = {
        .first = m, .n_thread = 3, .result = {.path = path, .version = "1"}};
    struct study_progress p;
    struct study_file *f;
    struct error e;
    assert_int_equal(study_run(&q, &p, &e), STATUS_OK);
    assert_true(p.n_run == 12 && p.n_done == 12 && p.n_failed == 0 && p.n_kept == 0);
    assert_true(study_file_is_study(path));
    assert_int_equal(study_file_open(path, &f, &e), STATUS_OK);
    const struct study_view *v = study_file_view(f);
    assert_int_equal(v->n_sweep, 2);
    assert_string_equal(v->sweep[1]->name, "v");
    assert_int_equal(v->n_run, 12);
    const size_t at = v->table.item[item_of(v, "displacement")].first;
    double *value = malloc(12 * v->table.n_value * sizeof *value);
    struct study_outcome outcome[12];
    assert_non_null(value);
    assert_int_equal(study_file_read(f, 0, 12, outcome, value, &e), STATUS_OK);
    for (int run = 0; run < 12; run++) {
        assert_int_equal(outcome[run].status, STUDY_DONE);
        assert_close(value[(size_t)run * v->table.n_value + at], (run % 3 + 1) / sqrt(k[run / 3]),
                     1e-4);
    }
    free(value);
    study_file_close(f);
    unlink(path);
    model_free(m);
}

// A run of a study has the energies of the same analysis alone. With beta = 0.3 its account does
// not close, and the residual comes and goes.
static void energies_of_a_run_are_those_of_its_analysis(void **state) {
    (void)state;
    static const char format[] = "%sbuilding A -floors 1 -mass 2 -stiffness %s\n"
                                 "initial A:1 -displacement 0.1 -velocity 0.5\n"
                                 "integrator newmark -beta 0.3\nstep fixed 0.01\nduration 1\n";
    char text_of_study[512];
    snprintf(text_of_study, sizeof text_of_study, format, "sweep k values 50 90\n", "$k");
    struct study_file *f = suite_ran(text_of_study);
    struct analysis a = analysis_of(format, "", "90");
    const struct study_view *v = study_file_view(f);
    double *value = malloc(v->table.n_value * sizeof *value);
    struct study_outcome outcome;
    struct error e;
    assert_non_null(value);
    assert_int_equal(study_file_read(f, 1, 1, &outcome, value, &e), STATUS_OK);
    assert_close(value[v->table.item[item_of(v, "initial")].first], 0.25 + 0.45, 1e-14);
    const double peak = value[v->table.item[item_of(v, "residual_peak")].first];
    assert_true(peak == a.results->residual_peak);
    assert_true(peak > 2.0 * fabs(a.results->energy[ENERGY_RESIDUAL]));
    for (int i = 0; i < ENERGY_COUNT; i++) {
        assert_true(value[v->table.item[item_of(v, energy_names[i])].first] ==
                    a.results->energy[i]);
    }
    free(value);
    analysis_free(&a);
    study_file_close(f);
}

static int stop_at_once(void *context, const struct study_progress *p, struct error *e) {
    (void)context, (void)p;
    return error_set(e, STATUS_SYSTEM, "enough");
}

static void a_study_that_is_stopped_has_no_file(void **state) {
    (void)state;
    char longer[sizeof text + 16];
    snprintf(longer, sizeof longer, "%.*s10000\n", (int)(strlen(text) - 2), text);
    struct model *m = build(longer);
    const char *path = support_path("stopped.h5");
    const struct study_request q = {
        .first = m, .n_thread = 2, .result = {.path = path, .version = "1"}, .poll = stop_at_once};
    struct study_progress p;
    struct error e;
    assert_int_equal(study_run(&q, &p, &e), STATUS_SYSTEM);
    assert_string_equal(e.message, "enough");
    assert_int_not_equal(access(path, F_OK), 0);
    model_free(m);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_last_sweep_varies_fastest),
        cmocka_unit_test(boxes_cover_all_runs_in_order),
        cmocka_unit_test(each_value_of_the_file_is_that_of_its_run),
        cmocka_unit_test(energies_of_a_run_are_those_of_its_analysis),
        cmocka_unit_test(a_study_that_is_stopped_has_no_file),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
