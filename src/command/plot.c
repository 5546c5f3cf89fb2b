// SPDX-License-Identifier: GPL-3.0-or-later
// jostle plot: draws a figure of a result file by gnuplot, or writes its script.
#include <assert.h>
#include <string.h>

#include "command/command.h"
#include "command/picture.h"
#include "command/plot_names.h"
#include "command/plot_study.h"
#include "command/progress.h"
#include "core/safe.h"
#include "core/text.h"
#include "plot/figure.h"
#include "plot/study_figure.h"

static int plot_command(int argc, char **argv);

const struct command command_plot = {
    .name = "plot",
    .usage = "FILE.h5 [KIND] [-o FILE.png|.svg|.pdf] [--compare OTHER.h5] [--script DIR]\n"
             "                   [--force] [--edp EDP] ...",
    .summary = "draws the results by gnuplot",
    .run = plot_command,
};

struct request {
    const char *result, *other;
    const struct figure *figure;  // NULL: the first that the files have the data for
    struct runs runs;
    struct picture_options picture;
    const char *kind;            // NULL: not given
    struct suite_options study;  // for studies
    char default_output[PLOT_PATH_SIZE];
};

static void print_details(void) {
    printf("KIND is one of\n");
    for (int i = 0; i < n_figure; i++) {
        printf("  %-10s %s\n", figures[i]->name, figures[i]->doc);
    }
    printf(
        "\n"
        "Without KIND it is the first one that FILE.h5 holds the histories for. FILE.h5#7 is run "
        "7\n"
        "of a study whose deck has 'output -histories'.\n"
        "\n"
        "  -o FILE        the picture; the ending says its kind (default: FILE-KIND.png in the\n"
        "                 current directory)\n"
        "  --compare OTHER.h5\n"
        "                 lays a second run of the same buildings over the first\n"
        "  --script DIR   writes DIR/KIND.gp for gnuplot and its data, DIR/KIND.dat; without -o,\n"
        "                 nothing else\n"
        "  --force        overwrites what exists\n"
        "  --help         this text\n");
    plot_study_help();
}

static int take(void *request, int letter) {
    struct request *q = request;
    switch (letter) {
        case 'o':
            q->picture.output = optarg;
            return EXIT_DONE;
        case 'c':
            q->other = optarg;
            return EXIT_DONE;
        case 's':
            q->picture.script_folder = optarg;
            return EXIT_DONE;
        case 'f':
            q->picture.existing = RESULT_REPLACE;
            return EXIT_DONE;
        default:
            return suite_options_take(&command_plot, letter, &q->study);
    }
}

static int unknown_figure(const char *word) {
    const char *known[32];
    int n = 0;
    for (; n < n_figure && n < 32; n++) {
        assert(figures[n]);
        known[n] = figures[n]->name;
    }
    return command_unknown(&command_plot, "figure", word, known, n);
}

const char *plot_name_output(const char *result, const char *kind, char *name) {
    size_t n;
    const char *stem = text_stem(result, &n);
    const char *run = strchr(stem + n, '#');
    snprintf(name, PLOT_PATH_SIZE, "%.*s%s%s-%s.png", (int)n, stem, run ? "-" : "",
             run ? run + 1 : "", kind);
    return name;
}

// GO_ON, or the exit status.
static int parse(int argc, char **argv, struct request *q) {
    static const struct option option[] = {
        {"output", required_argument, NULL, 'o'},
        {"compare", required_argument, NULL, 'c'},
        {"script", required_argument, NULL, 's'},
        {"force", no_argument, NULL, 'f'},
        {"help", no_argument, NULL, 'h'},
        {"against", required_argument, NULL, SUITE_IM},
        SUITE_OPTIONS,
        {NULL, 0, NULL, 0},
    };
    static const struct command_options options = {
        &command_plot, "", print_details, getopt_long, ":ho:", option, take, SUITE_REPEATABLE};
    const int status = command_parse(&options, argc, argv, q);
    if (status != GO_ON) {
        return status;
    }
    const int n = argc - optind;
    if (n < 1 || n > 2) {
        return command_usage(&command_plot, "a result file and at most one figure are expected");
    }
    q->result = argv[optind];
    q->kind = n == 2 ? argv[optind + 1] : NULL;
    return picture_check(&command_plot, &q->picture) == EXIT_DONE ? GO_ON : EXIT_INPUT;
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
    if (!picture_is_wanted(&q->picture)) {
        q->picture.output = plot_name_output(q->result, q->figure->name, q->default_output);
    }
    const struct picture_request picture = {
        .options = q->picture,
        .name = q->figure->name,
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

// Options and figures of studies are no use for one run.
static int refuse(const struct request *q, const char *what) {
    struct result_file *file;
    struct error e;
    if (result_open(q->result, &file, &e) != STATUS_OK) {
        return command_fail(&e);
    }
    result_close(file);
    return command_usage(&command_plot, "%s is for studies; %s is one run", what, q->result);
}

static int plot_run(struct request *q) {
    if (q->study.first) {
        return refuse(q, q->study.first);
    }
    q->figure = q->kind ? figure_find(q->kind) : NULL;
    if (q->kind && !q->figure) {
        return study_figure_find(q->kind) ? refuse(q, q->kind) : unknown_figure(q->kind);
    }
    struct error e;
    if (open_and_make(q, &e) != STATUS_OK) {
        return command_fail(&e);
    }
    if (q->picture.output) {
        safe_line(stdout, "%s", q->picture.output);
    }
    return EXIT_DONE;
}

static int plot_suite(const struct request *q) {
    if (q->other) {
        return command_usage(&command_plot, "--compare is for single runs; %s is a study",
                             q->result);
    }
    const struct plot_study_request study = {.command = &command_plot,
                                             .path = q->result,
                                             .kind = q->kind,
                                             .options = &q->study,
                                             .picture = q->picture};
    return plot_study(&study);
}

static int plot_command(int argc, char **argv) {
    struct request q = {.picture.existing = RESULT_KEEP};
    struct error e;
    if (suite_options_init(&q.study, argc, &e) != STATUS_OK) {
        return command_fail(&e);
    }
    int status = parse(argc, argv, &q);
    if (status == GO_ON) {
        status = study_file_is_study(q.result) ? plot_suite(&q) : plot_run(&q);
    }
    suite_options_close(&q.study);
    return status;
}
