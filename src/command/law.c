// SPDX-License-Identifier: GPL-3.0-or-later
// jostle law: isolated impacts of two bodies under contact laws, compared and fitted.
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "command/law_print.h"
#include "command/law_words.h"
#include "command/picture.h"
#include "plot/figure.h"
#include "plot/impact_figure.h"
#include "result/draft.h"

static int law_command(int argc, char **argv);

const struct command command_law = {
    .name = "law",
    .usage = "LAW ... -m1 M [-m2 M] -v V [--tsv] [--compare LAWS]... [--history FILE.tsv]\n"
             "                  [--plot FILE.png|.svg|.pdf] [--script DIR] [--fit FILE] [--force]",
    .summary = "runs one isolated impact under a contact law",
    .run = law_command,
};

static const char details[] =
    "LAW with its options stands as in a deck; bare numbers are in SI. `jostle laws` lists the "
    "laws.\n\n"
    "  -m1 M, -m2 M       masses of the bodies; without -m2 the other one is a wall\n"
    "  -v V               velocity with which they meet\n"
    "  --tsv              prints name and value, a line each, in SI, not rounded\n"
    "  --compare LAWS     sets other laws beside: LAW,LAW,... with the options of the first, or "
    "one\n"
    "                     with its own, \"LAW -k K ...\"; may be repeated\n"
    "  --history FILE     writes time, penetration, velocity and force\n"
    "  --plot FILE        draws force against time and penetration; ends in .png, .svg or .pdf\n"
    "  --script DIR       writes the picture as DIR/impact.gp for gnuplot and its data,\n"
    "                     DIR/impact.dat\n"
    "  --fit FILE         finds -k and -zeta from a measured force: time and force, separated by\n"
    "                     blanks, tabs, commas or semicolons\n"
    "  --force            overwrites what exists\n"
    "  --help             this text\n";

struct options {
    struct law_words words;
    const char **word, **compare;  // what `words` borrows
    const char *history;
    struct picture_options picture;  // what exists of the history too
    bool tsv, help;
};

// Those up to FIT have a value.
enum law_option { COMPARE, HISTORY, PLOT, SCRIPT, FIT, TSV, FORCE, HELP, N_OPTION };
static const char *const law_options[N_OPTION] = {
    [COMPARE] = "--compare", [HISTORY] = "--history", [PLOT] = "--plot",   [SCRIPT] = "--script",
    [FIT] = "--fit",         [TSV] = "--tsv",         [FORCE] = "--force", [HELP] = "--help"};

static int take_value(struct options *o, enum law_option option, const char *value) {
    if (!value) {
        return command_usage(&command_law, "option '%s' needs a value", law_options[option]);
    }
    if (option == COMPARE) {
        o->compare[o->words.n_compare++] = value;
        return EXIT_DONE;
    }
    const char **const to[N_OPTION] = {
        [HISTORY] = &o->history,
        [PLOT] = &o->picture.output,
        [SCRIPT] = &o->picture.script_folder,
        [FIT] = &o->words.fit,
    };
    if (*to[option]) {
        return command_usage(&command_law, "option '%s' is given twice", law_options[option]);
    }
    *to[option] = value;
    return EXIT_DONE;
}

static int take_flag(struct options *o, enum law_option option) {
    if (option == TSV) {
        o->tsv = true;
    } else if (option == FORCE) {
        o->picture.existing = RESULT_REPLACE;
    } else {
        o->help = true;
    }
    return EXIT_DONE;
}

// An option of the command; *behind: its value is the next word.
static int take_option(struct options *o, const char *word, const char *next, bool *behind) {
    const size_t n = strcspn(word, "=");
    enum law_option i = COMPARE;
    while (i < N_OPTION && (n != strlen(law_options[i]) || strncmp(word, law_options[i], n) != 0)) {
        i++;
    }
    if (i == N_OPTION) {
        return command_unknown(&command_law, "option", word, law_options, N_OPTION);
    }
    *behind = i <= FIT && word[n] == '\0';
    if (i <= FIT) {
        return take_value(o, i, *behind ? next : word + n + 1);
    }
    return word[n] == '='
               ? command_usage(&command_law, "option '%s' takes no value", law_options[i])
               : take_flag(o, i);
}

// Parts the command's options from the words of the law.
static int parse(int argc, char **argv, struct options *o) {
    for (int i = 1; i < argc; i++) {
        if (strncmp(argv[i], "--", 2) != 0) {
            o->help = o->help || strcmp(argv[i], "-h") == 0;
            o->word[o->words.n_word++] = argv[i];
            continue;
        }
        bool behind = false;
        const int status = take_option(o, argv[i], i + 1 < argc ? argv[i + 1] : NULL, &behind);
        if (status != EXIT_DONE) {
            return status;
        }
        i += behind;
    }
    o->words.word = o->word;
    o->words.compare = o->compare;
    return EXIT_DONE;
}

static int check(const struct options *o) {
    if (o->words.n_word == 0) {
        return command_usage(&command_law, "a contact law is expected");
    }
    if (o->word[0][0] == '-') {
        return command_usage(&command_law, "a contact law is expected before option '%s'",
                             o->word[0]);
    }
    if (picture_check(&command_law, &o->picture) != EXIT_DONE) {
        return EXIT_INPUT;
    }
    if (o->history && o->words.n_compare > 0) {
        return command_usage(&command_law, "--history writes one impact; leave out --compare");
    }
    return EXIT_DONE;
}

