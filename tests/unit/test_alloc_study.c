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
                           "sweep record files \"memory*.txt\"\n"
                           "sweep k random uniform 300 400 -n 2 -seed 1\n"
                           "building A -floors 2 -mass 1 -stiffness $k\n"
                           "contact A wall -gap $gap -law hertz -k 1e4\n"
                           "ground record $record -unit m/s2 -dt 0.05\n"
                           "step fixed 0.01\n";

// Runs a part of the study; n = 0: the whole.
static int run_part(const char *path, const char *result, struct study_shard shard,
                    struct error *e) {
    struct deck *d = NULL;
    struct model *m = NULL;
    unlink(result);
    int status = deck_open(path, NULL, 0, &d, e);
    if (status == STATUS_OK) {
        status = model_build(d, &m, e);
    }
    if (status == STATUS_OK) {
        const struct study_request q = {.first = m,
                                        .n_thread = 1,
                                        .shard = shard,
                                        .journal = STUDY_RESTART,
                                        .result = {.path = result, .version = "1"}};
        struct study_progress p;
        status = study_run(&q, &p, e);
    }
    deck_free(d);
    return status;
}

static int merge_input(const void *input, const char *result, struct error *e) {
    const struct study_merge_request q = {
        .path = input, .n_path = 2, .result = {.path = result, .version = "1"}};
    struct study_merged merged;
    unlink(result);
    return study_merge(&q, &merged, e);
}

// Fails each allocation of work_on in its turn.
static void fail_each(int work_on(const void *input, const char *result, struct error *e),
                      const void *input, const char *result) {
    struct error e;
    fail_alloc_at(0);
    assert_int_equal(work_on(input, result, &e), STATUS_OK);
    const long n = fail_alloc_stop();
    assert_in_range(n, 100, 20000);
    for (long k = 1; k <= n; k++) {
        e.message[0] = '\0';
        fail_alloc_at(k);
        int status = work_on(input, result, &e);
        fail_alloc_stop();
        if (status == STATUS_OK) {
            fail_msg("allocation %ld of %ld failed unnoticed", k, n);
        }
        assert_true(e.message[0] != '\0');
        assert_int_not_equal(access(result, F_OK), 0);
    }
    assert_int_equal(work_on(input, result, &e), STATUS_OK);
    assert_int_equal(access(result, F_OK), 0);
}

static void write_deck(char *path) {
    support_write("memory1.txt", "0\n1\n-2\n1\n");
    support_write("memory2.txt", "0\n2\n-1\n1\n");
    snprintf(path, 256, "%s", support_write("memory.deck", text));
}

static int run_input(const void *input, const char *result, struct error *e) {
    return run_part(input, result, (struct study_shard){0, 0}, e);
}

static void every_allocation_that_fails_ends_in_an_error(void **state) {
    (void)state;
    char path[256];
    write_deck(path);
    fail_each(run_input, path, support_path("memory.h5"));
}

static int run_second(const void *input, const char *result, struct error *e) {
    return run_part(input, result, (struct study_shard){2, 3}, e);
}

static void so_it_is_with_a_part(void **state) {
    (void)state;
    char path[256];
    write_deck(path);
    fail_each(run_second, path, support_path("part.h5"));
}

static void and_with_parts_being_joined(void **state) {
    (void)state;
    char path[256], name[2][256];
    const char *const part[2] = {name[0], name[1]};
    struct error e;
    write_deck(path);
    for (int k = 0; k < 2; k++) {
        snprintf(name[k], sizeof name[k], "%s", support_path(k ? "second.h5" : "first.h5"));
        assert_int_equal(run_part(path, name[k], (struct study_shard){k + 1, 2}, &e), STATUS_OK);
    }
    fail_each(merge_input, part, support_path("merged.h5"));
}

static const char recorded[] = "param gap 3mm\n"
                               "building A -floors 2 -mass 1 -stiffness 300\n"
                               "contact A wall -gap $gap -law hertz -k 1e4\n"
                               "ground record memory1.txt -unit m/s2 -dt 0.05\n"
                               "step fixed 0.01\n"
                               "output -histories\n"
                               "sweep gap values 1mm 2mm\n";

static void and_with_the_histories_of_the_runs(void **state) {
    (void)state;
    support_write("memory1.txt", "0\n1\n-2\n1\n");
    fail_each(run_input, support_write("recorded.deck", recorded), support_path("recorded.h5"));
}

static const char pair[] = "param T1 1s\n"
                           "param T2 1s\n"
                           "building A -floors 1 -mass 1 -stiffness ${4 * pi^2 * 1kg / T1^2}\n"
                           "building B -floors 1 -mass 1 -stiffness ${4 * pi^2 * 1kg / T2^2}\n"
                           "contact A B -gap 0 -law hertz -k 1e4\n"
                           "ground record memory1.txt -unit m/s2 -dt 0.05\n"
                           "duration 1\n"
                           "step fixed 0.01\n";

static void every_allocation_of_a_force_map_that_fails_ends_in_an_error(void **state) {
    (void)state;
    struct error e;
    double force[4];
    support_write("memory1.txt", "0\n1\n-2\n1\n");
    const struct force_map_request q = {.path = support_write("pair.deck", pair),
                                        .period = (const double[]){0.2, 0.3},
                                        .n_period = 2,
                                        .n_thread = 2};
    fail_alloc_at(0);
    assert_int_equal(force_map_run(&q, force, &e), STATUS_OK);
    const long n = fail_alloc_stop();
    assert_true(force[1] > 0.0 || force[2] > 0.0);
    assert_in_range(n, 100, 20000);
    for (long k = 1; k <= n; k++) {
        e.message[0] = '\0';
        fail_alloc_at(k);
        const int status = force_map_run(&q, force, &e);
        fail_alloc_stop();
        if (status == STATUS_OK) {
            fail_msg("allocation %ld of %ld failed unnoticed", k, n);
        }
        assert_int_equal(status, STATUS_SYSTEM);
        assert_true(e.message[0] != '\0');
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_allocation_of_a_force_map_that_fails_ends_in_an_error),
        cmocka_unit_test(every_allocation_that_fails_ends_in_an_error),
        cmocka_unit_test(so_it_is_with_a_part),
        cmocka_unit_test(and_with_parts_being_joined),
        cmocka_unit_test(and_with_the_histories_of_the_runs),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
