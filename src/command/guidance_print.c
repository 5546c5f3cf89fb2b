// SPDX-License-Identifier: GPL-3.0-or-later
#include "command/check.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

enum { NAME_WIDTH = 28 };

// Contacts that follow each other and differ by less than what is printed.
static bool looks_the_same(const struct guidance_contact *a, const struct guidance_contact *b) {
    char text[2][64];
    snprintf(text[0], sizeof text[0], "%.3g %.3g", a->velocity, a->duration);
    snprintf(text[1], sizeof text[1], "%.3g %.3g", b->velocity, b->duration);
    return strcmp(text[0], text[1]) == 0;
}

static void print_contacts(const struct model *m, const struct guidance *g) {
    const struct unit_system *u = &m->deck->units;
    char velocity[48];
    unit_text(u, dimension_velocity, velocity, sizeof velocity);
    printf("\n%-*s %12s %12s %12s\n", NAME_WIDTH, "estimated for contact", "closes at", "lasts",
           "steps");
    printf("%-*s %12s %12s\n", NAME_WIDTH, "", velocity, u->time_name);
    for (int first = 0, last; first < g->n_contact; first = last + 1) {
        last = first;
        while (last + 1 < g->n_contact &&
               looks_the_same(&g->contact[first], &g->contact[last + 1])) {
            last++;
        }
        const struct guidance_contact *c = &g->contact[first];
        printf("%-*s ", NAME_WIDTH, m->link[first].name);
        if (c->duration == 0.0) {
            printf("%12.3g %12s %12s", c->velocity, "-", "-");
        } else if (isnan(c->duration)) {
            printf("%12.3g %12s %12s", c->velocity, "unknown", "-");
        } else {
            printf("%12.3g %12.3g %12.3g", c->velocity, c->duration, c->duration / m->dt);
        }
        if (last > first) {
            printf("  to %s", m->link[last].name);
        }
        printf("\n");
    }
    if (g->n_contact < m->n_contact) {
        printf("the other %d contacts are not estimated\n", m->n_contact - g->n_contact);
    }
}

// What a length of time asks of the step; nothing if it is infinite.
static void print_demand(const struct model *m, const char *what, double time, int n_step) {
    if (isfinite(time)) {
        const char *unit = m->deck->units.time_name;
        printf("  %-24s %9.4g %s, %.4g steps; over %d: %.3g %s\n", what, time, unit, time / m->dt,
               n_step, time / n_step, unit);
    }
}

void guidance_print(const struct model *m, const struct guidance *g) {
    if (g->n_contact > 0) {
        print_contacts(m, g);
    }
    if (!isfinite(g->step)) {
        return;
    }
    printf("\nthe step must resolve\n");
    print_demand(m, "the shortest contact",
                 g->shortest < 0 ? INFINITY : g->contact[g->shortest].duration,
                 GUIDANCE_CONTACT_STEPS);
    print_demand(m, "the shortest period", g->period, GUIDANCE_PERIOD_STEPS);
    print_demand(m, "a sine", g->sine, GUIDANCE_PERIOD_STEPS);
    print_demand(m, "the sampling", g->sampling, 1);
    printf("so 'step fixed %g' does; here it is %.6g %s\n", g->step, m->dt,
           m->deck->units.time_name);
}
