// SPDX-License-Identifier: GPL-3.0-or-later
// Every allocation of a sensitivity analysis, and of a deck with correlated parameters, is made to
// fail in its turn. Each failure must come back as an error; none is taken for a run that failed.
#include "study/sensitivity.h"
#include "support/fail_alloc.h"
#include "support/support.h"

static const char independent[] = "sweep g values 1 2\n"
                                  "sweep k random uniform 300 400 -n 4 -seed 1\n"
                                  "sweep x random normal 1 0.1 -n 4 -seed 1 -lhs\n"
                                  "building A -floors 1 -mass 1 -stiffness $k\n"
                                  "initial A:1 -displacement ${0.01 * g * x}\n"
                                  "step fixed 0.01\n"
                                  "duration 0.01\n";
static const char correlated[] = "sweep k random uniform 300 400 -n 4 -seed 1\n"
                                 "sweep m random normal 1 0.1 -n 4 -seed 1 -lhs -correlated k:0.5\n"
                                 "building A -floors 1 -mass $m -stiffness $k\n"
                                 "initial A:1 -displacement 0.01\n"
                                 "step fixed 0.01\n"
                                 "duration 0.01\n";

struct work {
    const char *deck;
    enum sensitivity_method method;
};

static int analyse(const struct work *w, const struct model *m, struct error *e) {
    const struct study_request study = {.first = m, .result = {.path = "none.h5", .version = "1"}};
    struct sensitivity found;
    struct plan p;
    int status = plan_init(&p, &study, e);
    if (status != STATUS_OK) {
        return status;
    }
    struct sensitivity_request q = {
        .plan = &p, .method = w->method, .share = 0.1, .n_row = 3, .n_level = 4, .n_thread = 1};
    const struct study_view view = plan_view(&p);
    status = edp_parse(&view, "displacement", p.table->arena, &q.edp, e);
    if (status == STATUS_OK) {
        status = sensitivity_find(&q, p.table->arena, &found, e);
    }
    if (status == STATUS_OK) {
        status = sensitivity_run(&q, p.table->arena, &found, e);
    }
    if (status == STATUS_OK) {
        assert_int_equal(found.n_failed + found.n_collapsed, 0);
    }
    plan_close(&p);
    return status;
}

static int attempt(void *context, struct error *e) {
    const struct work *w = context;
    struct deck *d = NULL;
    struct model *m = NULL;
    int status = deck_open_text("memory.deck", w->deck, NULL, 0, &d, e);
    if (status == STATUS_OK) {
        status = model_build(d, &m, e);
        status = status == STATUS_INPUT ? diagnostics_cause(&d->diagnostics, e) : status;
    }
    if (status == STATUS_OK && w->deck == independent) {
        status = analyse(w, m, e);
    }
    deck_free(d);
    return status;
}

static void every_allocation_that_fails_ends_in_an_error(void **state) {
    (void)state;
    for (enum sensitivity_method method = SENSITIVITY_ONE_AT_A_TIME; method <= SENSITIVITY_VARIANCE;
         method++) {
        fail_alloc_each(attempt, &(struct work){independent, method}, 50);
    }
}

static void so_it_does_in_a_deck_with_correlated_parameters(void **state) {
    (void)state;
    fail_alloc_each(attempt, &(struct work){.deck = correlated}, 10);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_allocation_that_fails_ends_in_an_error),
        cmocka_unit_test(so_it_does_in_a_deck_with_correlated_parameters),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