// Neither is written where one exists already.
static int check_existing(const struct options *o, struct error *e) {
    const char *const path[] = {o->history, o->picture.output};
    for (int i = 0; i < 2; i++) {
        int status = path[i] ? result_check_path(path[i], o->picture.existing, e) : STATUS_OK;
        if (status != STATUS_OK) {
            return status;
        }
    }
    return STATUS_OK;
}

static int write_history(const struct options *o, const struct law_impact *i, struct error *e) {
    struct draft draft;
    const int status = draft_open(&draft, o->history, o->picture.existing, e);
    if (status != STATUS_OK) {
        return status;
    }
    law_print_history(i, draft.to);
    return draft_publish(&draft, e);
}

// What is written above the picture and its panels.
struct texts {
    char title[512], subtitle[256];
};

// The line below the title of one impact.
static void subtitle(const struct law_impacts *l, struct texts *t) {
    const struct law_impact *i = &l->impact[0];
    char bodies[128];
    law_print_bodies(l, bodies, sizeof bodies);
    if (l->measured.n > 0) {
        snprintf(t->subtitle, sizeof t->subtitle, "%s; error of the fit %.3g %%", bodies,
                 100.0 * i->fit.normalised_error);
    } else {
        const double lost = law_print_dissipated(l, i);
        snprintf(t->subtitle, sizeof t->subtitle,
                 lost < 100.0 ? "%s; %.3g J lost" : "%s; %.3g kJ lost", bodies,
                 lost < 100.0 ? lost : lost / 1e3);
    }
}

static int write_figure(void *context, const struct figure_files *to, struct error *e) {
    const struct law_impacts *l = context;
    struct impact_curve curve[IMPACT_FIGURE_CURVES];
    struct texts t = {.title = "Isolated impact"};
    if (l->n == 1) {
        law_words(l->impact[0].choice.law, l->impact[0].value, t.title, sizeof t.title);
        subtitle(l, &t);
    } else {
        law_print_bodies(l, t.subtitle, sizeof t.subtitle);
    }
    int n = 0;
    for (int i = 0; i < l->n; i++) {
        const struct law_impact *at = &l->impact[i];
        if (!isnan(at->impact.peak_force)) {
            curve[n++] = (struct impact_curve){at->choice.law->name, at->n_point, at->point,
                                               l->measured.n > 0 ? at->fit.start.value : 0.0};
        }
    }
    const struct impact_figure figure = {
        .title = t.title,
        .subtitle = t.subtitle,
        .impact = l->n == 1 ? &l->impact[0].impact : NULL,
        .nominal = l->impact[0].nominal,
        .version = JOSTLE_VERSION,
        .n_curve = n,
        .curve = curve,
        .n_sample = l->measured.n,
        .time = l->measured.time,
        .force = l->measured.value,
    };
    return impact_figure_write(&figure, to, e);
}

static int draw(const struct options *o, struct law_impacts *l, struct error *e) {
    int n = 0;
    for (int i = 0; i < l->n; i++) {
        n += !isnan(l->impact[i].impact.peak_force);
    }
    if (n == 0) {
        return error_set(e, STATUS_INPUT, "%s has no force to draw", l->impact[0].choice.law->name);
    }
    if (n > IMPACT_FIGURE_CURVES) {
        return error_set(e, STATUS_INPUT, "a picture shows at most %d laws, not %d",
                         IMPACT_FIGURE_CURVES, n);
    }
    const struct picture_request picture = {
        .options = o->picture, .name = "impact", .write = write_figure, .context = l};
    return picture_make(&picture, e);
}

static int report(const struct options *o, struct law_impacts *l) {
    struct error e;
    int status = check_existing(o, &e);
    if (status == STATUS_OK && o->history) {
        status = write_history(o, &l->impact[0], &e);
    }
    if (status == STATUS_OK && picture_is_wanted(&o->picture)) {
        status = draw(o, l, &e);
    }
    if (status != STATUS_OK) {
        return command_fail(&e);
    }
    law_print_warnings(l, stderr);
    if (o->tsv) {
        law_print_tsv(l, stdout);
    } else {
        law_print_table(l, stdout);
    }
    return EXIT_DONE;
}

static int run(int argc, char **argv, struct options *o) {
    int status = parse(argc, argv, o);
    if (status == EXIT_DONE && o->help) {
        return command_help(&command_law, details);
    }
    if (status == EXIT_DONE) {
        status = check(o);
    }
    struct law_impacts impacts;
    if (status == EXIT_DONE) {
        status = law_impacts_run(&o->words, &impacts);
    }
    if (status == EXIT_DONE) {
        status = report(o, &impacts);
        law_impacts_free(&impacts);
    }
    return status;
}

static int law_command(int argc, char **argv) {
    struct options o = {.picture.existing = RESULT_KEEP};
    o.word = calloc((size_t)argc, sizeof *o.word);
    o.compare = calloc((size_t)argc, sizeof *o.compare);
    const int status = o.word && o.compare ? run(argc, argv, &o) : command_no_memory();
    free(o.word);
    free(o.compare);
    return status;
}
