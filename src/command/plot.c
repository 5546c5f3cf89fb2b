// SPDX-License-Identifier: GPL-3.0-or-later
// jostle plot: draws a figure of a result file, or of a deck, by gnuplot, or writes its script.
#include <string.h>

#include "command/crash.h"
#include "command/deck_command.h"
#include "command/option.h"
#include "command/picture.h"
#include "command/plot_pairs.h"
#include "command/progress.h"
#include "command/study_deck.h"
#include "command/suite_options.h"
#include "core/safe.h"
#include "core/text.h"
#include "plot/figure.h"
#include "plot/pictures.h"

static int plot_command(int argc, char **argv);

const struct command command_plot = {
    .name = "plot",
    .usage = "FILE.h5 [KIND] [-o FILE.png|.svg|.pdf] [--compare OTHER.h5] [--script DIR]\n"
             "                   [--force] [--edp EDP] ...\n"
             "       jostle plot deck DECK [-D NAME=VALUE]... [-o FILE.png|.svg|.pdf] "
             "[--script DIR] [--force]",
    .summary = "draws results, or the model of a deck, with gnuplot",
    .run = plot_command,
};

enum { PLOT_PATH_SIZE = 4096, KINDS_MAX = 32 };

struct request {
    struct load_request load;  // of a deck
    const char *result, *other;
    const char *kind;             // NULL: not given
    const struct figure *figure;  // NULL: the default of the subject
    struct subject subject;
    struct runs runs;
    struct picture_options picture;
    struct suite_options study;  // for studies
    const char *deck;            // of a study; NULL: that which the file names
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

static void print_figures(enum subject_kind of) {
    for (int i = 0; i < n_figure; i++) {
        if (figures[i]->of == of) {
            printf("  %-10s %s\n", figures[i]->name, figures[i]->doc);
        }
    }
}

static void print_kinds(void) {
    printf("KIND is one of\n");
    print_figures(SUBJECT_RUNS);
    printf(
        "\nWithout KIND jostle draws the first one for which FILE.h5 has the histories. "
        "FILE.h5#7 is run 7\nof a study with 'output -histories'. KIND may also stand in front of "
        "FILE.h5.\n\n");
}

static void print_study_kinds(void) {
    printf("\nOf a study KIND is one of\n");
    print_figures(SUBJECT_STUDY);
    printf("\nWithout KIND jostle draws ida if an intensity and records are swept, else "
           "response.\n\n");
}

static int write_figure(void *context, const struct figure_files *to, struct error *e) {
    struct request *q = context;
    struct progress progress;
    progress_start(&progress, 1, "points");
    q->runs.tell = progress_tell;
    q->runs.context = &progress;
    const int status = figure_write(q->figure, &q->subject, to, e);
    progress_end(&progress);
    return status;
}

// Makes the picture of the subject and prints its name.
static int make(struct request *q, struct error *e) {
    q->figure = q->figure ? q->figure : figure_default(&q->subject);
    if (!picture_is_wanted(&q->picture)) {
        q->picture.output = name_output(q->result, q->figure->name, q->default_output);
    }
    const struct picture_request picture = {
        .options = q->picture, .name = q->figure->name, .write = write_figure, .context = q};
    const int status = picture_make(&picture, e);
    if (status == STATUS_OK && q->picture.output) {
        safe_line(stdout, "%s", q->picture.output);
    }
    return status;
}

static int plot_runs(struct request *q, struct error *e) {
    struct result_file *first = NULL, *second = NULL;
    int status = result_open(q->result, &first, e);
    if (status == STATUS_OK && q->other) {
        crash_reading(NULL, q->other);
        status = result_open(q->other, &second, e);
        crash_reading(NULL, q->result);
    }
    if (status == STATUS_OK) {
        status = runs_init(&q->runs, first, second, e);
    }
    if (status == STATUS_OK) {
        q->subject.runs = &q->runs;
        status = make(q, e);
    }
    result_close(second);
    result_close(first);
    return status;
}

// EXIT_DONE or, after a message, the exit status.
static int plot_suite(struct request *q) {
    struct suite_request request = *suite_options_request(&q->study);
    struct study_file *f;
    struct suite *s;
    struct error e;
    double *limit = NULL;
    int status = study_file_open(q->result, &f, &e);
    if (status != STATUS_OK) {
        return command_fail(&e);
    }
    request.guess = q->figure ? q->figure->guess : SUITE_ANY;
    if (q->figure && q->figure->by_run) {
        status = study_deck_suite(f, q->deck, request, &s);
    } else {
        status = suite_create(f, &request, &s, &e) == STATUS_OK ? EXIT_DONE : command_fail(&e);
    }
    if (status == EXIT_DONE) {
        status = suite_options_limits(&q->study, s, &limit, &q->subject.n_limit, &e);
        if (status == STATUS_OK) {
            suite_options_warn(s);
            q->subject.suite = s;
            q->subject.limit = limit;
            status = make(q, &e);
        }
        status = status == STATUS_OK ? EXIT_DONE : command_fail(&e);
        suite_free(s);
    }
    study_file_close(f);
    return status;
}

static int plot_deck(struct request *q) {
    struct model *m;
    struct error e;
    q->load.path = q->result;
    const int status = deck_command_load(&q->load, &m);
    if (status != EXIT_DONE) {
        return status;
    }
    q->subject.model = m;
    q->subject.version = JOSTLE_VERSION;
    const int made = make(q, &e);
    model_free(m);
    return made == STATUS_OK ? EXIT_DONE : command_fail(&e);
}

static int unknown_figure(const char *word, enum subject_kind of) {
    const char *known[KINDS_MAX];
    int n = 0;
    for (int i = 0; i < n_figure && n < KINDS_MAX; i++) {
        if (figures[i]->of == of) {
            known[n++] = figures[i]->name;
        }
    }
    return command_unknown(&command_plot, of == SUBJECT_STUDY ? "figure of studies" : "figure",
                           word, known, n);
}

// Options and figures of studies are no use for one run, where that can be opened.
static int refuse_for_run(const struct request *q, const char *dashes, const char *what) {
    struct result_file *file;
    struct error e;
    if (result_open(q->result, &file, &e) != STATUS_OK) {
        return command_fail(&e);
    }
    result_close(file);
    return command_usage(&command_plot, "%s%s is for studies; %s is one run", dashes, what,
                         q->result);
}

// Options of results are no use for a deck.
static int choose_deck(const struct request *q) {
    const char *option = q->other ? "compare" : q->study.first ? q->study.first->name : NULL;
    return option ? command_usage(&command_plot, "--%s is for results; %s is a deck", option,
                                  q->result)
                  : EXIT_DONE;
}

// Finds the figure. Returns EXIT_DONE, or what a figure or an option that is not for this file ends
// in.
static int choose(struct request *q, bool study) {
    if (q->load.define.n > 0) {
        return command_usage(&command_plot, "-D is for decks, as in 'plot deck DECK -D ...'");
    }
    if (q->other && study != study_file_is_study(q->other)) {
        return command_usage(&command_plot,
                             "--compare takes two runs or two studies; %s is a study",
                             study ? q->result : q->other);
    }
    if (study && q->other && q->kind) {
        return command_usage(&command_plot, "%s does not show two studies; leave it out", q->kind);
    }
    if (!study && q->study.first) {
        return refuse_for_run(q, "--", q->study.first->name);
    }
    if (q->kind && !q->figure) {
        return unknown_figure(q->kind, study ? SUBJECT_STUDY : SUBJECT_RUNS);
    }
    if (!q->figure || (q->figure->of == SUBJECT_STUDY) == study) {
        return EXIT_DONE;
    }
    return study ? command_usage(&command_plot,
                                 "%s is for single runs; %s is a study; name a run of it, such as "
                                 "%s#1",
                                 q->kind, q->result, q->result)
                 : refuse_for_run(q, "", q->kind);
}

// KIND stands behind the file, or in front of it.
static void take_operands(struct request *q, const struct words *operand) {
    const bool front = operand->n == 2 && figure_find(operand->word[0]) != NULL &&
                       figure_find(operand->word[1]) == NULL;
    q->result = operand->word[front ? 1 : 0];
    q->kind = operand->n == 2 ? operand->word[front ? 0 : 1] : NULL;
    q->figure = q->kind ? figure_find(q->kind) : NULL;
}

static int use(void *request, struct arena *a, const struct words *operand) {
    (void)a;
    struct request *q = request;
    struct error e;
    if (operand->n < 1 || operand->n > 2) {
        return command_usage(&command_plot, "a result file and at most one figure are expected");
    }
    const struct figure *alone = operand->n == 1 ? figure_find(operand->word[0]) : NULL;
    if (alone && alone->of == SUBJECT_DECK) {
        return command_usage(&command_plot, "%s shows a deck: plot %s DECK", alone->name,
                             alone->name);
    }
    take_operands(q, operand);
    int status = picture_check(&command_plot, &q->picture);
    if (status == EXIT_DONE && q->figure && q->figure->of == SUBJECT_DECK) {
        status = choose_deck(q);
        return status == EXIT_DONE ? plot_deck(q) : status;
    }
    crash_reading(NULL, q->result);
    const bool study = study_file_is_study(q->result);
    const char *wrong = suite_options_collapse(&q->study);
    if (status == EXIT_DONE && wrong) {
        return command_usage(&command_plot, "%s", wrong);
    }
    status = status == EXIT_DONE ? choose(q, study) : status;
    if (status != EXIT_DONE) {
        return status;
    }
    if (study && !q->other) {
        return plot_suite(q);
    }
    if (study) {
        if (!picture_is_wanted(&q->picture)) {
            q->picture.output = name_output(q->result, "compare", q->default_output);
        }
        status = plot_pairs(
            &(struct plot_pairs){{q->result, q->other}, q->study.request.edp, q->picture}, &e);
    } else {
        status = plot_runs(q, &e);
    }
    return status == STATUS_OK ? EXIT_DONE : command_fail(&e);
}

static const struct option_row rows[] = {
    {"output", 'o', "FILE", OPTION_TEXT, OPTION_LETTER_ONLY, AT(picture.output),
     .doc =
         "the plot; its extension is its format (default: FILE-KIND.png in the current directory)"},
    {"compare", 0, "OTHER.h5", OPTION_TEXT, 0, AT(other),
     .doc = "draws a second run of the same buildings over the first, or a demand of two "
            "studies, run against run"},
    {"script", 0, "DIR", OPTION_TEXT, 0, AT(picture.script_folder),
     .doc =
         "writes DIR/KIND.gp for gnuplot and its data, DIR/KIND.dat; without -o, it draws no plot"},
    {"force", .kind = OPTION_SET, .at = AT(picture.existing), .set = RESULT_REPLACE,
     .doc = "overwrites existing files"},
    DECK_DEFINE_ROW,
    {0}};

static const struct option_row study_rows[] = {
    {"edp", 0, "EDP", OPTION_TEXT, 0, AT(study.request.edp),
     .doc = "the demand: drift, drift:A, drift:A:3, force ... (default: drift-ratio, or drift "
            "without heights); 'jostle fragility --help' lists all"},
    {"im", 0, "NAME", OPTION_TEXT, 0, AT(study.request.abscissa),
     .doc =
         "the sweep that is the intensity (default: im, sa, pga, intensity or scale, or the "
         "only sweep of numbers); for cloud also a measure of the ground motions, such as PGV or "
         "Sa(1s)"},
    STUDY_DECK_ROW(AT(deck)),
    {"against", 0, "NAME", OPTION_TEXT, 0, AT(study.request.abscissa),
     .doc = "the sweep or random parameter on the horizontal axis of response"},
    {"limit", 0, "VALUE[,VALUE...]", OPTION_TEXT, 0, AT(study.limits),
     .doc = "limits of the demand, for fragility, ida and cloud"},
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
