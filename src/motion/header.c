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

bool header_end(const struct record_reader *r, const char *mark, int n_line, const char *name,
                struct lines *l) {
    const size_t n = strlen(mark);
    lines_init(l, r->text);
    while (l->number < n_line && lines_next(l)) {
        if (l->line.n >= n && memcmp(l->line.text, mark, n) == 0) {
            return true;
        }
    }
    return record_fail(
        r, 0, "the file has no '%s' in the first %d lines; it ends the header of a %s file", mark,
        n_line, name);
}

bool header_find(const struct header *h, const char *key, struct header_entry *out) {
    struct lines l;
    lines_init(&l, h->reading->text);
    while (l.number < h->n_line && lines_next(&l)) {
        if (is_entry(l.line, key, &out->value)) {
            out->key = key;
            out->line = l.number;
            return true;
        }
    }
    return false;
}

bool header_text(const struct header *h, const char *key, struct header_entry *out) {
    if (!header_find(h, key, out)) {
        return record_fail(h->reading, 0, "the header has no '%s'", key);
    }
    return out->value.n > 0 || record_fail(h->reading, out->line, "%s is empty", key);
}

bool header_read_number(const struct record_reader *r, const struct header_entry *from,
                        struct piece value, double *number) {
    return lines_number(value, number) == NUMBER_OK ||
           record_fail(r, from->line, "%s '%s' is not a number", from->key,
                       lines_excerpt(value).text);
}

bool header_read_positive(const struct record_reader *r, const struct header_entry *from,
                          struct piece value, double *number) {
    return header_read_number(r, from, value, number) &&
           (*number > 0 || record_fail(r, from->line, "%s is %s; it must be > 0", from->key,
                                       lines_excerpt(value).text));
}

bool header_positive(const struct header *h, const char *key, struct header_entry *out,
                     double *number) {
    return header_text(h, key, out) && header_read_positive(h->reading, out, out->value, number);
}

bool header_read_count(const struct record_reader *r, const struct header_entry *from, double *n) {
    if (!header_read_number(r, from, from->value, n)) {
        return false;
    }
    return (*n == floor(*n) && *n >= 2 && *n <= 1e9) ||
           record_fail(r, from->line, "%s is %s; it must be a whole number from 2 to 1e9",
                       from->key, lines_excerpt(from->value).text);
}

bool header_count(const struct header *h, const char *key, struct header_entry *out, double *n) {
    return header_text(h, key, out) && header_read_count(h->reading, out, n);
}

bool header_duration(const struct header *h, const char *key, double rate, struct header_entry *out,
                     double *n) {
    double duration;
    if (!header_positive(h, key, out, &duration)) {
        return false;
    }
    *n = rate * duration;
    return (*n == floor(*n) && *n >= 2) ||
           record_fail(h->reading, out->line,
                       "%g s at %g Hz are %g values; they must be a whole number of at least 2",
                       duration, rate, *n);
}

// One unit in the last digit of a decimal number.
static double last_digit(struct piece number) {
    const char *point = memchr(number.text, '.', number.n);
    return point ? pow(10, -(double)(number.text + number.n - point - 1)) : 1;
}

bool header_read_peak(const struct record_reader *r, const struct header_entry *from,
                      struct piece value, double unit) {
    struct record_content *out = r->out;
    const double size = unit > 0 && out->unit > 0 ? unit / out->unit : 1;
    double peak;
    if (value.n == 0) {
        return true;
    }
    if (!header_read_number(r, from, value, &peak)) {
        return false;
    }
    if (out->stated_line == 0 || size * fabs(peak) > out->stated_peak) {
        out->stated_peak = size * fabs(peak);
        out->stated_rounding = size * last_digit(value);
        out->stated_line = from->line;
    }
    return true;
}

double header_unit(const struct record_reader *r, struct piece text) {
    struct dimension dimension;
    double si;
    const bool is = record_unit(text, r->request->gravity, &dimension, &si) &&
                    dimension_equal(dimension, dimension_acceleration);
    return is ? si : 0;
}

void header_read_unit(const struct record_reader *r, int line, struct piece value) {
    const double unit = header_unit(r, value);
    r->out->unit_text = lines_excerpt(value);
    r->out->unit_line = line;
    r->out->unit = unit > 0 ? unit : r->out->unit;
}
