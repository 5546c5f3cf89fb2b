// SPDX-License-Identifier: GPL-3.0-or-later
// jostle verify: are the data of a result file as they were written, and do runs of a study give
// the same bits again?
#include <limits.h>
#include <string.h>

#include "command/crash.h"
#include "command/interrupt.h"
#include "command/study_deck.h"
#include "core/arena.h"
#include "core/safe.h"
#include "jostle/study_rerun.h"
#include "study/selection.h"

static int verify_command(int argc, char **argv);

const struct command command_verify = {
    .name = "verify",
    .usage = "FILE.h5 [--rerun K [--seed S]] [--run RUNS]... [--deck DECK]",
    .summary = "checks the data of a result file, and computes runs of a study again",
    .run = verify_command,
};

struct verify_options {
    const char *path;
    const char *deck;  // NULL: that which the file names
    struct study_rerun_request rerun;
    int n_draw;
    struct words run;
};
#define AT(member) offsetof(struct verify_options, member)

static int poll_signal(void *context, double time, struct error *e) {
    (void)context, (void)time;
    return interrupt_check(e);
}

static int rerun(struct verify_options *o) {
    struct study_file *f;
    struct study_deck d;
    struct study_rerun out;
    struct error e;
    if (!study_file_is_study(o->path)) {
        return command_usage(&command_verify, "--rerun and --run are for studies; %s is not one",
                             o->path);
    }
    if (study_file_open(o->path, &f, &e) != STATUS_OK) {
        return command_fail(&e);
    }
    int status = study_deck_open(f, o->deck, &d);
    if (status == EXIT_DONE) {
        o->rerun.first = d.model;
        o->rerun.define = d.load.define.word;
        o->rerun.n_define = d.load.define.n;
        o->rerun.n_thread = deck_command_threads();
        interrupt_catch();
        status = study_rerun(f, &o->rerun, &out, &e) == STATUS_OK ? EXIT_DONE : command_fail(&e);
    }
    if (status == EXIT_DONE) {
        printf("%ld run%s computed again, all values with the same bits: %s of %ld\n", out.n_same,
               out.n_same == 1 ? "" : "s", out.numbers, study_file_view(f)->n_study);
    }
    if (status == EXIT_DONE && out.n_missing > 0) {
        printf("%ld of the runs are not in the file: jostle merge --partial left them out\n",
               out.n_missing);
    }
    study_deck_close(&d);
    study_file_close(f);
    return status;
}

static const struct option_row rows[] = {
    {"rerun", 0, "K", OPTION_WHOLE, 0, AT(n_draw), 1, STUDY_RUNS_MAX, .what = "a number of runs",
     .doc = "computes K runs of a study again, drawn at random, and compares their values bit by "
            "bit"},
    {"seed", 0, "S", OPTION_WHOLE, 0, AT(rerun.seed), 1, INT_MAX,
     .doc = "seed of the random draw, a whole number from 1; default: 1"},
    {"run", 0, "RUNS", OPTION_WORDS, 0, AT(run),
     .doc =
         "computes these runs of the study again, a list of " SELECTION_FORM "; may be repeated"},
    STUDY_DECK_ROW(AT(deck)),
    {0}};

static int use(void *options, struct arena *a, const struct words *operand) {
    (void)a;
    struct verify_options *o = options;
    o->path = operand->word[0];
    o->rerun.n_draw = o->n_draw;
    o->rerun.run = o->run.word;
    o->rerun.n_run = o->run.n;
    struct result_sums sums;
    struct error e;
    crash_reading(NULL, o->path);
    const int status = result_verify(o->path, &sums, &e);
    crash_reading(NULL, NULL);
    if (status != STATUS_OK) {
        return command_fail(&e);
    }
    safe_line(stdout, "%s: the data are as they were written", o->path);
    printf("data     SHA-256 %s\nresults  SHA-256 %s\n", sums.data.digits, sums.results.digits);
    return o->rerun.n_draw > 0 || o->rerun.n_run > 0 ? rerun(o) : EXIT_DONE;
}

static int verify_command(int argc, char **argv) {
    static const struct option_part parts[] = {
        {.text = "FILE.h5 is the result of a run, of a study or of a part. jostle compares its "
                 "data with the SHA-256\nchecksum in the file.\n\n"},
        {.row = rows},
        {.row = option_help},
        {.text = "\nExit status 0: the data and the runs are equal; 1: they differ; 2: wrong "
                 "usage, not a result file,\na file that is too damaged to be read, or the deck is "
                 "not that of the study.\n"},
        {0}};
    static const struct option_list list = {&command_verify, parts, .operand = "result file",
                                            .use = use};
    struct verify_options o = {.rerun = {.seed = 1, .poll = poll_signal}};
    return option_run(&list, argc, argv, &o);
}
