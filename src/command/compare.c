// SPDX-License-Identifier: GPL-3.0-or-later
// jostle compare: histories of a run beside those of another run, of another program, or measured
// ones.
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "command/compare.h"
#include "command/crash.h"
#include "command/picture.h"
#include "command/printer.h"
#include "core/safe.h"
#include "jostle/study_file.h"
#include "plot/pictures.h"
#include "result/layout.h"

static int compare_command(int argc, char **argv);

const struct command command_compare = {
    .name = "compare",
    .usage = "RUN.h5 OTHER | RUN.h5... --measured FILE --quantity Q |\n"
             "                      STUDY.h5 STUDY.h5 [--edp EDP [--limit VALUE]]\n"
             "                      [--tolerance T] [-o FILE [--script DIR]] [--force] "
             "[--tsv|--csv|--json]",
    .summary = "tells where a run differs from another one, or from a measurement, and a study "
               "from another",
    .run = compare_command,
};

struct options {
    const char *quantity, *measured;
    const char *edp, *limit;  // of studies
    double tolerance;         // NAN: not given
    struct picture_options picture;
    enum printer_form form;
};
#define AT(member) offsetof(struct options, member)

// A difference that counts as the first one, where no tolerance is given.
static const double USUAL_TOLERANCE = 1e-3;

static int compare_rank(const void *a, const void *b) {
    const struct comparison_pair *p = a, *q = b;
    return (p->result.error > q->result.error) - (p->result.error < q->result.error);
}

static int compare_print(const struct comparing *c, enum printer_form form) {
    const struct dimension *d = layout_field[c->field].dimension;
    const char *time = c->units.time_name;
    const bool ranked = c->measured != NULL;
    const struct printer_column columns[] = {
        {ranked ? "run" : "quantity", ranked ? "run" : "quantity", NULL, NULL, -26, 0, LOOK_TAIL},
        {"peak", "peak", NULL, d, 10, 4, LOOK_G},
        {NULL, "peak_time", time, NULL, 0, 0, LOOK_G},
        {ranked ? "measured" : "other", "other_peak", NULL, d, 10, 4, LOOK_G},
        {NULL, "other_peak_time", time, NULL, 0, 0, LOOK_G},
        {"difference", "difference", NULL, NULL, 10, 3, LOOK_G},
        {"at", "difference_time", time, NULL, 8, 4, LOOK_G},
        {"first", "first_time", time, NULL, 8, 4, LOOK_G},
        {"error", "error", NULL, NULL, 10, 3, LOOK_G},
        {"shift", "shift", time, NULL, 10, 3, LOOK_G},
        {"corr.", "correlation", NULL, NULL, 9, 6, LOOK_G}};
    struct printer t = {
        .to = stdout, .form = form, .units = &c->units, .at_head = UNITS_BELOW_BARE};
    PRINTER_ADD(&t, columns);
    printer_head(&t);
    for (int i = 0; i < c->n; i++) {
        const struct comparison *x = &c->pair[i].result;
        printer_text(&t, c->pair[i].name);
        const double value[] = {x->peak[0],    x->peak_time[0],    x->peak[1],    x->peak_time[1],
                                x->difference, x->difference_time, x->first_time, x->error,
                                x->shift,      x->correlation};
        printer_numbers(&t, value, (int)(sizeof value / sizeof value[0]));
        printer_line(&t);
    }
    return printer_close(&t);
}

// Differences that are above the tolerance.
static int compare_judge(const struct comparing *c, const struct options *o) {
    int n = 0;
    for (int i = 0; i < c->n; i++) {
        n += !(c->pair[i].result.difference <= o->tolerance);
    }
    if (isnan(o->tolerance)) {
        return EXIT_DONE;
    }
    if (o->form == FORM_TEXT) {
        safe_line(stdout, "%d of %d differ by more than %.3g of the peak", n, c->n, o->tolerance);
    }
    return n > 0 ? EXIT_FAILED : EXIT_DONE;
}

static int compare_draw(void *context, const struct figure_files *to, struct error *e) {
    const struct comparing *c = context;
    char name[32];
    snprintf(name, sizeof name, "%s", field_names[c->field]);
    compare_replace(name, '_', ' ');
    const struct comparison_figure f = {.title = c->title,
                                        .version = JOSTLE_VERSION,
                                        .quantity = name,
                                        .dimension = *layout_field[c->field].dimension,
                                        .units = &c->units,
                                        .measured = c->measured != NULL,
                                        .n = c->n,
                                        .pair = c->pair};
    return comparison_figure_write(&f, to, e);
}

