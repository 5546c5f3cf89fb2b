// SPDX-License-Identifier: GPL-3.0-or-later
// jostle law: isolated impacts of two bodies under contact laws, compared and fitted.
#include <math.h>

#include "command/law_print.h"
#include "command/option.h"
#include "command/picture.h"
#include "plot/figure.h"
#include "plot/pictures.h"
#include "result/partial_file.h"

static int law_command(int argc, char **argv);

const struct command command_law = {
    .name = "law",
    .usage = "LAW ... -m1 M [-m2 M] -v V [--tsv|--csv|--json] [--compare LAWS]...\n"
             "                  [--history FILE.tsv] [--plot FILE.png|.svg|.pdf] [--script DIR]\n"
             "                  [--fit FILE] [--force]",
    .summary = "computes one isolated impact under a contact law",
    .run = law_command,
};

struct options {
    struct law_words words;
    struct words compare;
    const char *history;
    struct picture_options picture;  // what exists of the history too
    enum printer_form form;
};
#define AT(member) offsetof(struct options, member)

static int check(const struct options *o) {
    if (o->words.n_word == 0) {
        return command_usage(&command_law, "a contact law is expected");
    }
    if (o->words.word[0][0] == '-') {
        return command_usage(&command_law, "a contact law is expected before option '%s'",
                             o->words.word[0]);
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

// Returns the exit status.
static int write_history(const struct options *o, const struct law_impact *i) {
    struct partial_file partial;
    struct error e;
    if (partial_file_open(&partial, o->history, o->picture.existing, &e) != STATUS_OK) {
        return command_fail(&e);
    }
    const int status = law_print_history(i, partial.to);
    if (status != EXIT_DONE) {
        partial_file_drop(&partial);
        return status;
    }
    return partial_file_publish(&partial, &e) == STATUS_OK ? EXIT_DONE : command_fail(&e);
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
        law_print_words(l->impact[0].choice.law, l->impact[0].value, t.title, sizeof t.title);
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
    if (check_existing(o, &e) != STATUS_OK) {
        return command_fail(&e);
    }
    if (o->history) {
        const int status = write_history(o, &l->impact[0]);
        if (status != EXIT_DONE) {
            return status;
        }
    }
    if (picture_is_wanted(&o->picture) && draw(o, l, &e) != STATUS_OK) {
        return command_fail(&e);
    }
    law_print_warnings(l, stderr);
    return law_print(l, o->form, stdout);
}

static int use(void *options, struct arena *a, const struct words *operand) {
    (void)a;
    struct options *o = options;
    struct law_impacts impacts;
    o->words.word = operand->word;
    o->words.n_word = operand->n;
    o->words.compare = o->compare.word;
    o->words.n_compare = o->compare.n;
    int status = check(o);
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
    static const struct option_row rows[] = {
        {"compare", 0, "LAWS", OPTION_WORDS, 0, AT(compare),
         .doc = "computes other laws too: LAW,LAW,... with the options of the first one, or one "
                "law with its own options, \"LAW -k K ...\"; may be repeated"},
        {"history", 0, "FILE", OPTION_TEXT, 0, AT(history),
         .doc = "writes time, penetration, velocity and force"},
        {"plot", 0, "FILE", OPTION_TEXT, 0, AT(picture.output),
         .doc = "draws the force against time and penetration; extension .png, .svg or .pdf"},
        {"script", 0, "DIR", OPTION_TEXT, 0, AT(picture.script_folder),
         .doc = "writes the plot as DIR/impact.gp for gnuplot and its data, DIR/impact.dat"},
        {"fit", 0, "FILE", OPTION_TEXT, 0, AT(words.fit),
         .doc = "finds -k and -zeta from a measured force: two columns, time and force, separated "
                "by spaces, tabs, commas or semicolons"},
        {"force", .kind = OPTION_SET, .at = AT(picture.existing), .set = RESULT_REPLACE,
         .doc = "overwrites existing files"},
        {"tsv", .kind = OPTION_SET, .at = AT(form), .set = FORM_TSV,
         .doc = "one name and value per line, in SI, not rounded"},
        {0}};
    static const struct option_part parts[] = {
        {.text = "LAW and its options are those of a deck; bare numbers are in SI. `jostle laws` "
                 "lists the laws.\n\n  -m1 M, -m2 M    masses of the bodies; without -m2 the other "
                 "one is a wall\n  -v V            closing velocity\n"},
        {.row = rows},
        {.row = printer_rows, .at = AT(form)},
        {.row = option_help},
        {0}};
    static const struct option_list list = {&command_law, parts, DASH_LAW, .use = use};
    struct options o = {.picture.existing = RESULT_KEEP};
    return option_run(&list, argc, argv, &o);
}
