// SPDX-License-Identifier: GPL-3.0-or-later
#include "motion/time_series.h"

#include <assert.h>
#include <math.h>
#include <string.h>

#include "core/arena.h"
#include "motion/lines.h"
#include "motion/record_format.h"
#include "motion/table.h"

enum { FILE_SIZE_MAX = 256 << 20, N_COLUMN = TIME_SERIES_COLUMNS };  // N_COLUMN at most

// A file in progress.
struct file {
    struct record_text text;
    struct table table;
    const struct time_series_column *column;  // (n_column); NULL: numbers without units
    int n_column;
    bool ascends;           // the first of the columns must
    double unit[N_COLUMN];  // in SI
    double *value;          // (n_column, table.n_row) in SI
};

// A row of the file.
struct series_row {
    size_t index;
    int line;
    struct piece field[N_COLUMN];
    double printed[N_COLUMN];
};

// Reads the units from the caption. Their dimensions assign them to the columns.
static int read_caption(struct file *f, struct error *e) {
    struct unit_system si;
    struct piece rest = f->table.caption;
    struct piece text;
    unit_system_init(&si);
    while (lines_bracket(&rest, &text)) {
        struct dimension given;
        double size;
        if (!record_unit(text, si.gravity, &given, &size)) {
            continue;
        }
        int c = 0;
        while (c < f->n_column && !dimension_equal(given, f->column[c].dimension)) {
            c++;
        }
        if (c == f->n_column) {
            struct excerpt shown = lines_excerpt(text);
            return lines_error(e, f->text.path, f->table.caption_line,
                               f->n_column == 1 ? "unit '%s' is not that of %s"
                                                : "unit '%s' is that of neither %s nor %s",
                               shown.text, dimension_noun(f->column[0].dimension),
                               dimension_noun(f->column[f->n_column - 1].dimension));
        }
        f->unit[c] = size;
    }
    return STATUS_OK;
}

static int find_units(struct file *f, struct error *e) {
    struct unit_system si;
    unit_system_init(&si);
    for (int c = 0; c < f->n_column; c++) {
        f->unit[c] = f->column[c].unit;
    }
    const int status = read_caption(f, e);
    for (int c = 0; status == STATUS_OK && c < f->n_column; c++) {
        if (f->unit[c] == 0.0) {
            const char *name = f->column[c].name;
            char unit[32];
            unit_text(&si, f->column[c].dimension, unit, sizeof unit);
            return lines_error(e, f->text.path, f->table.first_line,
                               "the unit of %s is not given; the line above the numbers must give "
                               "it in brackets, as in '%s [%s]'",
                               name, name, unit);
        }
    }
    return status;
}

static int check_columns(const struct file *f, int line, size_t n, struct error *e) {
    if (n == (size_t)f->n_column) {
        return STATUS_OK;
    }
    return f->n_column == 1
               ? lines_error(e, f->text.path, line, "%zu columns; one is read, %s", n,
                             f->column[0].name)
               : lines_error(e, f->text.path, line, "%zu column%s; two are read, %s and %s", n,
                             n == 1 ? "" : "s", f->column[0].name, f->column[1].name);
}

static double *value_at(const struct file *f, int c, size_t row) {
    return f->value + (size_t)c * f->table.n_row + row;
}

static int check_value(const struct file *f, const struct series_row *r, int c, struct error *e) {
    const double value = *value_at(f, c, r->index);
    if (isfinite(value) && range_holds(f->column[c].range, value)) {
        return STATUS_OK;
    }
    return error_set(e, STATUS_INPUT, "%s: %s is %.6g; it must be %s",
                     lines_place_field(&f->text, r->line, r->field[c]).text, f->column[c].name,
                     r->printed[c],
                     isfinite(value) ? f->column[c].range->text : "below 1.8e308 in SI");
}

// " s" for a time; empty for a quantity without a unit.
static void unit_after_number(const struct file *f, char *text, size_t size) {
    struct unit_system si;
    text[0] = '\0';
    if (!dimension_equal(f->column[0].dimension, dimension_none)) {
        unit_system_init(&si);
        text[0] = ' ';
        unit_text(&si, f->column[0].dimension, text + 1, size - 1);
    }
}

static int check_order(const struct file *f, const struct series_row *r, struct error *e) {
    const double *value = value_at(f, 0, r->index);
    const char *name = f->column[0].name;
    char unit[32];
    if (!f->ascends || r->index == 0 || value[0] > value[-1]) {
        return STATUS_OK;
    }
    unit_after_number(f, unit, sizeof unit);
    return error_set(e, STATUS_INPUT, "%s: %s %.9g%s after %.9g%s; each %s must exceed the last",
                     lines_place_field(&f->text, r->line, r->field[0]).text, name, value[0], unit,
                     value[-1], unit, name);
}

