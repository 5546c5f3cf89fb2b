// SPDX-License-Identifier: GPL-3.0-or-later
// jostle law: isolated impacts of two bodies under contact laws, compared and fitted.
#include <math.h>
#include <string.h>

#include "command/law_over.h"
#include "command/law_print.h"
#include "command/law_storey.h"
#include "command/option.h"
#include "command/picture.h"
#include "core/quantity.h"
#include "plot/figure.h"
#include "plot/pictures.h"
#include "result/partial_file.h"

static int law_command(int argc, char **argv);

const struct command command_law = {
    .name = "law",
    .usage = "LAW ... -m1 M [-m2 M] -v V [--tsv|--csv|--json] [--compare LAWS]...\n"
             "                  [--history FILE.tsv] [--plot FILE.png|.svg|.pdf] [--script DIR]\n"
             "                  [--fit FILE | --peak FORCE] [--over LIST] [--force]\n"
             "       jostle law storey|hinge|link LAW ... -stiffness K -amplitude D\n"
             "                  [--protocol fema461|sac|FILE] and the options above",
    .summary = "computes one isolated impact under a contact law, or the loops of another law",
    .run = law_command,
};

struct options {
    struct law_words words;
    struct words compare;
    const struct law_storey_kind *of_storey;  // NULL: a contact
    const char *peak, *over;
    const char *protocol;
    const char *history;
    struct picture_options picture;  // what exists of the history too
    enum printer_form form;
};
#define AT(member) offsetof(struct options, member)

// The peak force of --peak [N].
static int read_peak(struct options *o) {
    if (o->of_storey || o->words.fit) {
        return command_usage(&command_law, "--peak is for contact laws, and not with --fit");
    }
    if (!quantity_whole(o->peak, &dimension_force, BARE_ALLOWED, &o->words.peak) ||
        !(o->words.peak > 0.0)) {
        return command_usage(&command_law, "--peak is '%s'; it must be a force above 0, as 12kN",
                             o->peak);
    }
    return EXIT_DONE;
}

