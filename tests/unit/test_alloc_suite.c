// SPDX-License-Identifier: GPL-3.0-or-later
// Every allocation of a suite and of its figures is made to fail in its turn; each failure must
// come back as an error that says so.
#include <gsl/gsl_errno.h>
#include <stdio.h>
#include <string.h>

#include "plot/study_figure.h"
#include "support/fail_alloc.h"
#include "support/suite.h"
#include "support/support.h"

static const char text[] = "units kN m s\n"
                           "sweep record values linear hertz\n"
                           "sweep im values 1 2 3\n"
                           "building A -floors 2 -mass 100t -stiffness 50MN/m -height 3\n"
                           "contact A wall -gap 1mm -law $record -k 1e4\n"
                           "ground sine -amplitude $im -frequency 2 -cycles 2\n"
                           "step fixed 5ms\n";

static int draw(struct study_file *f, const struct study_figure *figure, struct error *e) {
    static const double limit = 0.001;
    const char *at = "record=linear";
    const bool response = strcmp(figure->name, "response") == 0;  // shows no limit
    const struct suite_request q = {.guess = figure->guess, .at = &at, .n_at = response};
    FILE *to = fopen("/dev/null", "w");
    const struct figure_files files = {.script = to, .data = to, .picture = "picture.png"};
    struct suite *s = NULL;
    assert_non_null(to);
    int status = suite_create(f, &q, &s, e);
    if (status == STATUS_OK) {
        const struct study_picture p = {s, &limit, response ? 0 : 1};
        status = study_figure_write(figure, &p, &files, e);
        suite_free(s);
    }
    fclose(to);
    return status;
}

// Draws from the file at `path`, opened anew, as errors of reading stick; the `k`-th allocation
// behind that fails. *n: how many there were.
static int draw_failing(const char *path, const struct study_figure *figure, long k, long *n,
                        struct error *e) {
    struct study_file *f;
    assert_int_equal(study_file_open(path, &f, e), STATUS_OK);
    fail_alloc_at(k);
    const int status = draw(f, figure, e);
    *n = fail_alloc_stop();
    study_file_close(f);
    return status;
}

static void every_allocation_that_fails_ends_in_an_error(void **state) {
    (void)state;
    struct study_file *f = suite_ran(text);
    const char *path = study_file_view(f)->path;
    for (int i = 0; i < n_study_figure; i++) {
        struct error e = {.message = ""};
        long n, ignored;
        if (draw_failing(path, study_figures[i], 0, &n, &e) != STATUS_OK) {
            fail_msg("%s", e.message);
        }
        assert_in_range(n, 10, 5000);
        for (long k = 1; k <= n; k++) {
            const int status = draw_failing(path, study_figures[i], k, &ignored, &e);
            if (status != STATUS_SYSTEM || !strstr(e.message, "out of memory")) {
                fail_msg("%s: allocation %ld of %ld failed unnoticed: %s", study_figures[i]->name,
                         k, n, e.message);
            }
        }
    }
    study_file_close(f);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_allocation_that_fails_ends_in_an_error),
    };
    gsl_set_error_handler_off();
    return cmocka_run_group_tests(tests, NULL, NULL);
}
