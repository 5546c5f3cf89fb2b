// SPDX-License-Identifier: GPL-3.0-or-later
// A curve of force against penetration, from rows of penetration, loading force and unloading
// force. If both branches are equal, the unloading force may be missing. The layout of the text is
// that of records: spaces, tabs, commas or semicolons, comments, and lines of text above the
// numbers. The last of these lines may give the units in brackets: `penetration (mm), force (kN)`.
//
// Curves are not smoothed. A curve with a decreasing loading force is an error. So is an unloading
// branch that returns more energy than the loading branch took. The error points at the first such
// line.
#include "motion/curve_file.h"

#include <math.h>

#include "core/arena.h"
#include "motion/record_format.h"
#include "motion/table.h"

enum { FILE_SIZE_MAX = 16 << 20, POINTS_MAX = 100000 };

static const char *const column_name[CURVE_COLUMNS] = {"penetration", "loading force",
                                                       "unloading force"};

// Relative: the forces are decimals, but their ratio is rounded.
static const double ROUNDING = 1e-9;

// A row as it is read.
struct curve_row {
    const struct record_text *text;
    int line;
    struct piece field[CURVE_COLUMNS];
    double *value;         // (CURVE_COLUMNS)
    const double *before;  // (CURVE_COLUMNS) the row above; NULL: the first row
};

static struct line_place place(const struct curve_row *r, enum curve_column column) {
    return lines_place_field(r->text, r->line, r->field[column]);
}

// Unloading force divided by loading force; NAN if the loading force is 0.
static double share(const double *point) {
    return point[CURVE_LOADING] > 0.0 ? point[CURVE_UNLOADING] / point[CURVE_LOADING] : NAN;
}

static int check_row(const struct curve_row *r, struct error *e) {
    if (!r->before) {
        for (enum curve_column c = 0; c < CURVE_COLUMNS; c++) {
            if (r->value[c] != 0.0) {
                return error_set(e, STATUS_INPUT, "%s: first %s is %.6g; a curve must begin at 0",
                                 place(r, c).text, column_name[c], r->value[c]);
            }
        }
        return STATUS_OK;
    }
    if (r->value[CURVE_PENETRATION] <= r->before[CURVE_PENETRATION]) {
        return error_set(e, STATUS_INPUT,
                         "%s: penetration %.6g after %.6g; penetrations must increase",
                         place(r, CURVE_PENETRATION).text, r->value[CURVE_PENETRATION],
                         r->before[CURVE_PENETRATION]);
    }
    if (r->value[CURVE_LOADING] < r->before[CURVE_LOADING]) {
        return error_set(
            e, STATUS_INPUT, "%s: loading force %.6g after %.6g; loading forces must not fall",
            place(r, CURVE_LOADING).text, r->value[CURVE_LOADING], r->before[CURVE_LOADING]);
    }
    double loading = r->value[CURVE_LOADING];
    double unloading = r->value[CURVE_UNLOADING];
    if (unloading < 0.0 || unloading > loading) {
        return error_set(
            e, STATUS_INPUT,
            "%s: unloading force is %.6g; it must be >= 0 and <= the loading force, which is %.6g",
            place(r, CURVE_UNLOADING).text, unloading, loading);
    }
    if (share(r->value) < share(r->before) * (1.0 - ROUNDING)) {
        return error_set(e, STATUS_INPUT,
                         "%s: unloading force is %.6g of the loading force, but %.6g in the row "
                         "above; this share must not fall, or cycles would create energy",
                         place(r, CURVE_UNLOADING).text, share(r->value), share(r->before));
    }
    return STATUS_OK;
}

// Reads the line. With two columns both branches are equal.
static int read_row(struct curve_row *r, const struct table *table, struct piece line, size_t index,
                    struct error *e) {
    const size_t n = lines_count(line, table->separators);
    if (n != table->n_column) {
        return lines_error(e, r->text->path, r->line, "row of %zu values; the first has %zu", n,
                           table->n_column);
    }
    for (size_t c = 0; c < CURVE_COLUMNS; c++) {
        size_t from = c < table->n_column ? c : table->n_column - 1;
        if (c < table->n_column) {
            lines_field(&line, table->separators, &r->field[c]);
        }
        struct number_field f = {r->text, r->line, column_name[c], index, r->field[from]};
        int status = table_number(table, &f, &r->value[c], e);
        if (status) {
            return status;
        }
        r->field[c] = r->field[from];
    }
    return check_row(r, e);
}

