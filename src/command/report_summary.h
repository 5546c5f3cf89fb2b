// SPDX-License-Identifier: GPL-3.0-or-later
// What the parts of the summary of a run share: its tables, and lines that say what they leave out.
#ifndef JOSTLE_REPORT_SUMMARY_H
#define JOSTLE_REPORT_SUMMARY_H

#include "command/choice.h"
#include "command/printer.h"
#include "jostle/result.h"

enum { NAME_WIDTH_MIN = 8, NAME_WIDTH_MAX = 16, LINK_WIDTH_MAX = 33, LAW_WIDTH_MAX = 17 };

#define READ(name, wide, of)                                                                       \
    { .head = name, .dimension = &dimension_##of, .width = wide, .digits = 4, .look = LOOK_READ }
#define COUNT(name, wide) COLUMN_G(name, wide, 9)
#define RATIO(wide)                                                                                \
    { .head = "of height", .unit = "%", .width = wide, .digits = 4, .look = LOOK_READ }

struct report_summary {
    FILE *to;
    const struct report *r;
    int status;
    struct error *e;
};

// The entries of a table and the width of their names.
struct report_shown {
    struct choice choice[SHOWN_MAX];
    int n, width;
};

// Writes all cells of entry `i`. Returns whether one has the mark of a floor that was hit.
typedef bool report_row_function(struct printer *t, const struct report *r, int i);

// A table with the names of the entries and the columns behind them.
void report_summary_table(struct report_summary *s, const struct report_shown *shown,
                          const char *name, const struct printer_column *column, int n,
                          report_row_function *row);

#define PRINT_TABLE(s, shown, name, column, row)                                                   \
    report_summary_table(s, shown, name, column, (int)(sizeof(column) / sizeof(column)[0]), row)

// Says that `n` more entries are not shown, which are less severe by `order`.
void report_summary_rest(const struct report_summary *s, int n, const char *what,
                         const char *order);

// The width of a column so far, or that of `text`, up to `limit`.
int report_summary_widest(int width, const char *text, int limit);

// The parts about contacts, links, and columns that are struck (report_links.c).
void report_links_contacts(struct report_summary *s);
void report_links_links(struct report_summary *s);
void report_links_columns(struct report_summary *s);

// Prints the largest forces of members of frames and walls: a line for the columns, the beams and
// the walls of each of these buildings (n) that has such members (report_members.c).
void report_members_print(const struct report *r, const struct report_building *const *building,
                          int n, FILE *to);

#endif
