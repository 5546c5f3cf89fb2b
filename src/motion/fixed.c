// SPDX-License-Identifier: GPL-3.0-or-later
// Values in fields of a fixed width.
#include "motion/fixed.h"

#include <assert.h>
#include <string.h>

#include "core/arena.h"
#include "motion/values.h"

// Takes a whole number of at most three digits off `rest`; 0: `rest` does not begin with one.
static size_t take_count(struct piece *rest) {
    size_t count = 0;
    for (int i = 0; i < 3 && rest->n > 0 && rest->text[0] >= '0' && rest->text[0] <= '9'; i++) {
        count = 10 * count + (size_t)(rest->text[0] - '0');
        rest->text++;
        rest->n--;
    }
    return count;
}

// Reads `8F9.6`, `5E15.6`, `8F9`. Small letters and text after the format are allowed, `1F15.6E`.
// False: the text is not such a format.
static bool read_format(struct piece text, struct fixed_format *out) {
    *out = (struct fixed_format){.n = take_count(&text)};
    if (text.n < 2 || !strchr("FfEe", text.text[0])) {
        return false;
    }
    text.text++;
    text.n--;
    out->width = take_count(&text);
    if (lines_trim(text).n == 0) {
        return out->n > 0 && out->width > 0;
    }
    if (text.n < 2 || text.text[0] != '.') {
        return false;
    }
    text.text++;
    text.n--;
    out->decimals = take_count(&text);
    return out->n > 0 && out->width > 0 && out->decimals > 0;
}

bool fixed_format_find(struct piece line, struct fixed_format *out) {
    const struct piece whole = line;
    bool found = false;
    struct piece inside;
    while (lines_bracket(&line, &inside)) {
        struct fixed_format f;
        if (read_format(inside, &f)) {
            *out = f;
            found = true;
        }
    }
    struct piece rest = lines_behind(whole, "FORMAT");
    while (!found && lines_field(&rest, ":=", &inside)) {
        found = read_format(inside, out);
    }
    return found;
}

struct piece fixed_field(struct piece line, const struct fixed_format *format, size_t i) {
    assert(format->n > 0 && format->width > 0);
    const size_t from = i * format->width;
    const size_t left = from < line.n ? line.n - from : 0;
    struct piece rest = {line.text + (left ? from : line.n),
                         left < format->width ? left : format->width};
    const struct piece whole = rest;
    struct piece field;
    if (!lines_field(&rest, "", &field)) {
        return (struct piece){whole.text, 0};
    }
    return rest.n == 0 ? field : whole;
}

struct header_entry fixed_entry(const char *key, struct lines first,
                                const struct fixed_format *format, size_t i) {
    const struct lines l = lines_at(first, 1 + (int)((i - 1) / format->n));
    return (struct header_entry){key, fixed_field(l.whole, format, (i - 1) % format->n), l.number};
}

static bool check_rest(const struct record_reader *r, const struct lines *l, size_t used) {
    struct piece rest = {l->whole.text + used, used < l->whole.n ? l->whole.n - used : 0};
    struct piece field;
    return !lines_field(&rest, "", &field) ||
           record_fail(r, l->number, "'%s' follows the last value of the line",
                       lines_excerpt(field).text);
}

// Reads field `field` of the line, the time of value `i` or the value itself.
static bool read_field(const struct record_reader *r, const struct lines *l,
                       const struct fixed_format *format, const char *what, size_t i, size_t field,
                       double *value) {
    const struct number_field f = {r->text, l->number, what, i + 1,
                                   fixed_field(l->whole, format, field)};
    return record_number(r, &f, value);
}

bool fixed_read(const struct record_reader *r, struct lines *l, const struct fixed_format *format) {
    assert(format->n > 0 && format->width > 0);
    const size_t n = (size_t)r->out->npts;
    const int title = r->out->count_line;
    const size_t each = format->timed ? 2 : 1;  // fields for each value
    if (n > (size_t)(l->end - l->at)) {
        return record_fail(r, title, "the line says %zu values; the file ends before", n);
    }
    double *value = arena_alloc(r->arena, n, sizeof *value);
    if (!value) {
        return record_fail_memory(r);
    }
    for (size_t i = 0; i < n; i++) {
        const size_t column = i % format->n;
        double time;
        if (column == 0 && !lines_next(l)) {
            return record_fail(r, l->number, "the file ends after %zu values; line %d says %zu", i,
                               title, n);
        }
        if (format->timed && (!read_field(r, l, format, "time", i, 2 * column, &time) ||
                              !values_check_time(r, l->number, i, time))) {
            return false;
        }
        if (!read_field(r, l, format, "value", i, (column + 1) * each - 1, &value[i])) {
            return false;
        }
        if ((column + 1 == format->n || i + 1 == n) &&
            !check_rest(r, l, (column + 1) * each * format->width)) {
            return false;
        }
        values_note_peak(r->out, value, i, l->number);
    }
    r->out->value = value;
    r->out->n = n;
    return true;
}

// True if the line has only numbers, separated by spaces or by the width of the fields.
static bool is_row(const struct lines *l, const struct fixed_format *format) {
    bool by_blanks = true, by_width = true;
    double value;
    struct piece rest = l->line;
    for (struct piece field; lines_field(&rest, "", &field);) {
        by_blanks &= lines_number(field, &value) == NUMBER_OK;
    }
    const size_t used = (size_t)(l->line.text + l->line.n - l->whole.text);
    for (size_t i = 0; i * format->width < used; i++) {
        by_width &= lines_number(fixed_field(l->whole, format, i), &value) == NUMBER_OK;
    }
    return by_blanks || by_width;
}

bool fixed_check_end(const struct record_reader *r, struct lines l,
                     const struct fixed_format *format) {
    bool found;
    while ((found = lines_next(&l)) && l.line.n == 0) {
    }
    return !found || !is_row(&l, format) ||
           record_fail(r, l.number, "more than the %zu values that the header states", r->out->n);
}
