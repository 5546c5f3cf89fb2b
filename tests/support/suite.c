// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/suite.h"

#include <unistd.h>

#include "jostle/study.h"
#include "support/support.h"

// A gap below 0 is an error of the run. The first one, which must be sound, is k = 2500, im = 3.
const char suite_oscillators[] = "title \"oscillators\"\n"
                                 "sweep k values 2500 100 400 900 1600\n"
                                 "sweep im values 3 1 2\n"
                                 "building A -floors 1 -mass 1 -stiffness $k\n"
                                 "contact A wall -gap ${1e6 * (0.25 - im / sqrt(k))} -law linear "
                                 "-k 1\n"
                                 "initial A:1 -velocity $im\n"
                                 "step fixed 0.0005\n"
                                 "duration 1\n";

struct study_file *suite_ran(const char *text) {
    const char *deck = support_write("suite.deck", text), *path = support_path("suite.h5");
    struct deck *d;
    struct model *m;
    struct study_file *f;
    struct study_progress p;
    struct error e;
    assert_int_equal(deck_open(deck, NULL, 0, &d, &e), STATUS_OK);
    assert_int_equal(model_build(d, &m, &e), STATUS_OK);
    const struct study_request q = {
        .first = m,
        .n_thread = 1,
        .journal = STUDY_RESTART,
        .result = {.path = path, .version = "1", .existing = RESULT_REPLACE}};
    assert_int_equal(study_run(&q, &p, &e), STATUS_OK);
    model_free(m);
    assert_int_equal(study_file_open(path, &f, &e), STATUS_OK);
    return f;
}
