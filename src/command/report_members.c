// SPDX-License-Identifier: GPL-3.0-or-later
#include <math.h>
#include <string.h>

#include "command/report_summary.h"
#include "core/safe.h"

// The kinds of members, by which their names begin.
static const char *const kinds[] = {"column", "beam", "wall"};
enum { KINDS = sizeof kinds / sizeof kinds[0] };

// What a table shows of members: the largest values of up to three quantities.
enum { QUANTITIES = 3 };
struct member_table {
    int n;
    bool hinged;  // only of buildings with hinges
    struct {
        const char *name;
        const struct dimension *dimension;  // NULL: an angle, or a number
        size_t offset;                      // in struct report_member
        bool is_number;
    } of[QUANTITIES];
};

#define AT(member) offsetof(struct report_member, member)
static const struct member_table tables[] = {
    {3,
     false,
     {{"moment", &dimension_energy, AT(moment), false},
      {"shear", &dimension_force, AT(shear), false},
      {"axial", &dimension_force, AT(axial), false}}},
    {2,
     true,
     {{"plastic", NULL, AT(plastic), false},
      {"ductility", NULL, AT(demand.value[YIELD_DUCTILITY]), true}}},
};
enum { TABLES = sizeof tables / sizeof tables[0] };

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

static void print_kind(const struct member_table *t, const struct report_building *b,
                       const char *kind, FILE *to) {
    enum { LABEL = 16, NAME = 13 };
    int blanks = 0;  // that bring the line to the next column
    for (int q = 0; q < t->n; q++) {
        double value = NAN;
        const struct report_member *m = largest(b, kind, t->of[q].offset, &value);
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
        if (q == t->n - 1 && m) {
            fputc('\n', to);
        }
    }
}

// The unit of a quantity in brackets.
static void bracket_unit(const struct member_table *t, int q, const struct report *r, char *text,
                         size_t size) {
    char unit[64] = "rad";
    if (t->of[q].dimension) {
        unit_text(&r->units, *t->of[q].dimension, unit, sizeof unit);
    }
    snprintf(text, size, "%s%s%s", t->of[q].is_number ? "" : "[", t->of[q].is_number ? "" : unit,
             t->of[q].is_number ? "" : "]");
}

static void print_heads(const struct member_table *t, const struct report *r, FILE *to) {
    for (int line = 0; line < 2; line++) {
        fprintf(to, "%s%-16s", line == 0 ? "\n" : "", line == 0 ? "largest of" : "");
        for (int q = 0; q < t->n; q++) {
            char unit[70];
            bracket_unit(t, q, r, unit, sizeof unit);
            fprintf(to, " %10s", line == 0 ? t->of[q].name : unit);
            fprintf(to, "%*s%s", q < t->n - 1 ? 14 : 0, "", q < t->n - 1 ? "" : "\n");
        }
    }
}

void report_members_print(const struct report *r, const struct report_building *const *building,
                          int n, FILE *to) {
    for (int k = 0; k < TABLES; k++) {
        bool headed = false;
        for (int i = 0; i < n; i++) {
            const struct report_building *b = building[i];
            if (b->n_member == 0 || (tables[k].hinged && !b->hinged)) {
                continue;
            }
            if (!headed) {
                print_heads(&tables[k], r, to);
                headed = true;
            }
            for (int q = 0; q < KINDS; q++) {
                print_kind(&tables[k], b, kinds[q], to);
            }
        }
    }
}
