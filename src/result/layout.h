// SPDX-License-Identifier: GPL-3.0-or-later
// What is in a result file: one row for each dataset or attribute. The writer, the reader and
// `show` work from these tables.
#ifndef JOSTLE_LAYOUT_H
#define JOSTLE_LAYOUT_H

#include <stddef.h>

#include "jostle/result.h"

enum column_kind { COLUMN_DOUBLE, COLUMN_LONG, COLUMN_INT, COLUMN_FLAG, COLUMN_TEXT };

// The number that member of kind COLUMN_LONG, COLUMN_INT or COLUMN_FLAG stands for in the file.
struct column;
long layout_whole(const struct column *c, const void *at);

// One member of a struct, as a dataset over an array of them or as an attribute.
struct column {
    const char *name;
    const char *long_name;              // NULL for attributes
    const struct dimension *dimension;  // NULL: a pure number or a text
    enum column_kind kind;
    size_t offset;  // in the struct
    int base;       // added to whole numbers in the file: 1 turns an index into a number from 1
};

struct column_table {
    const struct column *column;
    int n_column;
    size_t size;  // of the struct
};

extern const struct column_table layout_root;       // of struct report: attributes of /
extern const struct column_table layout_totals;     // of struct totals: attributes of /
extern const struct column_table layout_link;       // of struct report_link: /contacts and /links
extern const struct column_table layout_level;      // the same, where layout_has_levels
extern const struct column_table layout_contact;    // of struct report_link: /contacts/envelope
extern const struct column_table layout_link_peak;  // of struct report_link: /links/envelope
extern const struct column_table layout_impact;     // of struct impact: /impacts
extern const struct column_table
    layout_building;  // of struct report_building: pointers to (n_floor)

// Quantities with a history; the name is in field_names, peak_names or energy_names.
struct quantity {
    const char *long_name;
    const struct dimension *dimension;
};
extern const struct quantity layout_field[];   // in the order of enum field's bits
extern const struct quantity layout_peak[];    // (PEAK_COUNT)
extern const struct quantity layout_energy[];  // (ENERGY_COUNT)
extern const struct quantity layout_residual_drift;
extern const char layout_residual_drift_name[];

enum { FLOOR_FIELD_COUNT = 5, FIELD_COUNT = 7 };

// A group of links: contacts, or bilateral links.
struct link_group {
    const char *name, *scale;          // of the group, and of its dimension
    const struct column_table *peaks;  // of its envelope
    const char *field[2];              // its histories: force, and penetration or deformation
    const struct quantity *quantity;   // (2) of them
};
extern const struct link_group layout_contacts, layout_links;

// Is an end of a link at a level between two floors?
bool layout_has_levels(const struct report_link *link, int n);

// Address of column `c` in struct number `i` of the array at `base`.
const void *layout_at(const struct column_table *t, int c, const void *base, size_t i);
// The same to be written to.
void *layout_to(const struct column_table *t, int c, void *base, size_t i);

#endif
