// SPDX-License-Identifier: GPL-3.0-or-later
// jostle export: the model of a deck as a script of another program.
#include "command/deck_command.h"
#include "export/opensees.h"

static int export_command(int argc, char **argv);

const struct command command_export = {
    .name = "export",
    .usage = "DECK --opensees py|tcl [-D NAME=VALUE]...",
    .summary = "prints the model as a script of OpenSees",
    .run = export_command,
};

struct options {
    struct load_request load;
    int language;  // enum emit_language; -1: none is asked for
};

static int export_settle(void *options) {
    const struct options *o = options;
    return o->language >= 0
               ? EXIT_DONE
               : command_usage(&command_export, "give --opensees py or --opensees tcl");
}

static int export_use(void *options, const struct model *m) {
    const struct options *o = options;
    struct error e;
    const int status =
        opensees_write(m, (enum emit_language)o->language, JOSTLE_VERSION, stdout, stderr, &e);
    return status == STATUS_OK ? EXIT_DONE : command_fail(&e);
}

static int export_command(int argc, char **argv) {
    static const struct option_row rows[] = {
        {"opensees", .value = "py|tcl", .kind = OPTION_CHOICE,
         .at = offsetof(struct options, language),
         .doc = "the program, and the language of its script: OpenSeesPy or Tcl"},
        DECK_DEFINE_ROW,
        {0}};
    static const struct option_part parts[] = {
        {.row = rows},
        {.text =
             "\nThe script has the whole model, its records and its steps, and runs as it is. "
             "It writes\ndisplacement.out and velocity.out in the current directory: the time "
             "and all floors,\nbuildings from the left, floors from the ground. `jostle compare` "
             "reads these files.\nWhat has no counterpart in OpenSees is named in the script "
             "and on stderr.\n"},
        {.row = option_help},
        {0}};
    static const struct deck_command c = {&command_export, parts, .settle = export_settle,
                                          .use = export_use};
    struct options o = {.language = -1};
    return deck_command_run(&c, argc, argv, &o.load);
}
