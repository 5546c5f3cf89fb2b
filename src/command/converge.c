// SPDX-License-Identifier: GPL-3.0-or-later
// jostle converge: a deck at ever shorter steps, and what that says of the error of its results.
#include "command/converge_print.h"
#include "command/deck_command.h"
#include "command/progress.h"

static int converge_command(int argc, char **argv);

const struct command command_converge = {
    .name = "converge",
    .usage = "DECK [-D NAME=VALUE]... [-n LEVELS] [--rtol R] [--tsv|--csv|--json]",
    .summary = "runs a deck at ever shorter steps and prints the errors of its results",
    .run = converge_command,
};

enum { LEVELS_DEFAULT = 4 };
static const double RTOL_DEFAULT = 1e-3;

struct options {
    struct load_request load;
    int n_level;
    double rtol;
    enum printer_form form;
};
#define AT(member) offsetof(struct options, member)

static int show_progress(void *context, double time, struct error *e) {
    (void)e;
    progress_show(context, time);
    return STATUS_OK;
}

static int converge(void *options, const struct model *m) {
    const struct options *o = options;
    struct progress progress;
    struct refinement *r;
    struct error e;
    const struct observer observer = {.poll = show_progress, .context = &progress};
    progress_start(&progress, m->duration, m->deck->units.time_name);
    int status = refinement_run(m, o->n_level, o->rtol, &observer, &r, &e);
    progress_end(&progress);
    if (status != STATUS_OK) {
        return command_fail(&e);
    }
    status = converge_print(m, r, o->rtol, o->form);
    if (status == EXIT_DONE && r->n_within < r->n_result) {
        status = EXIT_FAILED;
    }
    refinement_free(r);
    return status;
}

static int converge_command(int argc, char **argv) {
    static const struct option_row rows[] = {
        DECK_DEFINE_ROW,
        {"levels", 'n', "LEVELS", OPTION_WHOLE, OPTION_LETTER_ONLY, AT(n_level),
         CONVERGENCE_LEVELS_MIN, CONVERGENCE_LEVELS_MAX,
         .doc = "runs, each at half the step of the one before, from that of the deck; 3 to 16, "
                "default 4"},
        {"rtol", 0, "R", OPTION_NUMBER, 0, AT(rtol), 1e-12, 1.0,
         .doc = "what counts as converged: an error bar of at most R times the result; default "
                "1e-3"},
        {"tsv", .kind = OPTION_SET, .at = AT(form), .set = FORM_TSV,
         .doc = "a table separated by tabs, with the results of all levels"},
        {0}};
    static const struct option_part parts[] = {
        {.row = rows},
        {.row = printer_rows, .at = AT(form)},
        {.row = option_help},
        {.text = "\nNothing is written. Exit status: 0 all results have converged, 1 some have "
                 "not.\n"},
        {0}};
    static const struct deck_command c = {&command_converge, parts, NULL, converge};
    struct options o = {.n_level = LEVELS_DEFAULT, .rtol = RTOL_DEFAULT};
    return deck_command_run(&c, argc, argv, &o.load);
}
