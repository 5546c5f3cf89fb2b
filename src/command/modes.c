// SPDX-License-Identifier: GPL-3.0-or-later
// jostle modes: periods and mode shapes of each building alone, on its initial stiffness.
#include <gsl/gsl_math.h>

#include "command/deck_command.h"
#include "command/printer.h"
#include "command/sweeps.h"
#include "core/safe.h"

static int modes_command(int argc, char **argv);

const struct command command_modes = {
    .name = "modes",
    .usage = "DECK [-D NAME=VALUE]... [--tsv|--csv|--json]",
    .summary = "prints periods and mode shapes of each building",
    .run = modes_command,
};

enum { MODES_IN_A_ROW = 8 };

// Effective modal mass of the mode `phi` as a share of the building's mass.
static double mass_share(const struct building *g, const double *phi) {
    double total = 0.0;
    double excited = 0.0;
    double modal = 0.0;
    for (int i = 0; i < g->n_dof; i++) {
        const bool turns = g->fixed && i + 1 == g->n_dof;  // the ground does not turn
        total += turns ? 0.0 : g->mass[i];
        excited += turns ? 0.0 : g->mass[i] * phi[i];
        modal += g->mass[i] * phi[i] * phi[i];
    }
    return excited * excited / modal / total;
}

static const double *shape_of(const struct building *g, int mode) {
    return g->shape + (size_t)mode * (size_t)g->n_dof;
}

// In text a line is a mode, in data a floor of a mode.
static void open_table(struct printer *t, const struct model *m, enum printer_form form) {
    const char *time = m->deck->units.time_name, *percent = form == FORM_TEXT ? "[%]" : "%";
    char frequency[48], omega[48];
    snprintf(frequency, sizeof frequency, "1/%s", time);
    snprintf(omega, sizeof omega, "rad/%s", time);
    const struct printer_column columns[] = {
        COLUMN_DATA("building"),
        {.head = "mode", .key = "mode", .width = 4},
        {"period", "period", time, NULL, 12, 6, LOOK_G},
        {"frequency", "frequency", frequency, NULL, 12, 6, LOOK_G},
        {"omega", "omega", omega, NULL, 12, 6, LOOK_G},
        {"damping", "damping", percent, NULL, 12, 4, LOOK_G},
        {"effective mass", "effective_mass", percent, NULL, 14, 4, LOOK_G},
        COLUMN_DATA("floor"),
        COLUMN_DATA("shape")};
    *t = (struct printer){.to = stdout, .form = form, .at_head = UNITS_BELOW_BARE};
    PRINTER_ADD(t, columns);
    printer_head(t);
}

static void print_mode(struct printer *t, const struct building *g, int mode, int floor) {
    const double omega = g->omega[mode];
    const bool rigid = omega == 0.0;
    printer_text(t, g->name);
    printer_whole(t, mode + 1);
    if (rigid && t->form == FORM_TEXT) {
        printer_text(t, "rigid body");
    } else {
        printer_number(t, 2.0 * M_PI / omega);
    }
    printer_number(t, omega / (2.0 * M_PI));
    printer_number(t, omega);
    printer_number(t, rigid ? (double)NAN : 100.0 * building_damping_ratio(g, mode + 1));
    printer_number(t, 100.0 * mass_share(g, shape_of(g, mode)));
    printer_whole(t, floor + 1);
    printer_number(t, shape_of(g, mode)[floor]);
    printer_line(t);
}

static int print_shapes(const struct building *g, int first, int last) {
    char head[MODES_IN_A_ROW][16];
    struct printer t = {.to = stdout};
    printer_add(&t, &(struct printer_column)COLUMN_TEXT("floor", 6), 1);
    for (int m = first; m < last; m++) {
        snprintf(head[m - first], sizeof head[0], "mode%2d", m + 1);
        printer_add(&t, &(struct printer_column)COLUMN_F(head[m - first], 11, 5), 1);
    }
    printf("\n");
    printer_head(&t);
    for (int i = g->n_dof - 1; i >= 0; i--) {
        if (i < g->n_floor) {
            printer_whole(&t, i + 1);
        } else {
            printer_text(&t, i == g->n_floor ? "sway" : "rock");
        }
        for (int m = first; m < last; m++) {
            printer_number(&t, shape_of(g, m)[i]);
        }
        printer_line(&t);
    }
    return printer_close(&t);
}

// What P-delta takes off each storey, and how far it is from buckling.
static int print_pdelta(const struct model *m, const struct building *g) {
    static const struct printer_column columns[] = {
        COLUMN_TEXT("storey", 6),
        {"P", NULL, NULL, &dimension_force, 12, 6, LOOK_G},
        {"P drift / (V h)", NULL, NULL, NULL, 17, 4, LOOK_G}};
    struct printer t = {.to = stdout, .units = &m->deck->units, .at_head = UNITS_BELOW_BARE};
    printf("\nP-delta: buckling factor %.4g; stability coefficient in mode 1\n", g->buckling);
    PRINTER_ADD(&t, columns);
    printer_head(&t);
    for (int i = g->n_floor - 1; i >= 0; i--) {
        printer_whole(&t, i + 1);
        printer_number(&t, g->axial[i]);
        printer_number(&t, g->theta[i]);
        printer_line(&t);
    }
    return printer_close(&t);
}

static int print_building(const struct model *m, const struct building *g) {
    struct printer t;
    safe_line(stdout, "building %s, %d floor%s", g->name, g->n_floor, g->n_floor == 1 ? "" : "s");
    fputc('\n', stdout);
    open_table(&t, m, FORM_TEXT);
    for (int k = 0; k < g->n_dof; k++) {
        print_mode(&t, g, k, 0);
    }
    int status = printer_close(&t);
    for (int k = 0; k < g->n_dof && status == EXIT_DONE; k += MODES_IN_A_ROW) {
        const int last = k + MODES_IN_A_ROW;
        status = print_shapes(g, k, last < g->n_dof ? last : g->n_dof);
    }
    return status == EXIT_DONE && g->axial ? print_pdelta(m, g) : status;
}

struct options {
    struct load_request load;
    enum printer_form form;
};

static int print_modes(void *options, const struct model *m) {
    const struct options *o = options;
    if (o->form != FORM_TEXT) {
        struct printer t;
        open_table(&t, m, o->form);
        for (int k = 0; k < m->n_building; k++) {
            const struct building *g = &m->building[k];
            for (int i = 0; i < g->n_dof * g->n_floor; i++) {
                print_mode(&t, g, i / g->n_floor, i % g->n_floor);
            }
        }
        return printer_close(&t);
    }
    int status = EXIT_DONE;
    sweeps_print_first(m->deck, "", "\n");
    for (int k = 0; k < m->n_building && status == EXIT_DONE; k++) {
        fputs(k ? "\n" : "", stdout);
        status = print_building(m, &m->building[k]);
    }
    return status;
}

static int modes_command(int argc, char **argv) {
    static const struct option_row rows[] = {
        DECK_DEFINE_ROW,
        {"tsv", .kind = OPTION_SET, .at = offsetof(struct options, form), .set = FORM_TSV,
         .doc = "a table separated by tabs: a line for each mode and floor"},
        {0}};
    static const struct option_part parts[] = {
        {.row = rows},
        {.row = printer_rows, .at = offsetof(struct options, form)},
        {.row = option_help},
        {0}};
    static const struct deck_command c = {&command_modes, parts, .use = print_modes};
    struct options o = {.form = FORM_TEXT};
    return deck_command_run(&c, argc, argv, &o.load);
}
