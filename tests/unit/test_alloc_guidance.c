// SPDX-License-Identifier: GPL-3.0-or-later
// Every allocation of the guidance of a model, and of its runs at shorter steps, is made to fail in
// its turn.
#include "model/guidance.h"
#include "study/refinement.h"
#include "support/analysis.h"
#include "support/fail_alloc.h"
#include "support/support.h"

static int attempt(void *context, struct error *e) {
    const struct model *m = context;
    struct guidance g;
    struct refinement *r = NULL;
    int status = guidance_find(m, &g, e);
    if (status == STATUS_OK) {
        status = refinement_run(m, 3, 1e-3, NULL, &r, e);
    }
    if (status == STATUS_OK) {
        assert_int_equal(r->n_level, 3);
        assert_int_equal(r->n_result, 1 + 2 * 4 + 3 + 1);
        refinement_free(r);
    }
    return status;
}

static void every_allocation_that_fails_ends_in_an_error(void **state) {
    (void)state;
    struct model *m = analysis_model(
        "building A -floors 2 -mass 1 -stiffness 100\nbuilding B -floors 1 -mass 1 -stiffness 50\n"
        "contact A B -gap 1mm -law hertz -k 1e4\nlink A B -stiffness 1\n"
        "damping A modal 5%%\nground sine -amplitude 1 -frequency 1 -cycles 2\n"
        "initial A -velocity 1\nduration 0.2\nstep fixed 0.01\n");
    fail_alloc_each(attempt, m, 20);
    model_free(m);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_allocation_that_fails_ends_in_an_error),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
