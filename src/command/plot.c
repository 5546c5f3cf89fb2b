// SPDX-License-Identifier: GPL-3.0-or-later
// jostle plot: draws a figure of a result file by gnuplot, or writes its script.
#include <assert.h>
#include <getopt.h>
#include <string.h>

#include "command/command.h"
#include "command/picture.h"
#include "command/progress.h"
#include "core/text.h"
#include "plot/figure.h"

static int plot_command(int argc, char **argv);

const struct command command_plot = {
    .name = "plot",
    .usage = "FILE.h5 [KIND] [-o FILE.png|.svg|.pdf] [--compare OTHER.h5] [--script DIR] [--force]",
    .summary = "draws the results by gnuplot",
    .run = plot_command,
};

enum { PATH_SIZE = 4096 };

struct request {
    const char *result, *other, *output, *script_folder;
    const struct figure *figure;  // NULL: the first that the files have the data for
    struct runs runs;
    enum result_existing existing;
    char default_output[PATH_SIZE];
};

static int help(void) {
    printf("usage: jostle %s %s\n\n%s\n\nKIND is one of\n", command_plot.name, command_plot.usage,
           command_plot.summary);
    for (int i = 0; i < n_figure; i++) {
        printf("  %-10s %s\n", figures[i]->name, figures[i]->doc);
    }
    printf(
        "\n"
        "Without KIND it is the first one that FILE.h5 holds the histories for.\n"
        "\n"
        "  -o FILE        the picture; the ending says its kind (default: FILE-KIND.png in the\n"
        "                 current directory)\n"
        "  --compare OTHER.h5\n"
        "                 lays a second run of the same buildings over the first\n"
        "  --script DIR   writes DIR/KIND.gp for gnuplot and its data, DIR/KIND.dat; without -o,\n"
        "                 nothing else\n"
        "  --force        overwrites what exists\n"
        "  --help         this text\n");
    return EXIT_DONE;
}

static int parse_options(int argc, char **argv, struct request *q) {
    static const struct option option[] = {
        {"output", required_argument, NULL, 'o'}, {"compare", required_argument, NULL, 'c'},
        {"script", required_argument, NULL, 's'}, {"force", no_argument, NULL, 'f'},
        {"help", no_argument, NULL, 'h'},         {NULL, 0, NULL, 0},
    };
    opterr = 0;
    optind = 1;
    for (int c; (c = getopt_long(argc, argv, ":ho:", option, NULL)) != -1;) {
        switch (c) {
            case 'o':
                q->output = optarg;
                break;
            case 'c':
                q->other = optarg;
                break;
            case 's':
                q->script_folder = optarg;
                break;
            case 'f':
                q->existing = RESULT_REPLACE;
                break;
            case 'h':
                return help();
            default:
                return command_bad_option(&command_plot, c, argv);
        }
    }
    return -1;
}

static int unknown_figure(const char *word) {
    const char *known[32];
    int n = 0;
    for (; n < n_figure && n < 32; n++) {
        assert(figures[n]);
        known[n] = figures[n]->name;
    }
    const char *near = text_nearest(word, known, n);
    return near
               ? command_usage(&command_plot, "unknown figure '%s'; did you mean '%s'?", word, near)
               : command_usage(&command_plot, "unknown figure '%s'", word);
}

// FILE.h5 -> FILE-KIND.png without its folder.
static void name_output(struct request *q) {
    const char *slash = strrchr(q->result, '/');
    const char *base = slash ? slash + 1 : q->result;
    const char *dot = strrchr(base, '.');
    const int n = dot && dot != base ? (int)(dot - base) : (int)strlen(base);
    snprintf(q->default_output, sizeof q->default_output, "%.*s-%s.png", n, base, q->figure->name);
    q->output = q->default_output;
}

// Returns -1 when there is something to do, else the exit status.
static int parse(int argc, char **argv, struct request *q) {
    const int done = parse_options(argc, argv, q);
    if (done >= 0) {
        return done;
    }
    const int n = argc - optind;
    if (n < 1 || n > 2) {
        return command_usage(&command_plot, "a result file and at most one figure are expected");
    }
    q->result = argv[optind];
    q->figure = n == 2 ? figure_find(argv[optind + 1]) : NULL;
    if (n == 2 && !q->figure) {
        return unknown_figure(argv[optind + 1]);
    }
    if (q->output && !figure_ending(q->output)) {
        return command_usage(&command_plot, "'%s' must end in .png, .svg or .pdf", q->output);
    }
    return -1;
}

static int write_figure(void *context, const struct figure_files *to, struct error *e) {
    struct request *q = context;
    struct progress progress;
    progress_start(&progress, 1, "points");
    q->runs.tell = progress_tell;
    q->runs.context = &progress;
    const int status = figure_write(q->figure, &q->runs, to, e);
    progress_end(&progress);
    return status;
}

static int make(struct request *q, const struct result_file *first,
                const struct result_file *second, struct error *e) {
    int status = runs_init(&q->runs, first, second, e);
    if (status != STATUS_OK) {
        return status;
    }
    if (!q->figure) {
        q->figure = figure_default(&q->runs);
    }
    if (!q->output && !q->script_folder) {
        name_output(q);
    }
    const struct picture_request picture = {
        .name = q->figure->name,
        .output = q->output,
        .script_folder = q->script_folder,
        .existing = q->existing,
        .write = write_figure,
        .context = q,
    };
    return picture_make(&picture, e);
}

static int open_and_make(struct request *q, struct error *e) {
    struct result_file *first = NULL, *second = NULL;
    int status = result_open(q->result, &first, e);
    if (status == STATUS_OK && q->other) {
        status = result_open(q->other, &second, e);
    }
    if (status == STATUS_OK) {
        status = make(q, first, second, e);
    }
    result_close(second);
    result_close(first);
    return status;
}

static int plot_command(int argc, char **argv) {
    struct request q = {.existing = RESULT_KEEP};
    const int done = parse(argc, argv, &q);
    if (done >= 0) {
        return done;
    }
    struct error e;
    if (open_and_make(&q, &e) != STATUS_OK) {
        return command_fail(&e);
    }
    if (q.output) {
        printf("%s\n", q.output);
    }
    return EXIT_DONE;
}
