// SPDX-License-Identifier: GPL-3.0-or-later
// Every allocation of the runs of `jostle gap` is made to fail in its turn. Each failure must come
// back as an error; none is taken for a run that failed.
#include "study/contact_free.h"
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
    struct gap_search_request q = {.plan = p,
                                   .parameter = "gap",
                                   .limit = 1.0,
                                   .percentile = 100.0,
                                   .from = 0.0,
                                   .to = 0.01,
                                   .n = 2,
                                   .tolerance = 0.004};
    const struct study_view view = plan_view(p);
    if (edp_parse(&view, "force", p->table->arena, &q.edp, e) != STATUS_OK) {
        return e->status;
    }
    const struct gap_runs how = {.n_thread = 1};
    struct gap_search s;
    int status = gap_search_run(&q, &how, &s, e);
    gap_search_close(&s);
    return status;
}

static int run_plan(const struct model *m, struct error *e) {
    const struct study_request study = {.first = m, .result = {.version = ""}};
    const struct gap_runs how = {.n_thread = 1};
    struct plan p;
    struct contact_free a;
    int status = plan_init(&p, &study, e);
    if (status != STATUS_OK) {
        return status;
    }
    static const struct separation_site site = {.metre = 1.0};
    status = contact_free_run(&p, &how, &site, &a, e);
    contact_free_close(&a);
    status = status == STATUS_OK ? run_search(&p, e) : status;
    plan_close(&p);
    return status;
}

static int run_all(void *path, struct error *e) {
    struct deck *d = NULL;
    struct model *m = NULL;
    int status = deck_open(path, NULL, 0, &d, e);
    if (status == STATUS_OK) {
        status = model_build(d, &m, e);
    }
    if (status == STATUS_OK) {
        status = run_plan(m, e);
    }
    deck_free(d);
    return status;
}

static void every_allocation_that_fails_ends_in_an_error(void **state) {
    (void)state;
    fail_alloc_each(run_all, (void *)support_write("gap.deck", text), 100);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_allocation_that_fails_ends_in_an_error),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
