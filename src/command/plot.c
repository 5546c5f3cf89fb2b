// SPDX-License-Identifier: GPL-3.0-or-later
// jostle plot: draws a figure of a result file by gnuplot, or writes its script.
#include <assert.h>
#include <string.h>

#include "command/crash.h"
#include "command/option.h"
#include "command/picture.h"
#include "command/progress.h"
#include "command/suite_options.h"
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

enum { PLOT_PATH_SIZE = 4096 };

struct request {
    const char *result, *other;
    const struct figure *figure;  // NULL: the first that the files have the data for
    struct runs runs;
    struct picture_options picture;
    const char *kind;            // NULL: not given
    struct suite_options study;  // for studies
    char default_output[PLOT_PATH_SIZE];
};
#define AT(member) offsetof(struct request, member)

// FILE.h5 -> FILE-KIND.png, FILE.h5#7 -> FILE-7-KIND.png, without its folder, into `name`
// (PLOT_PATH_SIZE); returns it.
static const char *name_output(const char *result, const char *kind, char *name) {
    size_t n;
    const char *stem = text_stem(result, &n);
    const char *run = strchr(stem + n, '#');
    snprintf(name, PLOT_PATH_SIZE, "%.*s%s%s-%s.png", (int)n, stem, run ? "-" : "",
             run ? run + 1 : "", kind);
    return name;
}

// The picture of a study.
struct job {
    struct request *request;
    const struct study_figure *figure;  // NULL: what shows the suite best
    struct study_picture picture;
};

static void print_study_kinds(void) {
    printf("\nOf a study KIND is one of\n");
    for (int i = 0; i < n_study_figure; i++) {
        printf("  %-10s %s\n", study_figures[i]->name, study_figures[i]->doc);
    }
    printf(
        "\nWithout KIND it is ida, where an intensity and records are swept, else response.\n\n");
}

// EXIT_DONE with the figure asked for, or EXIT_INPUT.
static int find_figure(struct job *j) {
    const struct request *q = j->request;
    if (!q->kind || (j->figure = study_figure_find(q->kind)) != NULL) {
        return EXIT_DONE;
    }
    if (figure_find(q->kind)) {
        return command_usage(&command_plot,
                             "%s is for single runs; %s is a study; name a run of it, such as "
                             "%s#1",
                             q->kind, q->result, q->result);
    }
    const char *known[8];
    int n = 0;
    for (; n < n_study_figure && n < 8; n++) {
        assert(study_figures[n]);
        known[n] = study_figures[n]->name;
    }
    return command_unknown(&command_plot, "figure of studies", q->kind, known, n);
}

static int write_study_figure(void *context, const struct figure_files *to, struct error *e) {
    const struct job *j = context;
    return study_figure_write(j->figure, &j->picture, to, e);
}

static int draw(struct job *j, const struct suite *s, struct error *e) {
    struct request *q = j->request;
    double *limit = NULL;
    j->picture.suite = s;
    j->figure = j->figure ? j->figure : study_figure_default(s);
    int status = suite_options_limits(&q->study, s, &limit, &j->picture.n_limit, e);
    j->picture.limit = limit;
    if (status != STATUS_OK) {
        return status;
    }
    suite_options_warn(s);
    struct picture_request picture = {
        .options = q->picture, .name = j->figure->name, .write = write_study_figure, .context = j};
    if (!picture_is_wanted(&q->picture)) {
        picture.options.output = name_output(q->result, j->figure->name, q->default_output);
    }
    status = picture_make(&picture, e);
    if (status == STATUS_OK && picture.options.output) {
        safe_line(stdout, "%s", picture.options.output);
    }
    return status;
}

