// SPDX-License-Identifier: GPL-3.0-or-later
#include "command/report_members.h"

#include <math.h>
#include <string.h>

#include "core/safe.h"

// The kinds of members, by which their names begin.
static const char *const kinds[] = {"column", "beam", "wall"};
enum { KINDS = sizeof kinds / sizeof kinds[0] };

// The member of a kind with the largest of these values, which are at `offset` of each; NULL: there
// is none.
static const struct report_member *largest(const struct report_building *b, const char *kind,
                                           size_t offset, double *value) {
    const struct report_member *most = NULL;
    for (int i = 0; i < b->n_member; i++) {
        double x;
        memcpy(&x, (const char *)&b->member[i] + offset, sizeof x);
        if (strncmp(b->member[i].name, kind, strlen(kind)) == 0 && (!most || x > *value)) {
            most = &b->member[i];
            *value = x;
        }
    }
    return most;
}

static void print_kind(const struct report_building *b, const char *kind, FILE *to) {
    static const size_t offset[] = {offsetof(struct report_member, moment),
                                    offsetof(struct report_member, shear),
                                    offsetof(struct report_member, axial)};
    enum { LABEL = 16, NAME = 13 };
    int blanks = 0;  // that bring the line to the next column
    for (int q = 0; q < 3; q++) {
        double value = NAN;
        const struct report_member *m = largest(b, kind, offset[q], &value);
        if (m && q == 0) {
            char label[32];
            snprintf(label, sizeof label, "%.20s %ss", b->name, kind);
            safe_cell(to, label, LABEL);
        }
        if (m && !isnan(value)) {
            const int length = (int)strlen(m->name);
            fprintf(to, "%*s %10.4g ", blanks, "", value);
            safe_cell(to, m->name, length < NAME ? length : NAME);
            blanks = length < NAME ? NAME - length : 0;
        }
        if (q == 2 && m) {
            fputc('\n', to);
        }
    }
}

void report_print_members(const struct report *r, const struct report_building *const *building,
                          int n, FILE *to) {
    bool headed = false;
    for (int i = 0; i < n; i++) {
        if (building[i]->n_member == 0) {
            continue;
        }
        if (!headed) {
            char moment[64], force[64];
            char of_moment[70], of_force[70];
            unit_text(&r->units, dimension_energy, moment, sizeof moment);
            unit_text(&r->units, dimension_force, force, sizeof force);
            snprintf(of_moment, sizeof of_moment, "[%s]", moment);
            snprintf(of_force, sizeof of_force, "[%s]", force);
            fprintf(to, "\n%-16s %10s %-13s %10s %-13s %10s\n", "largest of", "moment", "", "shear",
                    "", "axial");
            fprintf(to, "%-16s %10s %-13s %10s %-13s %10s\n", "", of_moment, "", of_force, "",
                    of_force);
            headed = true;
        }
        for (int k = 0; k < KINDS; k++) {
            print_kind(building[i], kinds[k], to);
        }
    }
}
