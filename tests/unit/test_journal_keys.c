// SPDX-License-Identifier: GPL-3.0-or-later
// Runs of a journal are found by their keys, whatever their numbers are in the study that reads it.
#include <unistd.h>

#include "study/journal.h"
#include "support/keys.h"
#include "support/support.h"

enum { RUNS = 5, VALUES = 3 };
static const char head[] = "values of a run\t1\n";
static const struct study_outcome done = {.status = STUDY_DONE}, failed = {.status = STUDY_FAILED};

static double value_of(long run, int i) {
    return 100.0 * (double)run + i + 0.1;
}

static void add(struct journal *j, long run, const struct study_outcome *outcome, bool collapsed) {
    struct error e;
    const double value[VALUES] = {value_of(run, 0), value_of(run, 1), value_of(run, 2)};
    assert_int_equal(journal_add_run(j, run, outcome, collapsed, value, &e), STATUS_OK);
}

// A grown study has the runs at other places, and more; one that lacks some counts them.
static void runs_are_found_by_their_keys(void **state) {
    (void)state;
    static const int few[RUNS] = {1, 2, 3, 4, 5};
    enum { MORE = 9 };
    // In another order; two runs of the key 3, and none of 4.
    static const int many[MORE] = {3, 8, 7, 6, 5, 100, 3, 2, 1};
    static const long same[][2] = {{8, 0}, {7, 1}, {6, 2}, {0, 2}};
    const char *path = support_path("grown.runs");
    struct keys keys;
    struct journal j;
    struct error e;
    unlink(path);
    keys_made_up(&keys, RUNS, few);
    assert_int_equal(journal_open(&j, path, &keys, VALUES, &e), STATUS_OK);
    assert_int_equal(journal_reset(&j, head, &e), STATUS_OK);
    add(&j, 3, &done, false);
    add(&j, 1, &failed, false);
    add(&j, 0, &done, false);
    add(&j, 2, &done, false);
    journal_close(&j);
    keys_close(&keys);
    keys_made_up(&keys, MORE, many);
    assert_int_equal(journal_open(&j, path, &keys, VALUES, &e), STATUS_OK);
    assert_int_equal(journal_load(&j, &e), STATUS_OK);
    assert_int_equal(j.n_done, 4);
    assert_int_equal(j.n_failed, 1);
    assert_int_equal(j.n_foreign, 1);
    for (int i = 0; i < 4; i++) {
        struct study_outcome outcome;
        double value[VALUES];
        assert_int_equal(journal_read(&j, same[i][0], &outcome, value, &e), STATUS_OK);
        assert_int_equal(outcome.status, same[i][1] == 1 ? STUDY_FAILED : STUDY_DONE);
        assert_true(same[i][1] == 1 || value[2] == value_of(same[i][1], 2));
    }
    journal_close(&j);
    keys_close(&keys);
}

// What is done once is done for all runs of its key, and a run without a key for itself only.
static void a_run_stands_for_all_of_its_key(void **state) {
    (void)state;
    static const int twins[RUNS] = {0, 5, 0, 5, 0};
    const char *path = support_path("twins.runs");
    struct keys keys;
    struct journal j;
    struct error e;
    unlink(path);
    keys_made_up(&keys, RUNS, twins);
    assert_int_equal(keys_find(&keys, &keys.key[3]), 1);
    assert_int_equal(keys_find(&keys, &keys.key[0]), -1);
    assert_int_equal(journal_open(&j, path, &keys, VALUES, &e), STATUS_OK);
    assert_int_equal(journal_reset(&j, head, &e), STATUS_OK);
    add(&j, 3, &done, true);
    assert_int_equal(j.n_done, 2);
    assert_int_equal(j.n_collapsed, 2);
    add(&j, 0, &done, false);
    assert_int_equal(j.n_done, 3);
    journal_close(&j);
    assert_int_equal(journal_open(&j, path, &keys, VALUES, &e), STATUS_OK);
    assert_int_equal(journal_load(&j, &e), STATUS_OK);
    assert_int_equal(j.n_done, 2);
    assert_int_equal(j.n_foreign, 0);
    assert_true(j.offset[1] != 0 && j.offset[1] == j.offset[3] && j.offset[0] == 0);
    journal_close(&j);
    keys_close(&keys);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(runs_are_found_by_their_keys),
        cmocka_unit_test(a_run_stands_for_all_of_its_key),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
