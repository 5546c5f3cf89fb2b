// SPDX-License-Identifier: GPL-3.0-or-later
#include "motion/time_series.h"

#include "core/arena.h"
#include "motion/lines.h"
#include "motion/record_unit.h"
#include "motion/table.h"

enum { FILE_SIZE_MAX = 256 << 20, N_COLUMN = 2 };

// A file being read.
struct file {
    struct record_text text;
    struct table table;
    double *column[N_COLUMN];  // (table.n_row) time, value
    double unit[N_COLUMN];     // in SI
};

// Takes the units from the caption, by their dimensions.
static int read_caption(struct file *f, struct dimension dimension, struct error *e) {
    struct unit_system si;
    struct piece rest = f->table.caption;
    struct piece text;
    unit_system_init(&si);
    f->unit[0] = f->unit[1] = 1.0;
    while (lines_bracket(&rest, &text)) {
        struct dimension given;
        double size;
        if (!record_unit(text, si.gravity, &given, &size)) {
            continue;
        }
        if (dimension_equal(given, dimension_time)) {
            f->unit[0] = size;
        } else if (dimension_equal(given, dimension)) {
            f->unit[1] = size;
        } else {
            struct excerpt shown = lines_excerpt(text);
            return lines_error(e, f->text.path, f->table.caption_line,
                               "unit '%s' is that of neither a time nor %s", shown.text,
                               dimension_noun(dimension));
        }
    }
    return STATUS_OK;
}

static int check_columns(const struct file *f, int line, size_t n, struct error *e) {
    return n == N_COLUMN
               ? STATUS_OK
               : lines_error(e, f->text.path, line, "%zu column%s; two are read, time and value", n,
                             n == 1 ? "" : "s");
}

// Reads row `i`, on which `l` stands.
static int read_row(struct file *f, const struct lines *l, size_t i, struct error *e) {
    static const char *const names[N_COLUMN] = {"time", "value"};
    struct piece rest = l->line;
    int status = check_columns(f, l->number, lines_count(l->line, table_separators), e);
    if (status != STATUS_OK) {
        return status;
    }
    for (int c = 0; c < N_COLUMN; c++) {
        struct number_field field = {f->text.path, l->number, names[c], i + 1, {0}};
        lines_field(&rest, table_separators, &field.field);
        status = lines_read_number(&field, &f->column[c][i], e);
        if (status != STATUS_OK) {
            return status;
        }
        f->column[c][i] *= f->unit[c];
    }
    const double *time = f->column[0];
    if (i > 0 && time[i] <= time[i - 1]) {
        return lines_error(e, f->text.path, l->number, "time %.9g s after %.9g s; times must grow",
                           time[i], time[i - 1]);
    }
    return STATUS_OK;
}

static int read_rows(struct arena *a, struct file *f, struct error *e) {
    for (int c = 0; c < N_COLUMN; c++) {
        f->column[c] = arena_alloc(a, f->table.n_row, sizeof *f->column[c]);
        if (!f->column[c]) {
            return error_no_memory(e);
        }
    }
    struct lines l = f->table.rows;
    for (size_t i = 0; table_next(&l); i++) {
        int status = read_row(f, &l, i, e);
        if (status != STATUS_OK) {
            return status;
        }
    }
    return STATUS_OK;
}

static int read_text(struct arena *a, struct file *f, struct dimension dimension, struct error *e) {
    struct record_text raw = f->text;
    int status = record_clean(&raw, &f->text, e);
    if (status == STATUS_OK && !table_find(&f->text, &f->table)) {
        return lines_error(e, f->text.path, 0, "there is no line of numbers");
    }
    if (status == STATUS_OK) {
        status = table_check(&f->text, &f->table, e);
    }
    if (status == STATUS_OK) {
        status = check_columns(f, f->table.first_line, f->table.n_column, e);
    }
    if (status == STATUS_OK) {
        status = read_caption(f, dimension, e);
    }
    return status == STATUS_OK ? read_rows(a, f, e) : status;
}

int time_series_read(struct arena *a, const char *path, struct dimension dimension,
                     struct time_series *out, struct error *e) {
    struct file f = {0};
    struct arena *scratch;
    int status = record_text_open(path, FILE_SIZE_MAX, &f.text, &scratch, e);
    if (status != STATUS_OK) {
        return status;
    }
    status = read_text(a, &f, dimension, e);
    if (status == STATUS_OK) {
        *out = (struct time_series){f.table.n_row, f.column[0], f.column[1]};
    }
    arena_free(scratch);
    return status;
}
