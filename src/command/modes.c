// SPDX-License-Identifier: GPL-3.0-or-later
// jostle modes: periods and mode shapes of each building alone, on its initial stiffness.
#include <gsl/gsl_math.h>

#include "command/deck_command.h"
#include "command/sweeps.h"

static int modes_command(int argc, char **argv);

const struct command command_modes = {
    .name = "modes",
    .usage = "DECK [-D NAME=VALUE]...",
    .summary = "prints periods and mode shapes of each building",
    .run = modes_command,
};

enum { MODES_IN_A_ROW = 8 };

// Effective modal mass of the mode `phi` as a share of the building's mass.
static double mass_share(const struct building *g, const double *phi) {
    double total = 0.0;
    double excited = 0.0;
    double modal = 0.0;
    for (int i = 0; i < g->n_floor; i++) {
        total += g->mass[i];
        excited += g->mass[i] * phi[i];
        modal += g->mass[i] * phi[i] * phi[i];
    }
    return excited * excited / modal / total;
}

static void print_table(const struct building *g, const char *time) {
    printf("%4s %12s %12s %12s %12s %14s\n", "mode", "period", "frequency", "omega", "damping",
           "effective mass");
    printf("%4s %12s %10s/%s %8srad/%s %12s %14s\n", "", time, "1", time, "", time, "[%]", "[%]");
    for (int m = 0; m < g->n_floor; m++) {
        const double *phi = g->shape + (size_t)m * (size_t)g->n_floor;
        double omega = g->omega[m];
        if (omega == 0.0) {
            printf("%4d %12s %12d %12d %12s %14.4g\n", m + 1, "rigid body", 0, 0, "-",
                   100.0 * mass_share(g, phi));
            continue;
        }
        printf("%4d %12.6g %12.6g %12.6g %12.4g %14.4g\n", m + 1, 2.0 * M_PI / omega,
               omega / (2.0 * M_PI), omega, 100.0 * building_damping_ratio(g, m + 1),
               100.0 * mass_share(g, phi));
    }
}

static void print_shapes(const struct building *g, int first, int last) {
    printf("\n%6s", "floor");
    for (int m = first; m < last; m++) {
        printf(" %9s%2d", "mode", m + 1);
    }
    printf("\n");
    for (int i = g->n_floor - 1; i >= 0; i--) {
        printf("%6d", i + 1);
        for (int m = first; m < last; m++) {
            printf(" %11.5f", g->shape[(size_t)m * (size_t)g->n_floor + (size_t)i]);
        }
        printf("\n");
    }
}

static int print_modes(void *options, const struct model *m) {
    (void)options;
    sweeps_print_first(m->deck, "", "\n");
    for (int k = 0; k < m->n_building; k++) {
        const struct building *g = &m->building[k];
        printf("%sbuilding %s, %d floor%s\n\n", k ? "\n" : "", g->name, g->n_floor,
               g->n_floor == 1 ? "" : "s");
        print_table(g, m->deck->units.time_name);
        for (int first = 0; first < g->n_floor; first += MODES_IN_A_ROW) {
            int last = first + MODES_IN_A_ROW;
            print_shapes(g, first, last < g->n_floor ? last : g->n_floor);
        }
    }
    return EXIT_DONE;
}

static int modes_command(int argc, char **argv) {
    static const struct option_row rows[] = {DECK_DEFINE_ROW, {0}};
    static const struct option_part parts[] = {{.row = rows}, {.row = option_help}, {0}};
    static const struct deck_command c = {&command_modes, parts, NULL, print_modes};
    struct load_request load = {0};
    return deck_command_run(&c, argc, argv, &load);
}
