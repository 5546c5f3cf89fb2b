// SPDX-License-Identifier: GPL-3.0-or-later
// Values that continue from line to line, three or more in a line, without times (8F10.5, for
// example). Several columns look the same if all rows are full. So without -format, a file counts
// as a series only if it has a single row, or if its last row is shorter.
#include "motion/table.h"
#include "motion/values.h"

static bool series_matches(const struct record_text *t) {
    struct table table;
    if (!table_find(t, &table) || table.n_column < 3) {
        return false;
    }
    return table.n_row == 1 || (table.n_ragged == 0 && table.n_last < table.n_column);
}

static bool series_read(const struct record_reader *r) {
    struct table table;
    if (table_read(r->text, &table, r->e) != STATUS_OK) {
        return false;
    }
    if (table.comma) {
        return record_fail(r, table.first_line, "decimal commas; only -format columns reads them");
    }
    int last_line;
    const size_t n = values_count(table.rows, table.separators, &last_line);
    return values_read(r, table.rows, table.separators, n);
}

const struct record_format record_series = {
    .name = "series",
    .doc = "values running on from line to line, with -dt",
    .plain = true,
    .matches = series_matches,
    .read = series_read,
};
