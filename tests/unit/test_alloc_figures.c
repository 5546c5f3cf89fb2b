// SPDX-License-Identifier: GPL-3.0-or-later
// Every allocation of every figure is made to fail in its turn; each failure must come back as an
// error that says so.
#include <gsl/gsl_errno.h>
#include <stdio.h>
#include <string.h>

#include "jostle/analysis.h"
#include "plot/figure.h"
#include "support/fail_alloc.h"
#include "support/support.h"

static const char text[] = "units kN m s\n"
                           "building A -floors 2 -mass 100t -stiffness 30MN/m -height 3\n"
                           "wall A:1:2 -EI 1e6\n"
                           "building B -floors 3 -mass 80t -stiffness 20MN/m -height 3\n"
                           "contact A B -gap 1mm -law hertz-damp -k 1e6 -e 0.6\n"
                           "link A B -dashpot 10\n"
                           "ground sine -amplitude 0.3g -frequency 2\n"
                           "step fixed 0.005\n"
                           "duration 0.5\n";

static void run(const struct model *m, const char *path) {
    const struct result_options options = {.path = path, .version = "0.0.0", .command_line = ""};
    struct result_writer *writer;
    struct results *results;
    struct error e;
    assert_int_equal(result_create(m, &options, &writer, &e), STATUS_OK);
    assert_int_equal(result_analyse(writer, NULL, &results, &e), STATUS_OK);
    assert_true(results->n_impact > 0);
    results_free(results);
}

static struct result_file *ran(void) {
    const char *deck_path = support_write("pair.deck", text), *path = support_path("pair.h5");
    struct deck *deck;
    struct model *m;
    struct result_file *file;
    struct error e;
    assert_int_equal(deck_open(deck_path, NULL, 0, &deck, &e), STATUS_OK);
    assert_int_equal(model_build(deck, &m, &e), STATUS_OK);
    run(m, path);
    model_free(m);
    assert_int_equal(result_open(path, &file, &e), STATUS_OK);
    return file;
}

struct drawing {
    const struct figure *figure;
    const struct runs *runs;
};

static int draw(void *context, struct error *e) {
    const struct drawing *d = context;
    FILE *file = fopen("/dev/null", "w");
    const struct figure_files to = {.script = file, .data = file, .picture = "picture.png"};
    assert_non_null(file);
    const int status = figure_write(d->figure, &(struct subject){.runs = d->runs}, &to, e);
    fclose(file);
    return status;
}

static void every_allocation_of_a_figure_that_fails_ends_in_an_error(void **state) {
    (void)state;
    struct result_file *file = ran();
    struct runs alone, twice;
    struct error e;
    assert_int_equal(runs_init(&alone, file, NULL, &e), STATUS_OK);
    assert_int_equal(runs_init(&twice, file, file, &e), STATUS_OK);
    for (int i = 0; i < n_figure && figures[i]->of == SUBJECT_RUNS; i++) {
        fail_alloc_each(draw, &(struct drawing){figures[i], &alone}, 0);
        if (figure_can_draw(figures[i], &(struct subject){.runs = &twice})) {
            fail_alloc_each(draw, &(struct drawing){figures[i], &twice}, 0);
        }
    }
    result_close(file);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_allocation_of_a_figure_that_fails_ends_in_an_error),
    };
    gsl_set_error_handler_off();
    return cmocka_run_group_tests(tests, NULL, NULL);
}
