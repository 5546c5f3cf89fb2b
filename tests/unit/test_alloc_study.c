// SPDX-License-Identifier: GPL-3.0-or-later
// Every allocation of a study is made to fail in its turn, in whatever thread it is. Each failure
// must come back as an error; none is taken for a run that failed.
#include <stdio.h>
#include <string.h>
#include <unistd.h>

#include "jostle/study.h"
#include "study/force_map.h"
#include "support/fail_alloc.h"
#include "support/support.h"

static const char text[] = "sweep gap values 1mm 2mm\n"
                           "sweep record files \"memory*.txt\"\n"
                           "building A -floors 2 -mass 1 -stiffness 400\n"
                           "contact A wall -gap $gap -law hertz -k 1e4\n"
                           "ground record $record -unit m/s2 -dt 0.05\n"
                           "step fixed 0.01\n";

static int run_all(const char *path, const char *result, struct error *e) {
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
                                        .journal = STUDY_RESTART,
                                        .result = {.path = result, .version = "1"}};
        struct study_progress p;
        status = study_run(&q, &p, e);
    }
    deck_free(d);
    return status;
}

static void every_allocation_that_fails_ends_in_an_error(void **state) {
    (void)state;
    struct error e;
    support_write("memory1.txt", "0\n1\n-2\n1\n");
    support_write("memory2.txt", "0\n2\n-1\n1\n");
    const char *path = support_write("memory.deck", text);
    const char *result = support_path("memory.h5");
    fail_alloc_at(0);
    assert_int_equal(run_all(path, result, &e), STATUS_OK);
    const long n = fail_alloc_stop();
    assert_in_range(n, 100, 20000);
    for (long k = 1; k <= n; k++) {
        e.message[0] = '\0';
        fail_alloc_at(k);
        int status = run_all(path, result, &e);
        fail_alloc_stop();
        if (status == STATUS_OK) {
            fail_msg("allocation %ld of %ld failed unnoticed", k, n);
        }
        assert_true(e.message[0] != '\0');
        assert_int_not_equal(access(result, F_OK), 0);
    }
    assert_int_equal(run_all(path, result, &e), STATUS_OK);
    assert_int_equal(access(result, F_OK), 0);
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
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
