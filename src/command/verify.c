// SPDX-License-Identifier: GPL-3.0-or-later
// jostle verify: are the data of a result file as they were written, and do runs of a study give
// the same bits again?
#include <stdlib.h>
#include <string.h>

#include "command/interrupt.h"
#include "command/load.h"
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

static const char details[] =
    "FILE.h5 is the result of a run, of a study or of a part of one. Its data are compared with\n"
    "the SHA-256 checksum that the file has of them.\n\n"
    "  --rerun K    computes K runs of a study again, drawn at random, and compares their values\n"
    "               bit by bit\n"
    "  --seed S     of this draw, a whole number from 1; default 1\n"
    "  --run N      computes run N of the study again; may be repeated\n"
    "  --deck DECK  the deck of the study, if it is not where it was\n"
    "  --help       this text\n\n"
    "Exit status 0: the data and the runs are the same; 1: they differ; 2: wrong usage, not a\n"
    "result file, or the deck is not that of the study.\n";

enum { SEED_MAX = 2147483647 };

struct verify_options {
    const char *path;
    struct load_request load;  // the deck; path NULL: that which the file names
    struct study_rerun_request rerun;
    long *run;  // (argc) room for rerun.run
};

static int take(void *options, int letter) {
    struct verify_options *o = options;
    long seed = 1;
    int status = EXIT_DONE;
    switch (letter) {
        case 'k':
            return command_count(&command_verify, "--rerun takes a number of runs", optarg,
                                 STUDY_RUNS_MAX, &o->rerun.n_draw);
        case 's':
            status = command_count(&command_verify, "--seed takes a whole number", optarg, SEED_MAX,
                                   &seed);
            o->rerun.seed = (int)seed;
            return status;
        case 'n':
            return command_count(&command_verify, "--run takes the number of a run", optarg,
                                 STUDY_RUNS_MAX, &o->run[o->rerun.n_run++]);
        default:
            o->load.path = optarg;
            return EXIT_DONE;
    }
}

// GO_ON, or the exit status.
static int parse(int argc, char **argv, struct verify_options *o) {
    static const struct option option[] = {
        {"rerun", required_argument, NULL, 'k'}, {"seed", required_argument, NULL, 's'},
        {"run", required_argument, NULL, 'n'},   {"deck", required_argument, NULL, 'd'},
        {"help", no_argument, NULL, 'h'},        {NULL, 0, NULL, 0},
    };
    static const struct command_options options = {
        &command_verify, details, NULL, getopt_long, ":h", option, take, "run"};
    const int status = command_parse(&options, argc, argv, o);
    if (status == GO_ON && argc - optind != 1) {
        return command_usage(&command_verify, "one result file is expected, not %d", argc - optind);
    }
    o->path = argv[optind];
    o->rerun.run = o->run;
    return status;
}

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
    o->load.define = split_lines(a, v->origin.define, &o->load.n_define);
    if (!o->load.define) {
        return command_no_memory();
    }
    int status = load_model(&o->load, &m);
    if (status != EXIT_DONE) {
        return status;
    }
    o->rerun.first = m;
    o->rerun.define = o->load.define;
    o->rerun.n_define = o->load.n_define;
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

static int verify(struct verify_options *o) {
    struct result_sums sums;
    struct error e;
    if (result_verify(o->path, &sums, &e) != STATUS_OK) {
        return command_fail(&e);
    }
    safe_line(stdout, "%s: the data are as they were written", o->path);
    printf("data     SHA-256 %s\nresults  SHA-256 %s\n", sums.data.digits, sums.results.digits);
    return o->rerun.n_draw > 0 || o->rerun.n_run > 0 ? rerun(o) : EXIT_DONE;
}

static int verify_command(int argc, char **argv) {
    struct verify_options o = {.load = {.quiet = true}, .rerun = {.seed = 1, .poll = poll_signal}};
    o.run = calloc((size_t)argc, sizeof *o.run);
    if (!o.run) {
        return command_no_memory();
    }
    int status = parse(argc, argv, &o);
    status = status == GO_ON ? verify(&o) : status;
    free(o.run);
    return status;
}
