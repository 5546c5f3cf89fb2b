// SPDX-License-Identifier: GPL-3.0-or-later
#include "command/report_head.h"

#include <math.h>
#include <string.h>

#include "core/safe.h"

// The number of a run in a study, and the values of its parameters, a line each.
static void print_run(const struct report *r, FILE *to) {
    fprintf(to, "run %ld of a study\n", r->run);
    for (const char *line = r->parameters; *line;) {
        const int n = (int)strcspn(line, "\n");
        safe_line(to, "  %.*s", n, line);
        line += n + (line[n] == '\n');
    }
}

static void print_collapse(const struct report *r, FILE *to) {
    const struct report_collapse *c = &r->collapse;
    const char *length = r->units.length_name, *time = r->units.time_name;
    if (c->happened) {
        safe_line(to,
                  "COLLAPSED at %.6g %s: the drift of storey %ld of building %s reached %.4g %s; "
                  "the run ended there",
                  c->time, time, c->storey, c->building, fabs(c->drift), length);
    }
}

void report_head(const struct report *r, FILE *to) {
    if (r->title[0]) {
        safe_line(to, "%s", r->title);
    }
    if (r->run > 0) {
        print_run(r, to);
    }
    fprintf(to, "units %s %s %s, duration %.6g %s, ", r->units.force_name, r->units.length_name,
            r->units.time_name, r->duration, r->units.time_name);
    if (r->dt > 0.0) {
        fprintf(to, "step %.6g %s\n", r->dt, r->units.time_name);
    } else {
        fprintf(to, "adaptive steps\n");
    }
    print_collapse(r, to);
}
