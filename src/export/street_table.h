// SPDX-License-Identifier: GPL-3.0-or-later
// The table of a street: a line of headings, then a line for each building. Commas, semicolons or
// tabs separate cells, as the headings have them. A heading may have a unit in brackets, and a
// number its own unit. A number with a dimension needs one of both. Blank lines and comments do not
// count.
#ifndef JOSTLE_EXPORT_STREET_TABLE_H
#define JOSTLE_EXPORT_STREET_TABLE_H

#include "jostle/units.h"
#include "motion/lines.h"
#include "motion/record_format.h"

enum { STREET_COLUMNS_MAX = 256 };

// The columns. Those without a dimension are texts.
enum street_key {
    STREET_NAME,
    STREET_TYPE,
    STREET_CODE,
    STREET_LAW,
    STREET_STOREYS,  // the first number
    STREET_YEAR,
    STREET_STOREY_HEIGHT,
    STREET_HEIGHT,
    STREET_AREA,
    STREET_MASS,
    STREET_PERIOD,
    STREET_STIFFNESS,
    STREET_YIELD,
    STREET_HARDENING,
    STREET_DAMPING,
    STREET_GAP,
    STREET_K,
    STREET_E,
    STREET_KEYS
};
extern const struct street_column {
    const char *name;
    const struct dimension *dimension;
    double least, most;  // [SI] of numbers
    bool whole;
} street_columns[STREET_KEYS];

struct street_table {
    struct record_text text;
    struct lines lines;
    char separator;
    int n_column;
    int key[STREET_COLUMNS_MAX];     // of each column; -1: not used
    double unit[STREET_KEYS];        // [SI] of its heading; 0: none
    struct piece cell[STREET_KEYS];  // of the line; empty: not given
    double value[STREET_KEYS];       // [SI] of the line; NAN: not given
    struct arena *arena;             // borrowed
    struct diagnostics *d;           // borrowed
};

// Reads the headings of the text.
void street_table_begin(struct street_table *r);

// Goes to the next building; false at the end. *good: its cells could be read.
bool street_table_next(struct street_table *r, bool *good);

// A message about a piece of the current line.
void street_table_report(struct street_table *r, enum severity severity, struct piece at,
                         const char *format, ...) __attribute__((format(printf, 4, 5)));

// The piece as a text in the arena; "" without memory, which the arena remembers.
const char *street_table_text(struct street_table *r, struct piece p);
bool street_table_is(struct piece p, const char *word);

#endif
