// SPDX-License-Identifier: GPL-3.0-or-later
// Every allocation of a study is made to fail in its turn, in whatever thread it is. Each failure
// must come back as an error; none is taken for a run that failed.
#include <stdio.h>
#include <string.h>
#include <unistd.h>

#include "jostle/study.h"
#include "jostle/study_merge.h"
#include "study/force_map.h"
#include "support/fail_alloc.h"
#include "support/support.h"

static const char text[] = "sweep gap values 1mm 2mm\n"
                           "sweep factor values 1 2 -as motion\n"
                           "sweep record files \"memory*.txt\" -as motion\n"
                           "sweep k random uniform 300 400 -n 2 -seed 1\n"
                           "building A -floors 2 -mass 1 -stiffness $k\n"
                           "contact A wall -gap $gap -law hertz -k 1e4\n"
                           "ground record $record -unit m/s2 -dt 0.05 -scale $factor\n"
                           "step fixed 0.01\n";

// What is run or joined, and its result; it must be there just when the work succeeds.
struct work {
    int (*run)(const struct work *w, struct error *e);
    const char *input[2];
    const char *result;
    struct study_shard shard;  // n = 0: the whole study
    const char *histories;     // of chosen runs; NULL: none
};

static int attempt(void *context, struct error *e) {
    const struct work *w = context;
    unlink(w->result);
    const int status = w->run(w, e);
    // Where the histories of chosen runs fail, the study itself is there.
    const bool is_there = access(w->result, F_OK) == 0;
    assert_true(w->histories ? is_there || status != STATUS_OK : is_there == (status == STATUS_OK));
    return status;
}

static int run_deck(const struct work *w, struct error *e) {
    struct deck *d = NULL;
    struct model *m = NULL;
    int status = deck_open(w->input[0], NULL, 0, &d, e);
    if (status == STATUS_OK) {
        status = model_build(d, &m, e);
        status = status == STATUS_INPUT ? diagnostics_cause(&d->diagnostics, e) : status;
    }
    if (status == STATUS_OK) {
        const struct study_request q = {.first = m,
                                        .n_thread = 1,
                                        .shard = w->shard,
                                        .histories = w->histories,
                                        .journal = STUDY_RESTART,
                                        .result = {.path = w->result, .version = "1"}};
        struct study_progress p;
        status = study_run(&q, &p, e);
    }
    deck_free(d);
    return status;
}

static int join_parts(const struct work *w, struct error *e) {
    const struct study_merge_request q = {
        .path = w->input, .n_path = 2, .result = {.path = w->result, .version = "1"}};
    struct study_merged merged;
    return study_merge(&q, &merged, e);
}

static const char *write_deck(void) {
    support_write("memory1.txt", "0\n1\n-2\n1\n");
    support_write("memory2.txt", "0\n2\n-1\n1\n");
    return support_write("memory.deck", text);
}

static void every_allocation_of_a_study_that_fails_ends_in_an_error(void **state) {
    (void)state;
    struct work w = {run_deck, {write_deck()}, support_path("memory.h5"), {0, 0}, NULL};
    fail_alloc_each(attempt, &w, 100);
    struct error e;
    assert_int_equal(attempt(&w, &e), STATUS_OK);
}

static const char loaded[] = "sweep gap values 1mm 2mm\n"
                             "building A -floors 1 -mass 1 -stiffness 300\n"
                             "contact A wall -gap $gap -law linear -k 1e4\n"
                             "load A:1 constant 1\n"
                             "step fixed 0.01\n"
                             "duration 0.5\n";

static void every_allocation_of_chosen_histories_that_fails_ends_in_an_error(void **state) {
    (void)state;
    struct work w = {.run = run_deck,
                     .input = {support_write("chosen.deck", loaded)},
                     .result = support_path("chosen.h5"),
                     .histories = "worst:1:force"};
    fail_alloc_each(attempt, &w, 100);
    struct error e;
    assert_int_equal(attempt(&w, &e), STATUS_OK);
}

static void every_allocation_of_a_part_that_fails_ends_in_an_error(void **state) {
    (void)state;
    struct work w = {run_deck, {write_deck()}, support_path("part.h5"), {2, 3}, NULL};
    fail_alloc_each(attempt, &w, 100);
}

