// SPDX-License-Identifier: GPL-3.0-or-later
// jostle merge: the parts of a study to its result file.
#include "command/crash.h"
#include "command/interrupt.h"
#include "command/output_name.h"
#include "command/show_study.h"
#include "command/study_end.h"
#include "jostle/study_merge.h"

static int merge_command(int argc, char **argv);

const struct command command_merge = {
    .name = "merge",
    .usage = "PART.h5... -o FILE.h5 [-q] [--force] [--partial]",
    .summary = "joins the parts of a study to one result file",
    .run = merge_command,
};

static const char details[] =
    "  -o, --output FILE  the result file of the study\n"
    "  -q, --quiet        prints nothing but errors\n"
    "  --force            overwrites an existing result file\n"
    "  --partial          writes the file even if parts are missing: their runs have status 2\n"
    "                     and no numbers\n"
    "  --help             this text\n\n"
    "The parts are what the commands write that jostle tasks prints. Exit status 1: runs have\n"
    "failed, or are missing.\n";

struct merge_options {
    struct study_merge_request request;
    bool quiet;
};

static int poll_signal(void *context, struct error *e) {
    (void)context;
    const int signal = interrupt_number();
    return signal ? error_set(e, STATUS_SYSTEM, "interrupted by signal %d; nothing was written",
                              signal)
                  : STATUS_OK;
}

static int take(void *options, int letter) {
    struct merge_options *o = options;
    switch (letter) {
        case 'o':
            o->request.result.path = optarg;
            return EXIT_DONE;
        case 'q':
            o->quiet = true;
            return EXIT_DONE;
        case 'f':
            o->request.result.existing = RESULT_REPLACE;
            return EXIT_DONE;
        default:
            o->request.gaps = STUDY_PARTIAL;
            return EXIT_DONE;
    }
}

// GO_ON, or the exit status.
static int parse(int argc, char **argv, struct merge_options *o) {
    static const struct option option[] = {
        {"output", required_argument, NULL, 'o'}, {"quiet", no_argument, NULL, 'q'},
        {"force", no_argument, NULL, 'f'},        {"partial", no_argument, NULL, 'p'},
        {"help", no_argument, NULL, 'h'},         {NULL, 0, NULL, 0},
    };
    static const struct command_options options = {&command_merge, details, NULL, getopt_long,
                                                   ":o:qh",        option,  take, NULL};
    struct study_merge_request *q = &o->request;
    const int status = command_parse(&options, argc, argv, o);
    q->path = (const char *const *)argv + optind;
    q->n_path = argc - optind;
    if (status == GO_ON && q->n_path < 1) {
        return command_usage(&command_merge, "the files of the parts are expected");
    }
    if (status == GO_ON && !q->result.path) {
        return command_usage(&command_merge, "-o FILE.h5 is expected");
    }
    return status;
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
    return study_end(merged.n_failed, merged.n_run, q->result.path, "");
}

static int merge_command(int argc, char **argv) {
    struct merge_options o = {
        .request = {.gaps = STUDY_WHOLE,
                    .result = {.existing = RESULT_KEEP, .version = JOSTLE_VERSION},
                    .poll = poll_signal,
                    .reading = crash_reading}};
    int status = parse(argc, argv, &o);
    if (status != GO_ON) {
        return status;
    }
    for (int i = 0; i < o.request.n_path; i++) {
        if (output_is_same_file(o.request.path[i], o.request.result.path)) {
            return command_usage(&command_merge,
                                 "%s is one of the parts; give the result another name",
                                 o.request.result.path);
        }
    }
    struct arena *a = arena_create();
    o.request.result.command_line = a ? command_line(a, argc, argv) : NULL;
    if (o.request.result.command_line) {
        interrupt_catch();
        status = merge(&o);
    } else {
        status = command_no_memory();
    }
    arena_free(a);
    return status;
}