static int read_rows(const struct record_text *t, const struct table *table, double *point,
                     struct error *e) {
    struct curve_row r = {.text = t, .value = point};
    struct lines l = table->rows;
    for (size_t i = 0; table_next(&l); i++) {
        r.line = l.number;
        r.value = point + i * CURVE_COLUMNS;
        r.before = i > 0 ? r.value - CURVE_COLUMNS : NULL;
        int status = read_row(&r, table, l.line, i + 1, e);
        if (status) {
            return status;
        }
    }
    if (r.value[CURVE_LOADING] == 0.0) {
        return error_set(e, STATUS_INPUT, "%s: last loading force is 0; it must be > 0",
                         place(&r, CURVE_LOADING).text);
    }
    if (share(r.value) < 1.0 - ROUNDING) {
        return error_set(e, STATUS_INPUT,
                         "%s: last unloading force is %.6g; the branches must meet at the last "
                         "point, where the loading force is %.6g",
                         place(&r, CURVE_UNLOADING).text, r.value[CURVE_UNLOADING],
                         r.value[CURVE_LOADING]);
    }
    return STATUS_OK;
}

static int check_size(const struct record_text *t, const struct table *table, struct error *e) {
    if (table->n_column < 2 || table->n_column > CURVE_COLUMNS) {
        return lines_error(e, t->path, table->first_line,
                           "row of %zu values; a curve has 2 or 3 columns: penetration, loading "
                           "force and unloading force",
                           table->n_column);
    }
    return table->n_row >= 2 && table->n_row <= POINTS_MAX
               ? STATUS_OK
               : lines_error(e, t->path, table->first_line, "%zu points; a curve has 2 to %d",
                             table->n_row, POINTS_MAX);
}

// Units of length and force in brackets; other brackets are text. An error if *length or *force is
// already another unit.
static int read_caption(const struct record_text *t, const struct table *table, double gravity,
                        double *length, double *force, struct error *e) {
    struct piece rest = table->caption;
    struct piece unit;
    while (lines_bracket(&rest, &unit)) {
        struct dimension dimension;
        double si;
        if (!record_unit(unit, gravity, &dimension, &si)) {
            continue;
        }
        double *size = dimension_equal(dimension, dimension_length)  ? length
                       : dimension_equal(dimension, dimension_force) ? force
                                                                     : NULL;
        if (size && *size > 0.0 && *size != si) {
            return lines_error(
                e, t->path, table->caption_line,
                "the caption gives the unit '%s', but an option or an earlier column gives another",
                lines_excerpt(unit).text);
        }
        if (size) {
            *size = si;
        }
    }
    return STATUS_OK;
}

// Converts the curve from the units of the file (0: not given) to those of the deck.
static void convert(double *point, size_t n, double length, double force,
                    const struct unit_system *units) {
    for (size_t i = 0; i < n * CURVE_COLUMNS; i++) {
        const bool is_length = i % CURVE_COLUMNS == CURVE_PENETRATION;
        const double from = is_length ? length : force;
        if (from > 0.0) {
            point[i] = unit_convert(point[i], from, is_length ? units->length : units->force);
        }
    }
}

// Checks that the slopes of the converted curve are finite.
static int check_slopes(const struct record_text *t, const double *point, size_t n,
                        struct error *e) {
    for (size_t i = 1; i < n; i++) {
        const double *p = point + i * CURVE_COLUMNS;
        double step = p[CURVE_PENETRATION] - p[CURVE_PENETRATION - CURVE_COLUMNS];
        if (!isfinite(1.0 / step) || !isfinite(p[CURVE_PENETRATION]) ||
            !isfinite(p[CURVE_LOADING] / step)) {
            return lines_error(e, t->path, 0,
                               "point %zu of %zu is out of range, or too close to the one before "
                               "it, in the deck's units",
                               i + 1, n);
        }
    }
    return STATUS_OK;
}

int curve_read_text(struct arena *a, const struct curve_request *request,
                    const struct record_text *t, struct curve *out, struct error *e) {
    struct record_text text;
    struct table table;
    double length = request->length, force = request->force;
    if (record_clean(t, &text, e) != STATUS_OK || table_read(&text, &table, e) != STATUS_OK ||
        check_size(&text, &table, e) != STATUS_OK ||
        read_caption(&text, &table, request->units->gravity, &length, &force, e) != STATUS_OK) {
        return e->status;
    }
    double *point = arena_alloc(a, table.n_row, CURVE_COLUMNS * sizeof *point);
    if (!point) {
        return error_no_memory(e);
    }
    if (read_rows(&text, &table, point, e) != STATUS_OK) {
        return e->status;
    }
    convert(point, table.n_row, length, force, request->units);
    const int status = check_slopes(&text, point, table.n_row, e);
    if (status == STATUS_OK) {
        *out = (struct curve){.n = (int)table.n_row, .point = point};
    }
    return status;
}

int curve_read(struct arena *a, const struct curve_request *request, struct curve *out,
               struct error *e) {
    struct record_text t;
    struct arena *scratch;
    int status = record_text_open(request->path, FILE_SIZE_MAX, &t, &scratch, e);
    if (status == STATUS_OK) {
        status = curve_read_text(a, request, &t, out, e);
        arena_free(scratch);
    }
    return status;
}
