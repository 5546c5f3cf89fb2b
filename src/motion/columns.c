// SPDX-License-Identifier: GPL-3.0-or-later
// One column of values, or a column of times and one or more columns of values. Each column of
// values is a channel. Spaces, tabs, commas or semicolons separate columns. A line that begins with
// # % ! * or // is a comment. Comments are above or below the numbers. In a line of numbers, a #
// before a space begins a comment. Lines of text may be above the numbers. The last of them may
// give the units in brackets: `time (s),acceleration (g)`.
//
// Times must ascend in equal steps. The step is the mean step, with the fewest digits that give it
// to 1e-12. This rounding removes only the error of the division. A time may be TIME_ERROR_MAX
// steps off the even grid, because times are often printed with few digits.
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "core/arena.h"
#include "motion/record_format.h"
#include "motion/table.h"
#include "motion/values.h"

// In steps. Times of 256 samples a second with three printed decimals are 0.13 steps off.
static const double TIME_ERROR_MAX = 0.2;

static bool columns_matches(const struct record_text *t) {
    struct table table;
    return table_find(t, &table);
}

// The part of a table that is read.
struct columns {
    const struct record_text *text;
    const struct table *table;
    bool has_time;  // column 0 has times
    size_t column;  // of the values, from 0
    double *time;   // (n_row) [s]; NULL: the file has no times
    double *value;  // (n_row)
};

static int check_time_unit(const struct record_text *t, const struct table *table,
                           struct piece unit, struct dimension dimension, double si,
                           struct error *e) {
    if (dimension_equal(dimension, dimension_time) && si != 1) {
        struct excerpt shown = lines_excerpt(unit);
        return lines_error(e, t->path, table->caption_line, "times are in '%s'; they must be in s",
                           shown.text);
    }
    return STATUS_OK;
}

// Reads the unit of the values from the caption. One unit is that of all columns of values. As many
// units as columns belong to one column each. Brackets without a unit are text.
static int read_caption(const struct record_request *request, const struct columns *c,
                        struct record_content *out, struct error *e) {
    const struct table *table = c->table;
    const size_t n_channel = table->n_column - c->has_time;
    struct piece rest = table->caption;
    struct piece unit;
    size_t n = 0;
    int status = STATUS_OK;
    while (!status && lines_bracket(&rest, &unit)) {
        struct dimension dimension;
        double si;
        if (!record_unit(unit, request->gravity, &dimension, &si)) {
            continue;
        }
        status = check_time_unit(c->text, table, unit, dimension, si, e);
        if (dimension_equal(dimension, dimension_time)) {
            continue;
        }
        if (n == 0 || n + c->has_time == c->column) {
            out->unit = dimension_equal(dimension, dimension_acceleration) ? si : 0;
            out->unit_text = lines_excerpt(unit);
            out->unit_line = table->caption_line;
        }
        n++;
    }
    out->unit_line = n == 1 || n == n_channel ? out->unit_line : 0;
    return status;
}

// The decimal number with the fewest digits that equals `x` within a relative error of 1e-12.
static double shortest(double x) {
    for (int digits = 1; digits < 13; digits++) {
        double unit = pow(10, floor(log10(x)) + 1 - digits);
        // Dividing by an exact power of ten gives the same double as reading the decimal.
        double candidate = unit < 1 ? round(x / unit) / round(1 / unit) : round(x / unit) * unit;
        if (fabs(candidate - x) <= 1e-12 * x) {
            return candidate;
        }
    }
    return x;
}

static int check_step(const struct columns *c, size_t i, const struct lines *l, struct error *e) {
    const double *time = c->time;
    if (time[i] <= time[i - 1]) {
        bool comma = memchr(l->line.text, ',', l->line.n);
        return lines_error(e, c->text->path, l->number, "time %g after %g; times must increase%s",
                           time[i], time[i - 1], comma ? " (a comma ends a number)" : "");
    }
    double first = time[1] - time[0];
    double step = time[i] - time[i - 1];
    if (fabs(step - first) > 2 * TIME_ERROR_MAX * first) {
        return lines_error(e, c->text->path, l->number,
                           "step of %.6g s to time %g; the first step is %.6g s and steps must be "
                           "even",
                           step, time[i], first);
    }
    return STATUS_OK;
}

