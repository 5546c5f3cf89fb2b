// SPDX-License-Identifier: GPL-3.0-or-later
// The lengths of the runs of a study.
#include "study/lengths.h"
#include "support/analysis.h"
#include "support/support.h"

static void measure(const char *deck, struct model **m, struct plan *p, struct lengths *l) {
    struct error e;
    *m = analysis_model("%s", deck);
    const struct study_request q = {.first = *m, .result = {.version = ""}};
    assert_int_equal(plan_init(p, &q, &e), STATUS_OK);
    assert_int_equal(lengths_init(l, p, &e), STATUS_OK);
    while (!l->measured) {
        lengths_measure(l, 1.0);
    }
}

static void finish(struct model *m, struct plan *p, struct lengths *l) {
    lengths_close(l);
    plan_close(p);
    model_free(m);
}

static void fixed_steps_are_counted(void **state) {
    (void)state;
    struct model *m;
    struct plan p;
    struct lengths l;
    measure("sweep T values 2 1 50 -as case\nsweep scale values 1 3 5 -as case\n"
            "sweep k range 100 200 4\nsweep h values 0.01 0.02\n"
            "building A -floors 1 -mass 1 -stiffness $k\ninitial A -velocity $scale\n"
            "step fixed $h\nduration $T\n",
            &m, &p, &l);
    for (long run = 0; run < 24; run++) {
        static const double duration[] = {2, 1, 50}, step[] = {0.01, 0.02};
        assert_close(lengths_of(&l, run), duration[run / 8] / step[run % 2] / 200.0, 1e-12);
    }
    finish(m, &p, &l);
}

static void adaptive_steps_go_by_the_duration(void **state) {
    (void)state;
    struct model *m;
    struct plan p;
    struct lengths l;
    measure("sweep T values 2 3\nsweep wrong values 1 -1\n"
            "building A -floors 1 -mass $wrong -stiffness 100\ninitial A -velocity 1\n"
            "step adaptive -tolerance 1e-4\nduration $T\n",
            &m, &p, &l);
    assert_close(lengths_of(&l, 2), 1.5, 1e-12);
    assert_close(lengths_of(&l, 1), 1.0, 1e-12);  // cannot be built
    finish(m, &p, &l);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(fixed_steps_are_counted),
        cmocka_unit_test(adaptive_steps_go_by_the_duration),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
