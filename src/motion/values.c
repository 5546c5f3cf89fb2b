// SPDX-License-Identifier: GPL-3.0-or-later
// Values that continue from line to line up to the end of the file. They are counted before they
// are read, so that the memory depends on the file and not on the number in its header.
#include "motion/values.h"

#include <assert.h>
#include <math.h>

#include "core/arena.h"
#include "motion/lines.h"

// In steps. Times of 256 samples a second with three printed decimals are 0.13 steps off.
static const double TIME_ERROR_MAX = 0.2;

// Largest number of values: a day at 200 samples a second.
enum { VALUES_MAX = 17280000 };

static size_t count_values(struct piece line, const char *separators) {
    size_t n = 0;
    struct piece field;
    while (lines_field(&line, separators, &field)) {
        n += compound_of(field).n;
    }
    return n;
}

int values_check_comments(const struct record_text *t, struct lines from, struct error *e) {
    struct lines comment = {.number = 0};
    bool in_numbers = false;
    while (lines_next(&from)) {
        if (lines_without_comment(from.line).n > 0) {
            if (comment.number > 0) {
                return error_set(e, STATUS_INPUT,
                                 "%s: the comment '%s' is between numbers, where it may hide "
                                 "one; remove the line",
                                 lines_place_field(t, comment.number, comment.line).text,
                                 lines_excerpt(comment.line).text);
            }
            in_numbers = true;
        } else if (in_numbers && from.line.n > 0 && comment.number == 0) {
            comment = from;
        }
    }
    return STATUS_OK;
}

size_t values_count(struct lines from, const char *separators, int *last_line) {
    size_t n = 0;
    *last_line = 0;
    while (lines_next(&from)) {
        const struct piece line = lines_without_comment(from.line);
        if (line.n > 0) {
            n += count_values(line, separators);
            *last_line = from.number;
        }
    }
    return n;
}

bool values_check_time(const struct record_reader *r, int line, size_t index, double time) {
    struct record_content *out = r->out;
    out->time_offset = index == 0 ? time : out->time_offset;
    const double wanted = out->time_offset + (double)index * out->dt;
    return fabs(time - wanted) <= TIME_ERROR_MAX * out->dt ||
           record_fail(r, line, "time %.9g; the header's step of %g s makes it %.9g", time, out->dt,
                       wanted);
}

void values_note_peak(struct record_content *out, const double *value, size_t index, int line) {
    if (index == 0 || fabs(value[index]) > fabs(value[out->peak])) {
        out->peak = index;
        out->peak_line = line;
    }
}

// The mean of the differences between the values and `base`.
static double mean_above(const double *value, size_t n, double base) {
    double sum = 0;
    for (size_t i = 0; i < n; i++) {
        sum += value[i] - base;
    }
    return sum / (double)n;
}

double values_mean(const double *value, size_t n) {
    assert(value && n > 0);
    const double mean = mean_above(value, n, 0);
    return mean + mean_above(value, n, mean);
}

// Reads the values of a field, up to value n of the record.
static bool read_field(const struct record_reader *r, int line, struct piece field, size_t n) {
    struct record_content *out = r->out;
    struct compound c = compound_of(field);
    const size_t end = c.n < n - out->n ? out->n + c.n : n;
    while (out->n < end) {
        const struct number_field f = {r->text, line, "value", out->n + 1, compound_next(&c)};
        if (!record_number(r, &f, &out->value[out->n])) {
            return false;
        }
        values_note_peak(out, out->value, out->n, line);
        out->n++;
    }
    return true;
}

bool values_read(const struct record_reader *r, struct lines from, const char *separators,
                 size_t n) {
    struct record_content *out = r->out;
    if (n > VALUES_MAX && n > r->text->size) {
        return record_fail(r, 0, "%zu values, most of them repeated; at most %d are read", n,
                           VALUES_MAX);
    }
    out->value = arena_alloc(r->arena, n, sizeof *out->value);
    if (!out->value) {
        return record_fail_memory(r);
    }
    out->n = 0;
    while (out->n < n && lines_next(&from)) {
        struct piece rest = lines_without_comment(from.line);
        struct piece field;
        while (out->n < n && lines_field(&rest, separators, &field)) {
            if (!read_field(r, from.number, field, n)) {
                return false;
            }
        }
    }
    return true;
}

// If the file has fewer values than stated, its last value may be incomplete and is not read.
bool values_read_stated(const struct record_reader *r, struct lines from, double stated,
                        int stated_line) {
    int last_line;
    const size_t n = values_count(from, "", &last_line);
    const bool is_short = (double)n < stated;
    if (values_check_comments(r->text, from, r->e) != STATUS_OK ||
        !values_read(r, from, "", is_short && n > 0 ? n - 1 : n)) {
        return false;
    }
    if (is_short) {
        return record_fail(r, last_line ? last_line : from.number,
                           "the file ends after %zu values; its header (line %d) says %.0f", n,
                           stated_line, stated);
    }
    return (double)n == stated ||
           record_fail(r, stated_line, "the header says %.0f values; the file holds %zu", stated,
                       n);
}