static int check(const struct options *o) {
    const char *kind = o->of_storey ? o->of_storey->name : "contact";
    if (o->words.n_word == 0) {
        return command_usage(&command_law, "a %s law is expected", kind);
    }
    if (o->words.word[0][0] == '-') {
        return command_usage(&command_law, "a %s law is expected before option '%s'", kind,
                             o->words.word[0]);
    }
    if (o->protocol && !o->of_storey) {
        return command_usage(&command_law, "--protocol is for storey laws: jostle law storey LAW");
    }
    if (o->protocol && o->words.fit) {
        return command_usage(&command_law, "--fit follows the measured loop; leave out --protocol");
    }
    if (picture_check(&command_law, &o->picture) != EXIT_DONE) {
        return EXIT_INPUT;
    }
    if (o->history && o->words.n_compare > 0) {
        return command_usage(&command_law, "--history writes one law; leave out --compare");
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

// What one of both kinds of laws gives.
struct law_output {
    const void *laws;
    int (*history)(const void *laws, FILE *to);  // returns the exit status
    int (*draw)(const struct options *o, const void *laws, struct error *e);
    void (*warn)(const void *laws, FILE *to);
    int (*print)(const void *laws, enum printer_form form, FILE *to);  // returns the exit status
};

// Returns the exit status.
static int write_history(const struct options *o, const struct law_output *out) {
    struct partial_file partial;
    struct error e;
    if (partial_file_open(&partial, o->history, o->picture.existing, &e) != STATUS_OK) {
        return command_fail(&e);
    }
    const int status = out->history(out->laws, partial.to);
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

static int write_impacts(void *context, const struct figure_files *to, struct error *e) {
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

static int draw_impacts(const struct options *o, const void *laws, struct error *e) {
    const struct law_impacts *l = laws;
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
        .options = o->picture, .name = "impact", .write = write_impacts, .context = (void *)l};
    return picture_make(&picture, e);
}

static int impact_history(const void *laws, FILE *to) {
    return law_print_history(&((const struct law_impacts *)laws)->impact[0], to);
}

static void warn_of_impacts(const void *laws, FILE *to) {
    law_print_warnings(laws, to);
}

static int print_impacts(const void *laws, enum printer_form form, FILE *to) {
    return law_print(laws, form, to);
}

static int write_loops(void *context, const struct figure_files *to, struct error *e) {
    const struct law_storeys *l = context;
    struct loop_curve curve[LOOP_FIGURE_CURVES];
    struct texts t;
    snprintf(t.title, sizeof t.title, "Loops of %s", l->n == 1 ? l->storey[0].law.name : "laws");
    snprintf(t.subtitle, sizeof t.subtitle, "%s %s", l->shear ? "measured:" : "protocol",
             l->protocol);
    if (l->n == 1) {
        law_storey_text(&l->storey[0], t.title, sizeof t.title);
    }
    for (int i = 0; i < l->n; i++) {
        curve[i] =
            (struct loop_curve){l->storey[i].law.name, l->storey[i].point, l->storey[i].stiffness};
    }
    const struct loop_figure figure = {.title = t.title,
                                       .subtitle = t.subtitle,
                                       .version = JOSTLE_VERSION,
                                       .n_curve = l->n,
                                       .curve = curve,
                                       .n = l->n_point,
                                       .n_part = l->n_part,
                                       .drifts = l->kind->deformation,
                                       .shears = l->kind->force,
                                       .turns = l->kind->turns,
                                       .progress = l->shear ? "sample" : "turn",
                                       .n_sample = l->shear ? l->n_target : 0,
                                       .drift = l->target,
                                       .shear = l->shear};
    return loop_figure_write(&figure, to, e);
}

static int draw_loops(const struct options *o, const void *laws, struct error *e) {
    const struct law_storeys *l = laws;
    if (l->n > LOOP_FIGURE_CURVES) {
        return error_set(e, STATUS_INPUT, "a picture shows at most %d laws, not %d",
                         LOOP_FIGURE_CURVES, l->n);
    }
    const struct picture_request picture = {
        .options = o->picture, .name = "loops", .write = write_loops, .context = (void *)l};
    return picture_make(&picture, e);
}

static int loop_history(const void *laws, FILE *to) {
    return law_storey_print_path(laws, to);
}

static void warn_of_loops(const void *laws, FILE *to) {
    law_storey_warn(laws, to);
}

static int print_loops(const void *laws, enum printer_form form, FILE *to) {
    return law_storey_print(laws, form, to);
}

static int report(const struct options *o, const struct law_output *out) {
    struct error e;
    if (check_existing(o, &e) != STATUS_OK) {
        return command_fail(&e);
    }
    if (o->history) {
        const int status = write_history(o, out);
        if (status != EXIT_DONE) {
            return status;
        }
    }
    if (picture_is_wanted(&o->picture) && out->draw(o, out->laws, &e) != STATUS_OK) {
        return command_fail(&e);
    }
    out->warn(out->laws, stderr);
    return out->print(out->laws, o->form, stdout);
}

static int use_impacts(const struct options *o) {
    struct law_impacts laws;
    const struct law_output out = {&laws, impact_history, draw_impacts, warn_of_impacts,
                                   print_impacts};
    int status = law_impacts_run(&o->words, &laws);
    if (status == EXIT_DONE) {
        status = report(o, &out);
        law_impacts_free(&laws);
    }
    return status;
}

static int use_loops(const struct options *o) {
    struct law_storeys laws;
    const struct law_storey_words words = {o->words, o->of_storey, o->protocol};
    const struct law_output out = {&laws, loop_history, draw_loops, warn_of_loops, print_loops};
    int status = law_storey_run(&words, &laws);
    if (status == EXIT_DONE) {
        status = report(o, &out);
        law_storey_free(&laws);
    }
    return status;
}

static int use_list(const struct options *o) {
    const struct law_over_request q = {o->words, o->over, o->picture, o->form};
    if (o->of_storey || o->words.fit || o->history) {
        return command_usage(&command_law,
                             "--over is for contact laws, without --fit and --history");
    }
    return law_over_run(&q);
}

static int use(void *options, struct arena *a, const struct words *operand) {
    (void)a;
    struct options *o = options;
    for (int k = 0; operand->n > 0 && k < LAW_STOREY_KINDS; k++) {
        const bool named = strcmp(operand->word[0], law_storey_kinds[k].name) == 0;
        o->of_storey = named ? &law_storey_kinds[k] : o->of_storey;
    }
    o->words.word = operand->word + (o->of_storey != NULL);
    o->words.n_word = operand->n - (o->of_storey != NULL);
    o->words.compare = o->compare.word;
    o->words.n_compare = o->compare.n;
    int status = check(o);
    status = status == EXIT_DONE && o->peak ? read_peak(o) : status;
    if (status == EXIT_DONE && o->over) {
        return use_list(o);
    }
    return status != EXIT_DONE ? status : o->of_storey ? use_loops(o) : use_impacts(o);
}

static int law_command(int argc, char **argv) {
    static const struct option_row rows[] = {
        {"compare", 0, "LAWS", OPTION_WORDS, 0, AT(compare),
         .doc = "computes other laws too: LAW,LAW,... with the options of the first one, or one "
                "law with its own options, \"LAW -k K ...\"; may be repeated"},
        {"protocol", 0, "PROTOCOL", OPTION_TEXT, 0, AT(protocol),
         .doc = "storey laws: fema461, sac, or a file with a column of drifts at which the storey "
                "turns"},
        {"history", 0, "FILE", OPTION_TEXT, 0, AT(history),
         .doc = "writes time, penetration, velocity and force; of a storey all points"},
        {"plot", 0, "FILE", OPTION_TEXT, 0, AT(picture.output),
         .doc = "draws the force against time and penetration, or the loops of storeys; extension "
                ".png, "
                ".svg or .pdf"},
        {"script", 0, "DIR", OPTION_TEXT, 0, AT(picture.script_folder),
         .doc = "writes the plot as DIR/impact.gp or DIR/loops.gp for gnuplot, and its data"},
        {"fit", 0, "FILE", OPTION_TEXT, 0, AT(words.fit),
         .doc = "finds -k and -zeta from a measured force: two columns, time and force, separated "
                "by spaces, tabs, commas or semicolons. Storey laws: finds what is not given from "
                "deformation and force"},
        {"peak", 0, "FORCE", OPTION_TEXT, 0, AT(peak),
         .doc = "finds the -k with which the impact has this peak force"},
        {"over", 0, "LIST", OPTION_TEXT, 0, AT(over),
         .doc = "a line for each value of v, e or k: v=0.1,0.2,0.5 or v=FROM:TO:N, evenly spaced. "
                "--plot draws the peak force over the values"},
        {"force", .kind = OPTION_SET, .at = AT(picture.existing), .set = RESULT_REPLACE,
         .doc = "overwrites existing files"},
        {"tsv", .kind = OPTION_SET, .at = AT(form), .set = FORM_TSV,
         .doc = "one name and value per line, in SI, not rounded"},
        {0}};
    static const struct option_part parts[] = {
        {.text =
             "LAW and its options are those of a deck; bare numbers are in SI. `jostle laws` "
             "lists the laws.\n\n  -m1 M, -m2 M    masses of the bodies; without -m2 the other "
             "one is a wall\n  -v V            closing velocity\n\nStorey laws, `jostle law "
             "storey LAW ...`, `jostle law hinge LAW ...` of moment and rotation, and the laws of "
             "links, `jostle law link LAW ...`:\n"
             "  -stiffness K    initial stiffness\n  -amplitude D    largest deformation of the "
             "protocol\n  -period T       time of a cycle of the protocol, for laws that depend "
             "on the velocity\n  -find OPTIONS   what --fit finds besides stiffness and required "
             "options\n"},
        {.row = rows},
        {.row = printer_rows, .at = AT(form)},
        {.row = option_help},
        {0}};
    static const struct option_list list = {&command_law, parts, DASH_LAW, .use = use};
    struct options o = {.picture.existing = RESULT_KEEP};
    return option_run(&list, argc, argv, &o);
}
