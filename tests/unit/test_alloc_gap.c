// SPDX-License-Identifier: GPL-3.0-or-later
// Every allocation of the runs of `jostle gap` is made to fail in its turn. Each failure must come
// back as an error; none is taken for a run that failed.
#include "study/apart.h"
#include "study/gap_search.h"
#include "support/fail_alloc.h"
#include "support/support.h"

static const char text[] = "param gap 1mm\n"
                           "sweep k random uniform 300 400 -n 2 -seed 1 -lhs\n"
                           "building A -floors 2 -mass 1 -stiffness $k\n"
                           "contact A wall -gap $gap -law hertz -k 1e4\n"
                           "initial A -velocity 0.1\n"
                           "step fixed 0.01\n"
                           "duration 0.5\n";

static int run_search(const struct plan *p, struct error *e) {
    const struct gap_search_request q = {.plan = p,
                                         .parameter = "gap",
                                         .edp = {.kind = &gap_measure_kinds[0], .owner = -1},
                                         .limit = 1.0,
                                         .percentile = 100.0,
                                         .from = 0.0,
                                         .to = 0.01,
                                         .n = 2,
                                         .tolerance = 0.004};
    const struct gap_runs how = {.n_thread = 1};
    struct gap_search s;
    int status = gap_search_run(&q, &how, &s, e);
    gap_search_close(&s);
    return status;
}

static int run_all(const char *path, struct error *e) {
    struct deck *d = NULL;
    struct model *m = NULL;
    int status = deck_open(path, NULL, 0, &d, e);
    if (status == STATUS_OK) {
        status = model_build(d, &m, e);
    }
    if (status == STATUS_OK) {
        const struct plan p = {.first = m, .n_run = d->n_run};
        const struct gap_runs how = {.n_thread = 1};
        struct apart a;
        status = apart_run(&p, &how, &a, e);
        apart_close(&a);
        status = status == STATUS_OK ? run_search(&p, e) : status;
    }
    deck_free(d);
    return status;
}

static void every_allocation_that_fails_ends_in_an_error(void **state) {
    (void)state;
    struct error e;
    const char *path = support_write("gap.deck", text);
    fail_alloc_at(0);
    assert_int_equal(run_all(path, &e), STATUS_OK);
    const long n = fail_alloc_stop();
    assert_in_range(n, 100, 20000);
    for (long k = 1; k <= n; k++) {
        e.message[0] = '\0';
        fail_alloc_at(k);
        int status = run_all(path, &e);
        fail_alloc_stop();
        if (status == STATUS_OK) {
            fail_msg("allocation %ld of %ld failed unnoticed", k, n);
        }
        assert_true(e.message[0] != '\0');
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_allocation_that_fails_ends_in_an_error),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