// Reads row `index`, the current line of `l`.
static int read_row(struct file *f, const struct lines *l, size_t index, struct error *e) {
    struct series_row r = {.index = index, .line = l->number};
    struct piece rest = l->line;
    int status = check_columns(f, r.line, lines_count(l->line, f->table.separators), e);
    for (int c = 0; status == STATUS_OK && c < f->n_column; c++) {
        lines_field(&rest, f->table.separators, &r.field[c]);
        const struct number_field field = {&f->text, r.line, f->column[c].name, index + 1,
                                           r.field[c]};
        status = table_number(&f->table, &field, &r.printed[c], e);
        if (status == STATUS_OK) {
            *value_at(f, c, index) = r.printed[c] * f->unit[c];
            status = check_value(f, &r, c, e);
        }
    }
    return status == STATUS_OK ? check_order(f, &r, e) : status;
}

// Reads row `index` of numbers without units.
static int read_numbers(struct file *f, const struct lines *l, size_t index, struct error *e) {
    struct piece rest = l->line;
    const size_t found = lines_count(l->line, f->table.separators);
    if (found != (size_t)f->n_column) {
        return lines_error(e, f->text.path, l->number, "%zu columns; %d are read: the time and %d",
                           found, f->n_column, f->n_column - 1);
    }
    for (int c = 0; c < f->n_column; c++) {
        struct number_field field = {
            &f->text, l->number, c > 0 ? "value" : "time", index + 1, {NULL, 0}};
        lines_field(&rest, f->table.separators, &field.field);
        const int status = table_number(&f->table, &field, value_at(f, c, index), e);
        if (status != STATUS_OK) {
            return status;
        }
    }
    const double *time = value_at(f, 0, index);
    return index == 0 || time[0] > time[-1]
               ? STATUS_OK
               : lines_error(e, f->text.path, l->number, "times must increase");
}

static int read_rows(struct arena *a, struct file *f, struct error *e) {
    f->value = arena_alloc(a, (size_t)f->n_column * f->table.n_row, sizeof *f->value);
    if (!f->value) {
        return error_no_memory(e);
    }
    struct lines l = f->table.rows;
    int status = STATUS_OK;
    for (size_t i = 0; status == STATUS_OK && table_next(&l); i++) {
        status = f->column ? read_row(f, &l, i, e) : read_numbers(f, &l, i, e);
    }
    return status;
}

static int find_table(struct file *f, struct error *e) {
    struct record_text raw = f->text;
    int status = record_clean(&raw, &f->text, e);
    status = status == STATUS_OK ? table_read(&f->text, &f->table, e) : status;
    if (status != STATUS_OK || !f->column) {
        return status;
    }
    status = check_columns(f, f->table.first_line, f->table.n_column, e);
    return status == STATUS_OK ? find_units(f, e) : status;
}

static int read_file(struct arena *a, const char *path, struct file *f, struct error *e) {
    struct arena *scratch;
    int status = record_text_open(path, FILE_SIZE_MAX, &f->text, &scratch, e);
    if (status != STATUS_OK) {
        return status;
    }
    status = find_table(f, e);
    status = status == STATUS_OK ? read_rows(a, f, e) : status;
    arena_free(scratch);
    return status;
}

int time_series_columns(struct arena *a, const char *path, const struct time_series_column *column,
                        int n, const double **value, size_t *n_row, struct error *e) {
    assert(n >= 1 && n <= N_COLUMN);
    struct file f = {.column = column, .n_column = n};
    const int status = read_file(a, path, &f, e);
    for (int c = 0; status == STATUS_OK && c < n; c++) {
        value[c] = value_at(&f, c, 0);
        *n_row = f.table.n_row;
    }
    return status;
}

int time_series_read(struct arena *a, const char *path,
                     const struct time_series_column column[TIME_SERIES_COLUMNS],
                     struct time_series *out, struct error *e) {
    struct file f = {.column = column, .n_column = N_COLUMN, .ascends = true};
    const int status = read_file(a, path, &f, e);
    if (status == STATUS_OK) {
        *out = (struct time_series){f.table.n_row, value_at(&f, 0, 0), value_at(&f, 1, 0)};
    }
    return status;
}

int time_series_matrix(struct arena *a, const char *path, int n_column, const double **value,
                       size_t *n_row, struct error *e) {
    struct file f = {.n_column = n_column};
    const int status = read_file(a, path, &f, e);
    *value = f.value;
    *n_row = f.table.n_row;
    return status;
}
