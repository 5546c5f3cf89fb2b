// SPDX-License-Identifier: GPL-3.0-or-later
// jostle show: the results of a file as a summary, as long tables, or as JSON.
#include "command/show.h"

#include <stdlib.h>

#include "command/command.h"
#include "command/show_study.h"
#include "jostle/study_file.h"

static int show_command(int argc, char **argv);

const struct command command_show = {
    .name = "show",
    .usage = "FILE.h5 [--tsv|--csv|--json] [--long] [--edp EDP]",
    .summary = "prints the results as tables",
    .run = show_command,
};

static const char details[] =
    "FILE.h5#7 is run 7 of a study whose deck has 'output -histories'.\n\n"
    "  --tsv     one long table: table, name, quantity, location, value, unit, time, hit;\n"
    "            separated by tabs. Of a study: run, parameters, status, table, name, quantity,\n"
    "            location, value, unit, hit. hit is 1 for accelerations of floors that were hit,\n"
    "            which depend on the contact stiffness, 0 for other accelerations\n"
    "  --csv     the same separated by commas, quoted where that is needed (RFC 4180)\n"
    "  --json    everything but the histories as JSON; a missing number is null. Of a study: the\n"
    "            table as {\"columns\": [...], \"data\": [[...], ...]}\n"
    "  --long    of a study: what engineers ask for, a line each: parameters, edp, location,\n"
    "            value, unit, status (done or failed), hit; as TSV, or with --csv or --json as "
    "those\n"
    "  --edp EDP\n"
    "            with --long: one line a run for this demand; may be repeated. 'jostle\n"
    "            fragility --help' lists what EDP can be\n"
    "  --help    this text\n";

// What the command line asks for.
struct request {
    int form;  // 't', 'c', 'j'; 0: the summary
    bool longer;
    const char **edp;  // (n_edp)
    int n_edp;
};

static enum cells_form cells_form(const struct request *q) {
    return q->form == 'c' ? CELLS_CSV : q->form == 'j' ? CELLS_JSON : CELLS_TSV;
}

static int show_of_study(const char *path, const struct request *q) {
    struct error e;
    const enum cells_form form = cells_form(q);
    int status;
    if (q->longer) {
        const struct show_demands_request demands = {
            .form = form, .edp = q->edp, .n_edp = q->n_edp};
        status = show_demands(path, &demands, stdout, &e);
    } else {
        status =
            q->form ? show_study(path, form, stdout, &e) : show_study_summary(path, stdout, &e);
    }
    return status == STATUS_OK ? EXIT_DONE : command_fail(&e);
}

static int show_of_run(const char *path, const struct request *q) {
    struct result_file *file;
    struct error e;
    if (result_open(path, &file, &e) != STATUS_OK) {
        return command_fail(&e);
    }
    if (q->longer) {
        result_close(file);
        return command_usage(&command_show, "--long is for studies; %s is one run", path);
    }
    const struct report *r = result_report(file);
    if (q->form == 'j') {
        show_json(r, stdout);
    } else if (q->form) {
        show_table(r, cells_form(q), stdout);
    } else {
        report_print(r, stdout);
    }
    result_close(file);
    return EXIT_DONE;
}

static int take(void *request, int letter) {
    struct request *q = request;
    if (letter == 'l') {
        q->longer = true;
    } else if (letter == 'e') {
        q->edp[q->n_edp++] = optarg;
    } else if (q->form != 0 && q->form != letter) {
        return command_usage(&command_show, "--tsv, --csv and --json exclude each other");
    } else {
        q->form = letter;
    }
    return EXIT_DONE;
}

// GO_ON, or the exit status.
static int parse(int argc, char **argv, struct request *q) {
    static const struct option option[] = {
        {"tsv", no_argument, NULL, 't'},
        {"csv", no_argument, NULL, 'c'},
        {"json", no_argument, NULL, 'j'},
        {"long", no_argument, NULL, 'l'},
        {"edp", required_argument, NULL, 'e'},
        {"help", no_argument, NULL, 'h'},
        {NULL, 0, NULL, 0},
    };
    static const struct command_options options = {&command_show, details, NULL, getopt_long,
                                                   ":h",          option,  take, "edp"};
    const int status = command_parse(&options, argc, argv, q);
    if (status == GO_ON && argc - optind != 1) {
        return command_usage(&command_show, "one result file is expected, not %d", argc - optind);
    }
    if (status == GO_ON && q->n_edp > 0 && !q->longer) {
        return command_usage(&command_show, "--edp is for --long");
    }
    return status;
}

static int show_command(int argc, char **argv) {
    struct request q = {.edp = calloc((size_t)argc, sizeof *q.edp)};
    if (!q.edp) {
        return command_no_memory();
    }
    int status = parse(argc, argv, &q);
    if (status == GO_ON) {
        const char *path = argv[optind];
        status = study_file_is_study(path) ? show_of_study(path, &q) : show_of_run(path, &q);
    }
    free(q.edp);
    return status;
}
