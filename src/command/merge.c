// SPDX-License-Identifier: GPL-3.0-or-later
// jostle merge: the parts of a study to its result file.
#include "command/crash.h"
#include "command/interrupt.h"
#include "command/option.h"
#include "command/output_name.h"
#include "command/progress.h"
#include "command/show.h"
#include "jostle/study_merge.h"

static int merge_command(int argc, char **argv);

const struct command command_merge = {
    .name = "merge",
    .usage = "PART.h5... -o FILE.h5 [-q] [--force] [--partial]",
    .summary = "joins the parts of a study into one result file",
    .run = merge_command,
};

struct merge_options {
    struct study_merge_request request;
    bool quiet;
    int n_word;
    char **word;  // (n_word) of the command
};
#define AT(member) offsetof(struct merge_options, member)

static int poll_signal(void *context, struct error *e) {
    (void)context;
    const int signal = interrupt_number();
    return signal ? error_set(e, STATUS_SYSTEM, "interrupted by signal %d; nothing was written",
                              signal)
                  : STATUS_OK;
}

static int merge(const struct merge_options *o) {
    const struct study_merge_request *q = &o->request;
    struct study_merged merged;
    struct error e;
    const int status = study_merge(q, &merged, &e);
    crash_reading(NULL, NULL);
    if (status != STATUS_OK) {
        return command_fail(&e);
    }
    if (!o->quiet && show_study_summary(q->result.path, stdout, &e) != STATUS_OK) {
        return command_fail(&e);
    }
    if (merged.left_histories) {
        fprintf(stderr, "jostle: warning: the histories of the runs stay in the parts\n");
    }
    if (merged.n_missing > 0) {
        error_set(&e, STATUS_FAILED, "%ld of %ld runs are missing in %s: %s", merged.n_missing,
                  merged.n_run, q->result.path, merged.missing);
        return command_fail(&e);
    }
    return study_display_status(merged.n_failed, merged.n_run, q->result.path, "");
}

static int use(void *options, struct arena *a, const struct words *operand) {
    struct merge_options *o = options;
    struct study_merge_request *q = &o->request;
    q->path = operand->word;
    q->n_path = operand->n;
    if (q->n_path < 1) {
        return command_usage(&command_merge, "the files of the parts are expected");
    }
    if (!q->result.path) {
        return command_usage(&command_merge, "-o FILE.h5 is expected");
    }
    for (int i = 0; i < q->n_path; i++) {
        if (output_is_same_file(q->path[i], q->result.path)) {
            return command_usage(&command_merge,
                                 "%s is one of the parts; give the result another name",
                                 q->result.path);
        }
    }
    q->result.command_line = command_line(a, o->n_word, o->word);
    if (!q->result.command_line) {
        return command_no_memory();
    }
    interrupt_catch();
    return merge(o);
}

static int merge_command(int argc, char **argv) {
    static const struct option_row rows[] = {
        {"output", 'o', "FILE", OPTION_TEXT, 0, AT(request.result.path),
         .doc = "the result file of the study"},
        {"quiet", 'q', .kind = OPTION_TRUE, .at = AT(quiet), .doc = "prints errors only"},
        {"force", .kind = OPTION_SET, .at = AT(request.result.existing), .set = RESULT_REPLACE,
         .doc = "overwrites an existing result file"},
        {"partial", .kind = OPTION_SET, .at = AT(request.gaps), .set = STUDY_PARTIAL,
         .doc =
             "writes the file although parts are missing; their runs have status 2 and no values"},
        {0}};
    static const struct option_part parts[] = {
        {.row = rows},
        {.row = option_help},
        {.text = "\nPART.h5: outputs of the commands of jostle tasks. Exit status 1: runs have "
                 "failed or are\nmissing.\n"},
        {0}};
    static const struct option_list list = {&command_merge, parts, .use = use};
    struct merge_options o = {
        .request = {.gaps = STUDY_WHOLE,
                    .result = {.existing = RESULT_KEEP, .version = JOSTLE_VERSION},
                    .poll = poll_signal,
                    .reading = crash_reading},
        .n_word = argc,
        .word = argv};
    return option_run(&list, argc, argv, &o);
}
