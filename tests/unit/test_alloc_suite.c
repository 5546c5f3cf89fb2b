// SPDX-License-Identifier: GPL-3.0-or-later
// Every allocation of a suite and of its figures is made to fail in its turn; each failure must
// come back as an error that says so.
#include <gsl/gsl_errno.h>
#include <stdio.h>
#include <string.h>

#include "plot/figure.h"
#include "study/bootstrap.h"
#include "support/fail_alloc.h"
#include "support/suite.h"
#include "support/support.h"

static const char text[] = "units kN m s\n"
                           "sweep record values linear hertz -as motion\n"
                           "sweep k values 1e4 2e4 -as motion\n"
                           "sweep im values 1 2 3\n"
                           "building A -floors 2 -mass 100t -stiffness 50MN/m -height 3\n"
                           "contact A wall -gap 1mm -law $record -k $k\n"
                           "ground sine -amplitude $im -frequency 2 -cycles 2\n"
                           "step fixed 5ms\n";

static int draw(struct study_file *f, const struct figure *figure, struct error *e) {
    static const double limit = 0.001;
    const char *at = "im=1";                                      // against what goes together
    const bool response = strcmp(figure->name, "response") == 0;  // shows no limit
    const struct suite_request q = {.guess = figure->guess, .at = &at, .n_at = response};
    FILE *to = fopen("/dev/null", "w");
    const struct figure_files files = {.script = to, .data = to, .picture = "picture.png"};
    struct suite *s = NULL;
    assert_non_null(to);
    int status = suite_create(f, &q, &s, e);
    if (status == STATUS_OK) {
        const struct subject p = {.suite = s, .limit = &limit, .n_limit = response ? 0 : 1};
        status = figure_write(figure, &p, &files, e);
        suite_free(s);
    }
    fclose(to);
    return status;
}

struct drawing {
    const char *path;
    const struct figure *figure;
};

// From the file opened anew, as errors of reading stick.
static int open_and_draw(void *context, struct error *e) {
    const struct drawing *d = context;
    struct study_file *f;
    int status = study_file_open(d->path, &f, e);
    if (status == STATUS_OK) {
        status = draw(f, d->figure, e);
        study_file_close(f);
    }
    return status;
}

static void every_allocation_that_fails_ends_in_an_error(void **state) {
    (void)state;
    struct study_file *f = suite_ran(text);
    for (int i = 0; i < n_figure; i++) {
        if (figures[i]->of == SUBJECT_STUDY) {
            fail_alloc_each(open_and_draw, &(struct drawing){study_file_view(f)->path, figures[i]},
                            10);
        }
    }
    study_file_close(f);
}

// With a sample that never exceeds the limit, fits need memory, too.
static int draw_again(void *context, struct error *e) {
    static const struct fragility_record record[] = {
        {CROSSING_AT, 1.0}, {CROSSING_AT, 2.0}, {CROSSING_AT, 1.5}, {CROSSING_ABOVE, 3.0}};
    struct fragility_record drawn[4];
    struct bootstrap_records records = {record, 4, drawn};
    const struct bootstrap_request q = {
        .n_unit = 4, .n_draw = 3, .seed = 1, .fit = bootstrap_fit_records, .context = &records};
    struct bootstrap b;
    (void)context;
    return bootstrap_run(&q, &b, e);
}

static void so_does_a_bootstrap(void **state) {
    (void)state;
    fail_alloc_each(draw_again, NULL, 4);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(so_does_a_bootstrap),
        cmocka_unit_test(every_allocation_that_fails_ends_in_an_error),
    };
    gsl_set_error_handler_off();
    return cmocka_run_group_tests(tests, NULL, NULL);
}