static void every_allocation_of_a_merge_that_fails_ends_in_an_error(void **state) {
    (void)state;
    const char *deck = write_deck();
    struct work first = {run_deck, {deck}, support_path("first.h5"), {1, 2}, NULL};
    struct work second = {run_deck, {deck}, support_path("second.h5"), {2, 2}, NULL};
    struct work both = {
        join_parts, {first.result, second.result}, support_path("merged.h5"), {0, 0}, NULL};
    struct error e;
    assert_int_equal(attempt(&first, &e), STATUS_OK);
    assert_int_equal(attempt(&second, &e), STATUS_OK);
    fail_alloc_each(attempt, &both, 100);
}

static const char recorded[] = "param gap 3mm\n"
                               "building A -floors 2 -mass 1 -stiffness 300\n"
                               "contact A wall -gap $gap -law hertz -k 1e4\n"
                               "ground record memory1.txt -unit m/s2 -dt 0.05\n"
                               "step fixed 0.01\n"
                               "output -histories\n"
                               "sweep gap values 1mm 2mm\n";

static void every_allocation_of_runs_with_histories_that_fails_ends_in_an_error(void **state) {
    (void)state;
    support_write("memory1.txt", "0\n1\n-2\n1\n");
    struct work w = {run_deck,
                     {support_write("recorded.deck", recorded)},
                     support_path("recorded.h5"),
                     {0, 0},
                     NULL};
    fail_alloc_each(attempt, &w, 100);
}

// The deck is read twice: the record stands below the factor that goes together with it.
static int choose(void *path, struct error *e) {
    const char *define[] = {"record=memory2"};
    struct deck *d = NULL;
    struct model *m = NULL;
    int status = deck_open(path, define, 1, &d, e);
    if (status == STATUS_OK) {
        status = model_build(d, &m, e);
        status = status == STATUS_INPUT ? diagnostics_cause(&d->diagnostics, e) : status;
    }
    if (status == STATUS_OK) {
        assert_int_equal(d->n_run, 4);
    }
    deck_free(d);
    return status;
}

static void every_allocation_of_a_choice_that_fails_ends_in_an_error(void **state) {
    (void)state;
    support_write("memory1.txt", "0\n1\n-2\n1\n");
    support_write("memory2.txt", "0\n2\n-1\n1\n");
    fail_alloc_each(choose, (void *)support_write("choose.deck", text), 10);
}

static const char pair[] = "param T1 1s\n"
                           "param T2 1s\n"
                           "building A -floors 1 -mass 1 -stiffness ${4 * pi^2 * 1kg / T1^2}\n"
                           "building B -floors 1 -mass 1 -stiffness ${4 * pi^2 * 1kg / T2^2}\n"
                           "contact A B -gap 0 -law hertz -k 1e4\n"
                           "ground record memory1.txt -unit m/s2 -dt 0.05\n"
                           "duration 1\n"
                           "step fixed 0.01\n";

static int map_forces(void *path, struct error *e) {
    double force[4];
    const struct force_map_request q = {
        .path = path, .period = (const double[]){0.2, 0.3}, .n_period = 2, .n_thread = 2};
    const int status = force_map_run(&q, force, e);
    assert_true(status != STATUS_OK || force[1] > 0.0 || force[2] > 0.0);
    return status;
}

static void every_allocation_of_a_force_map_that_fails_ends_in_an_error(void **state) {
    (void)state;
    support_write("memory1.txt", "0\n1\n-2\n1\n");
    fail_alloc_each(map_forces, (void *)support_write("pair.deck", pair), 100);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_allocation_of_a_force_map_that_fails_ends_in_an_error),
        cmocka_unit_test(every_allocation_of_a_study_that_fails_ends_in_an_error),
        cmocka_unit_test(every_allocation_of_chosen_histories_that_fails_ends_in_an_error),
        cmocka_unit_test(every_allocation_of_a_part_that_fails_ends_in_an_error),
        cmocka_unit_test(every_allocation_of_a_merge_that_fails_ends_in_an_error),
        cmocka_unit_test(every_allocation_of_runs_with_histories_that_fails_ends_in_an_error),
        cmocka_unit_test(every_allocation_of_a_choice_that_fails_ends_in_an_error),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
