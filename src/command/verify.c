// SPDX-License-Identifier: GPL-3.0-or-later
// jostle verify: are the data of a result file as they were written, and do runs of a study give
// the same bits again?
#include <limits.h>
#include <string.h>

#include "command/crash.h"
#include "command/deck_command.h"
#include "command/interrupt.h"
#include "core/arena.h"
#include "core/safe.h"
#include "jostle/study_rerun.h"

static int verify_command(int argc, char **argv);

const struct command command_verify = {
    .name = "verify",
    .usage = "FILE.h5 [--rerun K [--seed S]] [--run N]... [--deck DECK]",
    .summary = "checks the data of a result file, and computes runs of a study again",
    .run = verify_command,
};

struct verify_options {
    const char *path;
    struct load_request load;  // the deck; path NULL: that which the file names
    struct study_rerun_request rerun;
    int n_draw;
    struct words run;  // numbers
};
#define AT(member) offsetof(struct verify_options, member)

static int poll_signal(void *context, double time, struct error *e) {
    (void)context, (void)time;
    return interrupt_check(e);
}

// The -D of the study as an array; NULL: no memory.
static const char **split_lines(struct arena *a, const char *lines, int *n) {
    char *text = arena_text(a, lines, strlen(lines));
    const char **line = arena_alloc(a, strlen(lines) + 1, sizeof *line);
    *n = 0;
    for (char *at = text; line && at && *at;) {
        char *end = at + strcspn(at, "\n");
        line[(*n)++] = at;
        at = end + (*end == '\n');
        *end = '\0';
    }
    return text ? line : NULL;
}

static int load_and_rerun(struct study_file *f, struct verify_options *o, struct arena *a) {
    struct study_rerun out;
    struct model *m;
    struct error e;
    const struct study_view *v = study_file_view(f);
    o->load.define.word = split_lines(a, v->origin.define, &o->load.define.n);
    if (!o->load.define.word) {
        return command_no_memory();
    }
    int status = deck_command_load(&o->load, &m);
    if (status != EXIT_DONE) {
        return status;
    }
    o->rerun.first = m;
    o->rerun.define = o->load.define.word;
    o->rerun.n_define = o->load.define.n;
    o->rerun.n_thread = deck_command_threads();
    interrupt_catch();
    status = study_rerun(f, &o->rerun, &out, &e);
    model_free(m);
    if (status != STATUS_OK) {
        return command_fail(&e);
    }
    printf("%ld run%s computed again, all values with the same bits: %s of %ld\n", out.n_same,
           out.n_same == 1 ? "" : "s", out.numbers, v->n_study);
    if (out.n_missing > 0) {
        printf("%ld of the runs are not in the file: jostle merge --partial left them out\n",
               out.n_missing);
    }
    return EXIT_DONE;
}

static int rerun(struct verify_options *o) {
    struct study_file *f;
    struct report *report = NULL;
    struct error e;
    if (!study_file_is_study(o->path)) {
        return command_usage(&command_verify, "--rerun and --run are for studies; %s is not one",
                             o->path);
    }
    if (study_file_open(o->path, &f, &e) != STATUS_OK) {
        return command_fail(&e);
    }
    int status = study_file_report(f, &report, &e) == STATUS_OK ? EXIT_DONE : command_fail(&e);
    if (status == EXIT_DONE) {
        o->load.path = o->load.path ? o->load.path : report->deck_file;
        status = load_and_rerun(f, o, report->arena);
        report_free(report);
    }
    study_file_close(f);
    return status;
}

static const struct option_row rows[] = {
    {"rerun", 0, "K", OPTION_WHOLE, 0, AT(n_draw), 1, STUDY_RUNS_MAX, .what = "a number of runs",
     .doc = "computes K runs of a study again, drawn at random, and compares their values bit by "
            "bit"},
    {"seed", 0, "S", OPTION_WHOLE, 0, AT(rerun.seed), 1, INT_MAX,
     .doc = "seed of the random draw, a whole number from 1; default: 1"},
    {"run", 0, "N", OPTION_WORDS, 0, AT(run), 1, STUDY_RUNS_MAX, .what = "the number of a run",
     .doc = "computes run N of the study again; may be repeated"},
    {"deck", 0, "DECK", OPTION_TEXT, 0, AT(load.path),
     .doc = "the deck of the study, if it is not where it was"},
    {0}};

static const struct option_row *const run_row = &rows[2];

static int use(void *options, struct arena *a, const struct words *operand) {
    struct verify_options *o = options;
    long *run = arena_alloc(a, (size_t)o->run.n, sizeof *run);
    if (!run) {
        return command_no_memory();
    }
    for (int i = 0; i < o->run.n; i++) {
        int number;
        const int status = option_whole(&command_verify, run_row, o->run.word[i], &number);
        if (status != EXIT_DONE) {
            return status;
        }
        run[i] = number;
    }
    o->path = operand->word[0];
    o->rerun.n_draw = o->n_draw;
    o->rerun.run = run;
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
    struct verify_options o = {.load = {.quiet = true}, .rerun = {.seed = 1, .poll = poll_signal}};
    return option_run(&list, argc, argv, &o);
}
