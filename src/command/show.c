// SPDX-License-Identifier: GPL-3.0-or-later
// jostle show: the results of a file as a summary, as long tables, or as JSON.

#include "command/show.h"
#include "command/crash.h"
#include "command/option.h"
#include "command/study_deck.h"
#include "jostle/study_file.h"

static int show_command(int argc, char **argv);

const struct command command_show = {
    .name = "show",
    .usage = "FILE.h5 [--tsv|--csv|--json] [--long|--wide] [--edp EDP] [--im MEASURE]\n"
             "                   [--deck DECK]",
    .summary = "prints the results as tables",
    .run = show_command,
};

// What the command line asks for.
struct request {
    enum printer_form form;  // FORM_TEXT: the summary
    bool longer, wide;
    struct words edp, im;
    const char *deck;
};
#define AT(member) offsetof(struct request, member)

static int show_of_study(const char *path, const struct request *q) {
    struct error e;
    int status;
    if (q->longer || q->wide) {
        const struct show_demands_request demands = {.form =
                                                         q->form == FORM_TEXT ? FORM_TSV : q->form,
                                                     .edp = q->edp.word,
                                                     .n_edp = q->edp.n,
                                                     .wide = q->wide,
                                                     .im = q->im.word,
                                                     .n_im = q->im.n,
                                                     .deck = q->deck};
        return show_demands(path, &demands, stdout);
    }
    status = q->form ? show_study(path, q->form, stdout, &e) : show_study_summary(path, stdout, &e);
    return status == STATUS_OK ? EXIT_DONE : command_fail(&e);
}

static int show_of_run(const char *path, const struct request *q) {
    struct result_file *file;
    struct error e;
    if (result_open(path, &file, &e) != STATUS_OK) {
        return command_fail(&e);
    }
    if (q->longer || q->wide) {
        result_close(file);
        return command_usage(&command_show, "--%s is for studies; %s is one run",
                             q->wide ? "wide" : "long", path);
    }
    const struct report *r = result_report(file);
    int status = EXIT_DONE;
    if (q->form == FORM_TEXT) {
        status = report_print(r, stdout, &e) == STATUS_OK ? EXIT_DONE : command_fail(&e);
    } else if (q->form == FORM_JSON) {
        show_json(r, stdout);
    } else {
        status = show_table(r, q->form, stdout);
    }
    result_close(file);
    return status;
}

static int use(void *request, struct arena *a, const struct words *operand) {
    (void)a;
    const struct request *q = request;
    const char *path = operand->word[0];
    if (q->longer && q->wide) {
        return command_usage(&command_show, "give --long or --wide, not both");
    }
    if ((q->edp.n > 0 || q->im.n > 0) && !q->longer && !q->wide) {
        return command_usage(&command_show, "--%s is for --long and --wide",
                             q->edp.n > 0 ? "edp" : "im");
    }
    crash_reading(NULL, path);
    return study_file_is_study(path) ? show_of_study(path, q) : show_of_run(path, q);
}

static int show_command(int argc, char **argv) {
    static const struct option_row rows[] = {
        {"tsv", .kind = OPTION_SET, .at = AT(form), .set = FORM_TSV,
         .doc = "one table separated by tabs: table, name, quantity, location, value, unit, time, "
                "hit; for a study: run, parameters, status, table, name, quantity, location, "
                "value, unit, hit. hit is 1 for accelerations of floors that were hit, which "
                "depend on the contact stiffness, and 0 for other accelerations"},
        {"csv", .kind = OPTION_SET, .at = AT(form), .set = FORM_CSV,
         .doc = "the same, separated by commas and quoted as RFC 4180 says"},
        {"json", .kind = OPTION_SET, .at = AT(form), .set = FORM_JSON,
         .doc = "all results except the histories as JSON; a missing number is null. For a study: "
                "the table as {\"columns\": [...], \"data\": [[...], ...]}"},
        {"long", .kind = OPTION_TRUE, .at = AT(longer),
         .doc = "for a study, the demands, a line each: parameters, edp, location, value, unit, "
                "status (done or failed), hit; as TSV, or with --csv or --json"},
        {"wide", .kind = OPTION_TRUE, .at = AT(wide),
         .doc = "for a study, a line for each run: run, parameters, status, and a column for each "
                "demand, such as drift:A:3 [m]; empty for a failed run; as TSV, or with --csv or "
                "--json"},
        {"edp", 0, "EDP", OPTION_WORDS, 0, AT(edp),
         .doc = "with --long one line per run for this demand, with --wide one column; may be "
                "repeated. 'jostle fragility --help' lists the demands"},
        {"im", 0, "MEASURE", OPTION_WORDS, 0, AT(im),
         .doc = "with --long and --wide, a column for this intensity of the ground motion of each "
                "run, such as PGV or Sa(1s); may be repeated"},
        STUDY_DECK_ROW(AT(deck)),
        {0}};
    static const struct option_part parts[] = {
        {.text = "FILE.h5#7 is run 7 of a study with 'output -histories'.\n\n"},
        {.row = rows},
        {.row = option_help},
        {.text = measure_help},
        {0}};
    static const struct option_list list = {&command_show, parts, .operand = "result file",
                                            .use = use};
    return option_run(&list, argc, argv, &(struct request){0});
}
