// SPDX-License-Identifier: GPL-3.0-or-later
// Headers with one entry in each line: `KEY: value`, `KEY   : value` or `KEY   value`.
#include "motion/header.h"

#include <math.h>
#include <string.h>

#include "motion/record_format.h"

static struct piece skip_blanks(struct piece s) {
    while (s.n > 0 && (s.text[0] == ' ' || s.text[0] == '\t')) {
        s.text++;
        s.n--;
    }
    return s;
}

// True if the line is an entry with this key, and not with a longer key. Sets its value.
static bool is_entry(struct piece line, const char *key, struct piece *value) {
    const size_t n = strlen(key);
    if (line.n < n || memcmp(line.text, key, n) != 0) {
        return false;
    }
    const struct piece rest = {line.text + n, line.n - n};
    *value = skip_blanks(rest);
    if (value->n > 0 && value->text[0] == ':') {
        *value = skip_blanks((struct piece){value->text + 1, value->n - 1});
        return true;
    }
    return rest.n == 0 || value->n < rest.n;
}

bool header_find(const struct header *h, const char *key, struct header_entry *out) {
    struct lines l;
    lines_init(&l, h->text);
    while (l.number < h->n_line && lines_next(&l)) {
        if (is_entry(l.line, key, &out->value)) {
            out->key = key;
            out->line = l.number;
            return true;
        }
    }
    return false;
}

int header_text(const struct header *h, const char *key, struct header_entry *out,
                struct error *e) {
    if (!header_find(h, key, out)) {
        return lines_error(e, h->text->path, 0, "the header has no '%s'", key);
    }
    return out->value.n > 0 ? STATUS_OK
                            : lines_error(e, h->text->path, out->line, "%s is empty", key);
}

int header_read_number(const struct header *h, const struct header_entry *from, struct piece value,
                       double *number, struct error *e) {
    if (lines_number(value, number) == NUMBER_OK) {
        return STATUS_OK;
    }
    return lines_error(e, h->text->path, from->line, "%s '%s' is not a number", from->key,
                       lines_excerpt(value).text);
}

int header_read_positive(const struct header *h, const struct header_entry *from,
                         struct piece value, double *number, struct error *e) {
    const int status = header_read_number(h, from, value, number, e);
    return status != STATUS_OK || *number > 0
               ? status
               : lines_error(e, h->text->path, from->line, "%s is %s; it must be > 0", from->key,
                             lines_excerpt(value).text);
}

int header_positive(const struct header *h, const char *key, struct header_entry *out,
                    double *number, struct error *e) {
    const int status = header_text(h, key, out, e);
    return status == STATUS_OK ? header_read_positive(h, out, out->value, number, e) : status;
}

int header_read_count(const struct header *h, const struct header_entry *from, double *n,
                      struct error *e) {
    const int status = header_read_number(h, from, from->value, n, e);
    if (status == STATUS_OK && (*n != floor(*n) || *n < 2 || *n > 1e9)) {
        return lines_error(e, h->text->path, from->line,
                           "%s is %s; it must be a whole number from 2 to 1e9", from->key,
                           lines_excerpt(from->value).text);
    }
    return status;
}

int header_count(const struct header *h, const char *key, struct header_entry *out, double *n,
                 struct error *e) {
    const int status = header_text(h, key, out, e);
    return status == STATUS_OK ? header_read_count(h, out, n, e) : status;
}

int header_duration(const struct header *h, const char *key, double rate, struct header_entry *out,
                    double *n, struct error *e) {
    double duration;
    const int status = header_positive(h, key, out, &duration, e);
    if (status != STATUS_OK) {
        return status;
    }
    *n = rate * duration;
    return *n == floor(*n) && *n >= 2
               ? STATUS_OK
               : lines_error(e, h->text->path, out->line,
                             "%g s at %g Hz are %g values; they must be a whole number of at "
                             "least 2",
                             duration, rate, *n);
}

// One unit in the last digit of a decimal number.
static double last_digit(struct piece number) {
    const char *point = memchr(number.text, '.', number.n);
    return point ? pow(10, -(double)(number.text + number.n - point - 1)) : 1;
}

int header_read_peak(const struct header *h, const struct header_entry *from, struct piece value,
                     struct record_content *out, struct error *e) {
    double peak;
    if (value.n == 0) {
        return STATUS_OK;
    }
    const int status = header_read_number(h, from, value, &peak, e);
    if (status == STATUS_OK) {
        out->stated_peak = fabs(peak);
        out->stated_rounding = last_digit(value);
        out->stated_line = from->line;
    }
    return status;
}

int header_read_peak_of_unit(const struct header *h, const struct header_entry *from,
                             struct piece value, double unit, struct record_content *out,
                             struct error *e) {
    const int status = header_read_peak(h, from, value, out, e);
    if (unit > 0 && out->unit > 0) {
        out->stated_peak *= unit / out->unit;
        out->stated_rounding *= unit / out->unit;
    }
    return status;
}

void header_read_unit(const struct record_request *request, const struct header_entry *from,
                      struct piece value, struct record_content *out) {
    struct dimension dimension;
    double si;
    out->unit_text = lines_excerpt(value);
    out->unit_line = from->line;
    if (record_unit(value, request->gravity, &dimension, &si) &&
        dimension_equal(dimension, dimension_acceleration)) {
        out->unit = si;
    }
}
