// SPDX-License-Identifier: GPL-3.0-or-later
// Entries of a header, and what they say about the record.
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

bool header_skip(const struct record_reader *r, struct lines *l, int n) {
    for (int i = 1; i < n; i++) {
        if (!lines_next(l)) {
            return record_fail(r, l->number, "the file ends after %d of the %d lines of a header",
                               i, n);
        }
    }
    return true;
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

bool header_number(const struct record_reader *r, const struct header_entry *from, double *number) {
    if (from->value.n == 0) {
        return record_fail(r, from->line, "%s is empty", from->key);
    }
    return lines_number(from->value, number) == NUMBER_OK ||
           record_fail(r, from->line, "%s '%s' is not a number", from->key,
                       lines_excerpt(from->value).text);
}

bool header_positive(const struct record_reader *r, const struct header_entry *from,
                     double *number) {
    return header_number(r, from, number) &&
           (*number > 0 || record_fail(r, from->line, "%s is %s; it must be > 0", from->key,
                                       lines_excerpt(from->value).text));
}

// One unit in the last digit of a decimal number.
static double last_digit(struct piece number) {
    const char *point = memchr(number.text, '.', number.n);
    return point ? pow(10, -(double)(number.text + number.n - point - 1)) : 1;
}

bool header_peak(const struct record_reader *r, const struct header_entry *from, double unit) {
    struct record_content *out = r->out;
    const double size = unit > 0 && out->unit > 0 ? unit / out->unit : 1;
    double peak;
    if (from->value.n == 0) {
        return true;
    }
    if (!header_number(r, from, &peak)) {
        return false;
    }
    if (out->stated_line == 0 || size * fabs(peak) > out->stated_peak) {
        out->stated_peak = size * fabs(peak);
        out->stated_rounding = size * last_digit(from->value);
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

static bool take_count(const struct record_reader *r, const struct header_entry *from) {
    const double n = r->out->npts;
    return (n == floor(n) && n >= 2 && n <= 1e9) ||
           record_fail(r, from->line, "%s is %s; it must be a whole number from 2 to 1e9",
                       from->key, lines_excerpt(from->value).text);
}

static bool take_duration(const struct record_reader *r, const struct header_entry *from) {
    struct record_content *out = r->out;
    double duration = 0;
    if (!header_positive(r, from, &duration)) {
        return false;
    }
    out->npts = out->rate * duration;
    return (out->npts == floor(out->npts) && out->npts >= 2) ||
           record_fail(r, from->line,
                       "%g s at %g Hz are %g values; they must be a whole number of at least 2",
                       duration, out->rate, out->npts);
}

bool header_take(const struct record_reader *r, enum header_kind kind,
                 const struct header_entry *from) {
    struct record_content *out = r->out;
    const bool is_time = kind == HEADER_STEP || kind == HEADER_RATE;
    const bool is_count = kind == HEADER_COUNT || kind == HEADER_DURATION;
    bool good = true;
    out->dt_line = is_time ? from->line : out->dt_line;
    out->count_line = is_count ? from->line : out->count_line;
    switch (kind) {
        case HEADER_COUNT:
            return header_number(r, from, &out->npts) && take_count(r, from);
        case HEADER_STEP:
            return header_positive(r, from, &out->dt);
        case HEADER_RATE:
            good = header_positive(r, from, &out->rate);
            out->dt = 1 / out->rate;
            return good;
        case HEADER_DURATION:
            return take_duration(r, from);
        case HEADER_PEAK:
            return header_peak(r, from, 0);
        case HEADER_UNIT:
            out->unit = header_unit(r, from->value);
            out->unit_text = lines_excerpt(from->value);
            out->unit_line = from->line;
    }
    return good;
}

// The part of the value that a row means; false: the channel has none.
static bool cut_value(const struct header_row *row, int channel, struct piece *value) {
    struct piece rest = *value;
    bool found = !row->channels || (lines_field(&rest, "/", value) && value->n == 0);
    for (int i = 0; row->channels && found && i <= channel; i++) {
        found = lines_field(&rest, "/", value) && value->n > 0;
    }
    if (row->until) {
        lines_field(&rest, row->until, value);
    }
    return found;
}

bool header_rows(const struct header *h, const struct header_row *row, int channel) {
    for (; row->key; row++) {
        struct header_entry entry = {.key = row->key};
        if (row->optional && !header_find(h, row->key, &entry)) {
            continue;
        }
        if (!row->optional && !header_text(h, row->key, &entry)) {
            return false;
        }
        const struct piece whole = entry.value;
        if (!cut_value(row, channel, &entry.value)) {
            return record_fail(h->reading, entry.line, "%s '%s' has no value of channel %d",
                               row->key, lines_excerpt(whole).text, channel + 1);
        }
        if (!header_take(h->reading, row->kind, &entry)) {
            return false;
        }
    }
    return true;
}
