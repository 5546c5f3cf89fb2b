// SPDX-License-Identifier: GPL-3.0-or-later
// jostle show: the results of a file as a summary, as one long table, or as JSON.
#include "command/show.h"

#include <getopt.h>
#include <string.h>

#include "command/command.h"
#include "command/show_study.h"
#include "jostle/study_file.h"

static int show_command(int argc, char **argv);

const struct command command_show = {
    .name = "show",
    .usage = "FILE.h5 [--tsv|--json]",
    .summary = "prints the results as tables",
    .run = show_command,
};

static const char details[] =
    "  --tsv     one long table: table, name, quantity, location, value, unit, time;\n"
    "            separated by tabs. Of a study: run, parameters, status, table, name, quantity,\n"
    "            location, value, unit\n"
    "  --json    everything but the histories as JSON; a missing number is null\n"
    "  --help    this text\n";

static int show_of_study(const char *path, int form) {
    struct error e;
    if (form == 'j') {
        return command_usage(&command_show, "%s is a study, which --tsv shows, but not --json",
                             path);
    }
    return show_study(path, form == 't' ? STUDY_TSV : STUDY_SUMMARY, stdout, &e) == STATUS_OK
               ? EXIT_DONE
               : command_fail(&e);
}

static int show_command(int argc, char **argv) {
    static const struct option option[] = {
        {"tsv", no_argument, NULL, 't'},
        {"json", no_argument, NULL, 'j'},
        {"help", no_argument, NULL, 'h'},
        {NULL, 0, NULL, 0},
    };
    int form = 0;
    opterr = 0;
    optind = 1;
    for (int c; (c = getopt_long(argc, argv, ":h", option, NULL)) != -1;) {
        if (c == 'h') {
            return command_help(&command_show, details);
        }
        if (c == '?' || c == ':') {
            return command_bad_option(&command_show, c, argv);
        }
        if (form != 0 && form != c) {
            return command_usage(&command_show, "--tsv and --json exclude each other");
        }
        form = c;
    }
    if (argc - optind != 1) {
        return command_usage(&command_show, "one result file is expected, not %d", argc - optind);
    }
    struct result_file *file;
    struct error e;
    if (study_file_is_study(argv[optind])) {
        return show_of_study(argv[optind], form);
    }
    if (result_open(argv[optind], &file, &e) != STATUS_OK) {
        return command_fail(&e);
    }
    const struct report *r = result_report(file);
    if (form == 't') {
        show_tsv(r, stdout);
    } else if (form == 'j') {
        show_json(r, stdout);
    } else {
        report_print(r, stdout);
    }
    result_close(file);
    return EXIT_DONE;
}
