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
    const struct record_reader *reading;
    const struct table *table;
    bool has_time;  // column 0 has times
    size_t column;  // of the values, from 0
    double *time;   // (n_row) [s]; NULL: the file has no times
    double *value;  // (n_row)
};

// Reads the unit of the values from the caption. One unit is that of all columns of values. As many
// units as columns belong to one column each. Brackets without a unit are text.
static bool read_caption(const struct columns *c) {
    const struct record_reader *r = c->reading;
    const struct table *table = c->table;
    struct record_content *out = r->out;
    struct piece rest = table->caption;
    struct piece unit;
    size_t n = 0;
    while (lines_bracket(&rest, &unit)) {
        struct dimension dimension;
        double si;
        if (!record_unit(unit, r->request->gravity, &dimension, &si)) {
            continue;
        }
        const bool is_time = dimension_equal(dimension, dimension_time);
        if (is_time && si != 1) {
            return record_fail(r, table->caption_line, "times are in '%s'; they must be in s",
                               lines_excerpt(unit).text);
        }
        if (!is_time && (n == 0 || n + c->has_time == c->column)) {
            out->unit = dimension_equal(dimension, dimension_acceleration) ? si : 0;
            out->unit_text = lines_excerpt(unit);
            out->unit_line = table->caption_line;
        }
        n += !is_time;
    }
    out->unit_line = n == 1 || n == table->n_column - c->has_time ? out->unit_line : 0;
    return true;
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

static bool check_step(const struct columns *c, size_t i, const struct lines *l) {
    const double *time = c->time;
    if (time[i] <= time[i - 1]) {
        bool comma = memchr(l->line.text, ',', l->line.n);
        return record_fail(c->reading, l->number, "time %g after %g; times must increase%s",
                           time[i], time[i - 1], comma ? " (a comma ends a number)" : "");
    }
    double first = time[1] - time[0];
    double step = time[i] - time[i - 1];
    return fabs(step - first) <= 2 * TIME_ERROR_MAX * first ||
           record_fail(c->reading, l->number,
                       "step of %.6g s to time %g; the first step is %.6g s and steps must be even",
                       step, time[i], first);
}

// Reads row `i`, the current line of `l`.
static bool read_row(const struct columns *c, const struct lines *l, size_t i) {
    const size_t n = lines_count(l->line, c->table->separators);
    if (n != c->table->n_column) {
        return record_fail(c->reading, l->number, "row of %zu values; the first (line %d) has %zu",
                           n, c->table->first_line, c->table->n_column);
    }
    struct piece rest = l->line;
    struct number_field f = {c->reading->text, l->number, "time", i + 1, {0}};
    lines_field(&rest, c->table->separators, &f.field);
    if (c->has_time && (table_number(c->table, &f, &c->time[i], c->reading->e) != STATUS_OK ||
                        (i > 0 && !check_step(c, i, l)))) {
        return false;
    }
    for (size_t k = 0; k < c->column; k++) {
        lines_field(&rest, c->table->separators, &f.field);
    }
    f.what = "value";
    if (table_number(c->table, &f, &c->value[i], c->reading->e) != STATUS_OK) {
        return false;
    }
    values_note_peak(c->reading->out, c->value, i, l->number);
    return true;
}

static bool read_rows(const struct columns *c) {
    struct lines l = c->table->rows;
    for (size_t i = 0; table_next(&l); i++) {
        if (!read_row(c, &l, i)) {
            return false;
        }
    }
    return true;
}

// The number of the line with row `i`.
static int row_line(const struct table *table, size_t i) {
    struct lines l = table->rows;
    for (size_t k = 0; k <= i && table_next(&l); k++) {
    }
    return l.number;
}

// Finds the time step and the largest distance of a time from the even grid.
static bool find_step(const struct columns *c, size_t n) {
    struct record_content *out = c->reading->out;
    double start = c->time[0];
    out->time_offset = start;
    if (n < 2) {
        return true;
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
    return (isfinite(out->dt) && out->time_error <= TIME_ERROR_MAX) ||
           record_fail(c->reading, row_line(c->table, worst),
                       "time %g is %.3g steps of %.6g s off the even grid from first to last time; "
                       "steps must be even",
                       c->time[worst], out->time_error, out->dt);
}

// Finds the column that -channel requests.
static bool choose_column(struct columns *c) {
    const struct record_request *request = c->reading->request;
    const size_t n = c->table->n_column - c->has_time;
    const size_t wanted = request->channel == 0 && n == 1 ? 1 : (size_t)request->channel;
    if (wanted == 0) {
        return record_fail(c->reading, c->table->first_line,
                           "%zu columns; %s; -format series reads values that run on from line "
                           "to line",
                           c->table->n_column,
                           request->plain ? "one or two (time and value) are read"
                                          : "-channel chooses a column after the times");
    }
    if (wanted > n) {
        c->reading->out->wrong = RECORD_CHANNEL;
        return record_fail(c->reading, c->table->first_line,
                           "the file has no channel %zu; it has %zu, one per column%s", wanted, n,
                           c->has_time ? " after the times" : "");
    }
    c->column = wanted - !c->has_time;
    return true;
}

static bool columns_read(const struct record_reader *r) {
    struct table table;
    if (table_read(r->text, &table, r->e) != STATUS_OK) {
        return false;
    }
    struct columns c = {.reading = r, .table = &table, .has_time = table.n_column > 1};
    if (!choose_column(&c) || !read_caption(&c)) {
        return false;
    }
    r->out->noted_dt = table_noted_step(r->text, &table, &r->out->noted_line);
    r->out->noted_line = r->out->noted_dt > 0 ? r->out->noted_line : 0;
    const size_t n = table.n_row;
    c.time = c.has_time ? calloc(n, sizeof *c.time) : NULL;
    c.value = arena_alloc(r->arena, n, sizeof *c.value);
    const bool done = !c.value || (c.has_time && !c.time)
                          ? record_fail_memory(r)
                          : read_rows(&c) && (!c.has_time || find_step(&c, n));
    free(c.time);
    r->out->n = n;
    r->out->value = c.value;
    return done;
}

const struct record_format record_columns = {
    .name = "columns",
    .doc = "one column of values with -dt, or times and one or more columns of values",
    .plain = true,
    .channels = true,
    .matches = columns_matches,
    .read = columns_read,
};
