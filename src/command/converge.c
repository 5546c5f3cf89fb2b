// SPDX-License-Identifier: GPL-3.0-or-later
// jostle converge: a deck at ever shorter steps, and what that says of the error of its results.
#include <errno.h>
#include <math.h>
#include <stdlib.h>

#include "command/converge_print.h"
#include "command/deck_command.h"
#include "command/progress.h"

static int converge_command(int argc, char **argv);

const struct command command_converge = {
    .name = "converge",
    .usage = "DECK [-D NAME=VALUE]... [-n LEVELS] [--rtol R] [--tsv]",
    .summary = "runs a deck at ever shorter steps and prints the errors of its results",
    .run = converge_command,
};

static const char details[] =
    "  -D NAME=VALUE  overrides a param of the deck; may be repeated\n"
    "  -n LEVELS      runs, each at half the step of the one before, from that of the deck;\n"
    "                 3 to 16, default 4\n"
    "  --rtol R       what counts as converged: an error bar of at most R times the result;\n"
    "                 default 1e-3\n"
    "  --tsv          a table separated by tabs, with the results of all levels\n"
    "  --help         this text\n\n"
    "Nothing is written. Exit status: 0 all results have converged, 1 some have not.\n";

enum { LEVELS_DEFAULT = 4 };
static const double RTOL_DEFAULT = 1e-3;

struct options {
    struct load_request load;
    int n_level;
    double rtol;
    bool tsv;
};

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
    if (o->tsv) {
        converge_print_tsv(m, r);
    } else {
        converge_print(m, r, o->rtol);
    }
    status = r->n_within == r->n_result ? EXIT_DONE : EXIT_FAILED;
    refinement_free(r);
    return status;
}

// A number from `least` to `most`; EXIT_DONE, or the status of a message.
static int parse_number(const char *option, const char *text, double least, double most,
                        double *out) {
    char *end;
    errno = 0;
    *out = strtod(text, &end);
    if (errno || end == text || *end || !(*out >= least && *out <= most)) {
        return command_usage(&command_converge, "%s takes a number from %g to %g, not '%s'", option,
                             least, most, text);
    }
    return EXIT_DONE;
}

static int parse_levels(const char *text, int *n_level) {
    double n;
    int status = parse_number("-n", text, CONVERGENCE_LEVELS_MIN, CONVERGENCE_LEVELS_MAX, &n);
    if (status == EXIT_DONE && n != floor(n)) {
        return command_usage(&command_converge, "-n takes a whole number, not '%s'", text);
    }
    *n_level = status == EXIT_DONE ? (int)n : 0;
    return status;
}

static int take(void *options, int letter) {
    struct options *o = options;
    switch (letter) {
        case 'n':
            return parse_levels(optarg, &o->n_level);
        case 'r':
            return parse_number("--rtol", optarg, 1e-12, 1.0, &o->rtol);
        default:
            o->tsv = true;
            return EXIT_DONE;
    }
}

static int converge_command(int argc, char **argv) {
    static const struct option option[] = {{"levels", required_argument, NULL, 'n'},
                                           {"rtol", required_argument, NULL, 'r'},
                                           {"tsv", no_argument, NULL, 't'},
                                           DECK_COMMAND_OPTIONS};
    static const struct deck_command c = {&command_converge, details, ":D:n:h", option, take, NULL,
                                          converge};
    struct options o = {.n_level = LEVELS_DEFAULT, .rtol = RTOL_DEFAULT};
    return deck_command_run(&c, argc, argv, &o.load, &o);
}