static void print_kinds(void) {
    printf("KIND is one of\n");
    for (int i = 0; i < n_figure; i++) {
        printf("  %-10s %s\n", figures[i]->name, figures[i]->doc);
    }
    printf("\nWithout KIND it is the first one that FILE.h5 holds the histories for. FILE.h5#7 is "
           "run 7\nof a study whose deck has 'output -histories'.\n\n");
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
        q->picture.output = name_output(q->result, q->figure->name, q->default_output);
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
        crash_reading(NULL, q->other);
        status = result_open(q->other, &second, e);
        crash_reading(NULL, q->result);
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
        char name[32];
        snprintf(name, sizeof name, "--%s", q->study.first->name);
        return refuse(q, name);
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

static int plot_suite(struct request *q) {
    if (q->other) {
        return command_usage(&command_plot, "--compare is for single runs; %s is a study",
                             q->result);
    }
    struct job j = {.request = q};
    struct study_file *f;
    struct suite *s;
    struct error e;
    int status = find_figure(&j);
    if (status != EXIT_DONE) {
        return status;
    }
    if (study_file_open(q->result, &f, &e) != STATUS_OK) {
        return command_fail(&e);
    }
    struct suite_request request = *suite_options_request(&q->study);
    request.guess = j.figure ? j.figure->guess : SUITE_ANY;
    status = suite_create(f, &request, &s, &e);
    if (status == STATUS_OK) {
        status = draw(&j, s, &e);
        suite_free(s);
    }
    study_file_close(f);
    return status == STATUS_OK ? EXIT_DONE : command_fail(&e);
}

static int use(void *request, struct arena *a, const struct words *operand) {
    (void)a;
    struct request *q = request;
    if (operand->n < 1 || operand->n > 2) {
        return command_usage(&command_plot, "a result file and at most one figure are expected");
    }
    q->result = operand->word[0];
    q->kind = operand->n == 2 ? operand->word[1] : NULL;
    const int status = picture_check(&command_plot, &q->picture);
    if (status != EXIT_DONE) {
        return status;
    }
    crash_reading(NULL, q->result);
    return study_file_is_study(q->result) ? plot_suite(q) : plot_run(q);
}

static const struct option_row rows[] = {
    {"output", 'o', "FILE", OPTION_TEXT, OPTION_LETTER_ONLY, AT(picture.output),
     .doc = "the picture; the ending says its kind (default: FILE-KIND.png in the current "
            "directory)"},
    {"compare", 0, "OTHER.h5", OPTION_TEXT, 0, AT(other),
     .doc = "lays a second run of the same buildings over the first"},
    {"script", 0, "DIR", OPTION_TEXT, 0, AT(picture.script_folder),
     .doc = "writes DIR/KIND.gp for gnuplot and its data, DIR/KIND.dat; without -o, nothing else"},
    {"force", .kind = OPTION_SET, .at = AT(picture.existing), .set = RESULT_REPLACE,
     .doc = "overwrites what exists"},
    {0}};

static const struct option_row study_rows[] = {
    {"edp", 0, "EDP", OPTION_TEXT, 0, AT(study.request.edp),
     .doc = "what is shown: drift, drift:A, drift:A:3, force ... (default: drift-ratio, or drift "
            "where no heights are given); 'jostle fragility --help' lists all"},
    {"im", 0, "NAME", OPTION_TEXT, 0, AT(study.request.abscissa),
     .doc = "the sweep that is the intensity (default: im, sa, pga, intensity or scale, or the "
            "only sweep of numbers)"},
    {"against", 0, "NAME", OPTION_TEXT, 0, AT(study.request.abscissa),
     .doc = "the sweep or random parameter that response is drawn against"},
    {"limit", 0, "VALUE[,VALUE...]", OPTION_TEXT, 0, AT(study.limits),
     .doc = "limits of the demand, for fragility and ida"},
    {0}};

static int plot_command(int argc, char **argv) {
    static const struct option_part parts[] = {
        {.print = print_kinds},
        {.row = rows},
        {.row = option_help},
        {.print = print_study_kinds},
        {.row = study_rows, .first = AT(study.first)},
        {.row = suite_options_rows, .at = AT(study), .first = AT(study.first)},
        {0}};
    static const struct option_list list = {&command_plot, parts, .use = use};
    struct request q = {.picture.existing = RESULT_KEEP};
    return option_run(&list, argc, argv, &q);
}