// Reads row `i`, the current line of `l`.
static int read_row(const struct columns *c, const struct lines *l, size_t i,
                    struct record_content *out, struct error *e) {
    size_t n = lines_count(l->line, c->table->separators);
    if (n != c->table->n_column) {
        return lines_error(e, c->text->path, l->number,
                           "row of %zu values; the first (line %d) "
                           "has %zu",
                           n, c->table->first_line, c->table->n_column);
    }
    struct piece rest = l->line;
    struct number_field f = {c->text, l->number, "time", i + 1, {0}};
    int status = STATUS_OK;
    lines_field(&rest, c->table->separators, &f.field);
    if (c->has_time) {
        status = table_number(c->table, &f, &c->time[i], e);
        if (!status && i > 0) {
            status = check_step(c, i, l, e);
        }
    }
    for (size_t k = 0; k < c->column; k++) {
        lines_field(&rest, c->table->separators, &f.field);
    }
    if (!status) {
        f.what = "value";
        status = table_number(c->table, &f, &c->value[i], e);
    }
    if (!status) {
        values_note_peak(out, c->value, i, l->number);
    }
    return status;
}

static int read_rows(const struct columns *c, struct record_content *out, struct error *e) {
    struct lines l = c->table->rows;
    for (size_t i = 0; table_next(&l); i++) {
        int status = read_row(c, &l, i, out, e);
        if (status) {
            return status;
        }
    }
    return STATUS_OK;
}

// The number of the line with row `i`.
static int row_line(const struct table *table, size_t i) {
    struct lines l = table->rows;
    for (size_t k = 0; k <= i && table_next(&l); k++) {
    }
    return l.number;
}

// Finds the time step and the largest distance of a time from the even grid.
static int find_step(const struct columns *c, size_t n, struct record_content *out,
                     struct error *e) {
    double start = c->time[0];
    out->time_offset = start;
    if (n < 2) {
        return STATUS_OK;
    }
    out->dt = shortest((c->time[n - 1] - start) / (double)(n - 1));
    out->dt_line = c->table->first_line;
    out->dt_tolerance = TIME_ERROR_MAX * out->dt / (double)(n - 1);
    size_t worst = 0;
    for (size_t i = 0; i < n; i++) {
        double off = fabs((c->time[i] - start) / out->dt - (double)i);
        worst = off > out->time_error ? i : worst;
        out->time_error = fmax(out->time_error, off);
    }
    if (!isfinite(out->dt) || !(out->time_error <= TIME_ERROR_MAX)) {
        return lines_error(e, c->text->path, row_line(c->table, worst),
                           "time %g is %.3g steps of %.6g s off the even grid from first to last "
                           "time; steps must be even",
                           c->time[worst], out->time_error, out->dt);
    }
    return STATUS_OK;
}

// Finds the column that -channel requests.
static int choose_column(const struct record_request *request, struct columns *c,
                         struct record_content *out, struct error *e) {
    const size_t n = c->table->n_column - c->has_time;
    const size_t wanted = request->channel == 0 && n == 1 ? 1 : (size_t)request->channel;
    if (wanted == 0) {
        return lines_error(e, c->text->path, c->table->first_line,
                           "%zu columns; %s; -format series reads values that run on from line "
                           "to line",
                           c->table->n_column,
                           request->plain ? "one or two (time and value) are read"
                                          : "-channel chooses a column after the times");
    }
    if (wanted > n) {
        out->wrong = RECORD_CHANNEL;
        return lines_error(e, c->text->path, c->table->first_line,
                           "the file has no channel %zu; it has %zu, one per column%s", wanted, n,
                           c->has_time ? " after the times" : "");
    }
    c->column = wanted - !c->has_time;
    return STATUS_OK;
}

static int read_table(struct arena *a, struct columns *c, struct record_content *out,
                      struct error *e) {
    const size_t n = c->table->n_row;
    c->time = c->has_time ? calloc(n, sizeof *c->time) : NULL;
    c->value = arena_alloc(a, n, sizeof *c->value);
    int status = STATUS_OK;
    if (!c->value || (c->has_time && !c->time)) {
        status = error_no_memory(e);
    }
    if (!status) {
        status = read_rows(c, out, e);
    }
    if (!status && c->has_time) {
        status = find_step(c, n, out, e);
    }
    free(c->time);
    out->n = n;
    out->value = c->value;
    return status;
}

static int columns_read(struct arena *a, const struct record_request *request,
                        const struct record_text *t, struct record_content *out, struct error *e) {
    struct table table;
    if (!table_find(t, &table)) {
        return lines_error(e, t->path, 0, "the file has no line of numbers");
    }
    struct columns c = {.text = t, .table = &table, .has_time = table.n_column > 1};
    int status = table_check(t, &table, e);
    if (!status) {
        status = choose_column(request, &c, out, e);
    }
    if (!status) {
        status = read_caption(request, &c, out, e);
    }
    out->noted_dt = table_noted_step(t, &table, &out->noted_line);
    out->noted_line = out->noted_dt > 0 ? out->noted_line : 0;
    return status ? status : read_table(a, &c, out, e);
}

const struct record_format record_columns = {
    .name = "columns",
    .doc = "one column of values with -dt, or times and one or more columns of values",
    .plain = true,
    .channels = true,
    .matches = columns_matches,
    .read = columns_read,
};
