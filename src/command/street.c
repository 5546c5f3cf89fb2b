// SPDX-License-Identifier: GPL-3.0-or-later
// jostle street: a deck of a row of buildings from a table.
#include <math.h>
#include <string.h>

#include "command/option.h"
#include "command/printer.h"
#include "core/arena.h"
#include "core/quantity.h"
#include "export/street.h"
#include "result/partial_file.h"

static int street_command(int argc, char **argv);

const struct command command_street = {
    .name = "street",
    .usage = "FILE.csv [--record FILE [--pga A]] [--zone ZONE] [-o FILE.deck [--force]]\n"
             "       jostle street --types [--tsv|--csv|--json]",
    .summary = "makes a deck of a row of buildings from a table",
    .run = street_command,
};

static const char explanation[] =
    "\nThe table has a line of headings, and a line for each building from left to right. Columns: "
    "name,\nstoreys, type, year or code, height or storey-height, mass or area, period or "
    "stiffness, law, yield,\nhardening, damping, gap, k, e. Only storeys, the gap to the next "
    "building, and a type, period or\nstiffness are necessary. Units stand in brackets in the "
    "headings, or behind numbers. Types are those of\nHAZUS: --types prints them. Without "
    "--record, the deck has no ground motion and no steps.\n";

struct options {
    struct street_motion motion;
    const char *pga, *output;
    enum result_existing existing;
    int zone;
    bool types;
    enum printer_form form;
};
#define AT(member) offsetof(struct options, member)

static int print_types(const struct options *o) {
    static const struct printer_column columns[] = {
        {"type", "type", NULL, NULL, -5, 0, LOOK_TAIL},
        {"storeys", "typical_storeys", NULL, NULL, 7, 4, LOOK_G},
        {"from", "from_storeys", NULL, NULL, 5, 4, LOOK_G},
        {"to", "to_storeys", NULL, NULL, 5, 4, LOOK_G},
        {"T", "period", "s", NULL, 7, 3, LOOK_G},
        {"storey", "storey_height", "m", NULL, 7, 3, LOOK_G},
        {"lambda", "overstrength", NULL, NULL, 7, 3, LOOK_G},
        {"code", "code", NULL, NULL, -9, 0, LOOK_TAIL},
        {"Ay", "yield_acceleration", "g", NULL, 7, 3, LOOK_G},
        {"mu", "ductility", NULL, NULL, 5, 3, LOOK_G},
        {"hardening", "hardening", NULL, NULL, 9, 3, LOOK_G}};
    struct printer t = {.to = stdout, .form = o->form, .at_head = UNITS_BELOW};
    PRINTER_ADD(&t, columns);
    printer_head(&t);
    for (int i = 0; i < n_street_type * STREET_CODES; i++) {
        const struct street_type *s = &street_types[i / STREET_CODES];
        const enum street_code code = (enum street_code)(i % STREET_CODES);
        printer_text(&t, s->name);
        printer_whole(&t, s->storeys);
        printer_whole(&t, s->least);
        printer_whole(&t, s->most);
        printer_numbers(&t, (const double[]){s->period, s->height, s->overstrength}, 3);
        printer_text(&t, street_code_names[code]);
        printer_numbers(
            &t,
            (const double[]){s->strength[code], s->ductility[code], street_type_hardening(s, code)},
            3);
        printer_line(&t);
    }
    return printer_close(&t);
}

static int write_to(const struct options *o, const struct street *s) {
    struct error e;
    if (!o->output) {
        street_write(s, &o->motion, stdout);
        return EXIT_DONE;
    }
    struct partial_file file;
    if (partial_file_open(&file, o->output, o->existing, &e) != STATUS_OK) {
        return command_fail(&e);
    }
    street_write(s, &o->motion, file.to);
    return partial_file_publish(&file, &e) == STATUS_OK ? EXIT_DONE : command_fail(&e);
}

static int make_deck(const struct options *o, struct arena *a, const char *path) {
    struct street s;
    struct diagnostics d;
    struct error e;
    diagnostics_init(&d, a);
    const int status = street_read(a, path, (enum street_zone)o->zone, &s, &d, &e);
    if (d.n_error + d.n_warning > 0) {
        diagnostics_print(&d, stderr, command_colour());
    }
    return status == STATUS_OK ? write_to(o, &s) : command_fail(&e);
}

static int use(void *request, struct arena *a, const struct words *operand) {
    struct options *o = request;
    if (o->types) {
        return operand->n == 0 ? print_types(o)
                               : command_usage(&command_street, "--types takes no table");
    }
    if (operand->n != 1) {
        return command_usage(&command_street, "one table is expected, not %d", operand->n);
    }
    if (o->form != FORM_TEXT) {
        return command_usage(&command_street, "--tsv, --csv and --json go with --types");
    }
    o->motion.pga = NAN;
    if (o->pga && !o->motion.record) {
        return command_usage(&command_street, "--pga goes with --record");
    }
    if (o->pga && (!quantity_whole(o->pga, &dimension_acceleration, BARE_REFUSED, &o->motion.pga) ||
                   !(o->motion.pga > 0.0))) {
        return command_usage(&command_street,
                             "--pga takes an acceleration > 0 with its unit, not '%s'", o->pga);
    }
    if (o->motion.record && strpbrk(o->motion.record, "\"\n\r")) {
        return command_usage(&command_street, "a deck cannot quote the name of the record");
    }
    return make_deck(o, a, operand->word[0]);
}

static int street_command(int argc, char **argv) {
    static const struct option_row rows[] = {
        {"record", 0, "FILE", OPTION_TEXT, 0, AT(motion.record),
         .doc = "ground motion of the deck, a path relative to the deck; with it the deck can run"},
        {"pga", 0, "A", OPTION_TEXT, 0, AT(pga),
         .doc = "peak ground acceleration to scale the record to, such as 0.3g"},
        {"zone", 0, "0|1|2A|2B|3|4", OPTION_CHOICE, 0, AT(zone),
         .doc = "seismic zone of the Uniform Building Code, which with the year gives the code of "
                "a type; default: 4"},
        {"output", 'o', "FILE.deck", OPTION_TEXT, OPTION_LETTER_ONLY, AT(output),
         .doc = "the deck; default: standard output"},
        {"force", .kind = OPTION_SET, .at = AT(existing), .set = RESULT_REPLACE,
         .doc = "replaces the deck"},
        {"types", .kind = OPTION_TRUE, .at = AT(types), .doc = "prints the types and their values"},
        {"tsv", .kind = OPTION_SET, .at = AT(form), .set = FORM_TSV,
         .doc = "the types as a table separated by tabs"},
        {0}};
    static const struct option_part parts[] = {{.row = rows},
                                               {.row = printer_rows, .at = AT(form)},
                                               {.row = option_help},
                                               {.text = explanation},
                                               {0}};
    const struct option_list list = {.command = &command_street, .part = parts, .use = use};
    struct options o = {.zone = ZONE_4};
    return option_run(&list, argc, argv, &o);
}