static int compare_run(struct comparing *c, const struct options *o, const struct words *operand) {
    const double tolerance = isnan(o->tolerance) ? USUAL_TOLERANCE : o->tolerance;
    struct error e;
    int status = c->measured ? compare_all(c, operand, &e)
                             : compare_two(c, operand->word[0], operand->word[1], &e);
    for (int i = 0; status == STATUS_OK && i < c->n; i++) {
        struct comparison_pair *p = &c->pair[i];
        status = comparison_make(&p->computed, &p->reference, tolerance, &p->result, &e);
    }
    if (status == STATUS_OK && c->measured) {
        qsort(c->pair, (size_t)c->n, sizeof *c->pair, compare_rank);
    }
    if (status == STATUS_OK && picture_is_wanted(&o->picture)) {
        const struct picture_request picture = {
            .options = o->picture, .name = "compare", .write = compare_draw, .context = c};
        status = picture_make(&picture, &e);
    }
    crash_reading(NULL, NULL);
    if (status != STATUS_OK) {
        return command_fail(&e);
    }
    const int printed = compare_print(c, o->form);
    return printed == EXIT_DONE ? compare_judge(c, o) : printed;
}

static int compare_use_studies(const struct options *o, const struct words *operand) {
    struct compare_studies q = {{operand->word[0], operand->word[1]}, o->edp, o->limit, o->form};
    struct error e;
    if (o->measured || o->quantity || !isnan(o->tolerance) || picture_is_wanted(&o->picture)) {
        return command_usage(&command_compare,
                             "studies take --edp and --limit; 'jostle plot %s --compare %s' draws "
                             "them",
                             q.path[0], q.path[1]);
    }
    return compare_studies(&q, &e) == STATUS_OK ? EXIT_DONE : command_fail(&e);
}

static int compare_use(void *request, struct arena *a, const struct words *operand) {
    const struct options *o = request;
    struct comparing c = {.quantity = o->quantity, .measured = o->measured, .arena = a};
    if (o->measured && (!o->quantity || operand->n == 0)) {
        return command_usage(&command_compare, "--measured needs a run and --quantity");
    }
    if (!o->measured && operand->n != 2) {
        return command_usage(&command_compare, "give a run and what it is compared with");
    }
    if (operand->n == 2 && study_file_is_study(operand->word[0]) &&
        study_file_is_study(operand->word[1])) {
        return compare_use_studies(o, operand);
    }
    if (o->edp || o->limit) {
        return command_usage(&command_compare, "--edp and --limit are for two studies");
    }
    int status = picture_check(&command_compare, &o->picture);
    if (status == EXIT_DONE && o->quantity) {
        status = compare_read_quantity(&c);
    }
    return status == EXIT_DONE ? compare_run(&c, o, operand) : status;
}

static int compare_command(int argc, char **argv) {
    static const struct option_row rows[] = {
        {"quantity", 0, "Q", OPTION_TEXT, 0, AT(quantity),
         .doc = "KIND, KIND:BUILDING, KIND:BUILDING:FLOOR, or of contacts KIND:CONTACT; KIND is "
                "displacement (the default), velocity, acceleration, drift, storey-shear, force or "
                "penetration"},
        {"measured", 0, "FILE", OPTION_TEXT, 0, AT(measured),
         .doc = "a measured history of the quantity: time and value in columns, units in brackets "
                "above them, else those of the run. The runs are ranked by their errors"},
        {"edp", 0, "EDP", OPTION_TEXT, 0, AT(edp),
         .doc = "the demand of two studies (default: all); 'jostle fragility --help' lists them"},
        {"limit", 0, "VALUE", OPTION_TEXT, 0, AT(limit),
         .doc = "compares the fragilities of two studies for this limit of the demand"},
        {"tolerance", 0, "T", OPTION_NUMBER, 0, AT(tolerance), .least = 0.0, .most = 1e6,
         .doc = "the exit status is 1 if a difference is larger than T times the peak"},
        {"output", 'o', "FILE", OPTION_TEXT, OPTION_LETTER_ONLY, AT(picture.output),
         .doc = "draws the histories beside each other; extension .png, .svg or .pdf"},
        {"script", 0, "DIR", OPTION_TEXT, 0, AT(picture.script_folder),
         .doc = "writes the gnuplot script compare.gp and its data into DIR"},
        {"force", .kind = OPTION_SET, .at = AT(picture.existing), .set = RESULT_REPLACE,
         .doc = "overwrites existing files"},
        {"tsv", .kind = OPTION_SET, .at = AT(form), .set = FORM_TSV,
         .doc = "the table separated by tabs, with the times of the peaks"},
        {0}};
    static const struct option_part parts[] = {
        {.text = "OTHER is a result file, or the time and all histories of the quantity in columns "
                 "of text,\nin the order of the run: buildings from the left, floors from the "
                 "ground.\n\n"},
        {.row = rows},
        {.row = printer_rows, .at = AT(form)},
        {.text = "\nOf two studies, runs of the same parameters are compared: the ratio of their "
                 "demands, its median\nand its dispersion, the standard deviation of its "
                 "logarithm.\n"},
        {.text = "\ndifference: the largest one over the peak of the other history, and when it "
                 "is\nfirst: the first difference above the tolerance, or above 0.001\n"
                 "error: root of sum (x - r)^2 over sum r^2 (Jankowski 2005, eq. 10-11)\n"
                 "shift: how much later the run is where both match best\n"
                 "corr.: coefficient of correlation\n"},
        {.row = option_help},
        {0}};
    static const struct option_list list = {&command_compare, parts, .use = compare_use};
    struct options o = {.tolerance = NAN, .form = FORM_TEXT};
    return option_run(&list, argc, argv, &o);
}
