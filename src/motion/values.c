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

int values_check_time(const struct record_text *t, int line, size_t index, double time,
                      struct record_content *out, struct error *e) {
    out->time_offset = index == 0 ? time : out->time_offset;
    const double wanted = out->time_offset + (double)index * out->dt;
    return fabs(time - wanted) <= TIME_ERROR_MAX * out->dt
               ? STATUS_OK
               : lines_error(e, t->path, line, "time %.9g; the header's step of %g s makes it %.9g",
                             time, out->dt, wanted);
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
static int read_field(const struct record_text *t, int line, struct piece field, size_t n,
                      struct record_content *out, struct error *e) {
    struct compound c = compound_of(field);
    const size_t end = c.n < n - out->n ? out->n + c.n : n;
    int status = STATUS_OK;
    while (status == STATUS_OK && out->n < end) {
        const struct number_field f = {t, line, "value", out->n + 1, compound_next(&c)};
        status = lines_read_number(&f, &out->value[out->n], e);
        if (status == STATUS_OK) {
            values_note_peak(out, out->value, out->n, line);
            out->n++;
        }
    }
    return status;
}

int values_read(struct arena *a, const struct record_text *t, struct lines from,
                const char *separators, size_t n, struct record_content *out, struct error *e) {
    if (n > VALUES_MAX && n > t->size) {
        return lines_error(e, t->path, 0, "%zu values, most of them repeated; at most %d are read",
                           n, VALUES_MAX);
    }
    out->value = arena_alloc(a, n, sizeof *out->value);
    if (!out->value) {
        return error_no_memory(e);
    }
    int status = STATUS_OK;
    out->n = 0;
    while (status == STATUS_OK && out->n < n && lines_next(&from)) {
        struct piece rest = lines_without_comment(from.line);
        struct piece field;
        while (status == STATUS_OK && out->n < n && lines_field(&rest, separators, &field)) {
            status = read_field(t, from.number, field, n, out, e);
        }
    }
    return status;
}

// If the file has fewer values than stated, its last value may be incomplete and is not read.
int values_read_stated(struct arena *a, const struct record_text *t, struct lines from,
                       double stated, int stated_line, struct record_content *out,
                       struct error *e) {
    int last_line;
    const size_t n = values_count(from, "", &last_line);
    const bool is_short = (double)n < stated;
    int status = values_check_comments(t, from, e);
    if (status == STATUS_OK) {
        status = values_read(a, t, from, "", is_short && n > 0 ? n - 1 : n, out, e);
    }
    if (status != STATUS_OK || (double)n == stated) {
        return status;
    }
    if (!is_short) {
        return lines_error(e, t->path, stated_line,
                           "the header says %.0f values; the file holds %zu", stated, n);
    }
    return lines_error(e, t->path, last_line ? last_line : from.number,
                       "the file ends after %zu values; its header (line %d) says %.0f", n,
                       stated_line, stated);
}
