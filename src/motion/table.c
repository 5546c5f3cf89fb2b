// SPDX-License-Identifier: GPL-3.0-or-later
// Files of numbers in rows: the first row, the numbers of rows and columns, and the text above.
#include "motion/table.h"

#include <string.h>

#include "motion/values.h"

static const char table_separators[] = ",;";

static bool is_row(struct piece line) {
    size_t n = 0;
    struct piece field;
    while (lines_field(&line, table_separators, &field)) {
        if (!lines_number_like(field)) {
            return false;
        }
        n++;
    }
    return n > 0;
}

bool table_next(struct lines *rows) {
    while (lines_next(rows)) {
        rows->line = lines_without_comment(rows->line);
        if (rows->line.n > 0) {
            return true;
        }
    }
    return false;
}

static void note_caption(struct table *table, const struct lines *l) {
    struct piece text = l->line;
    if (lines_overflow(text)) {
        table->stars = table->stars_line ? table->stars : text;
        table->stars_line = table->stars_line ? table->stars_line : l->number;
        return;
    }
    while (text.n > 0 && strchr("#%!*/ \t", text.text[0])) {
        text.text++;
        text.n--;
    }
    if (text.n > 0) {
        table->caption = text;
        table->caption_line = l->number;
        table->framed |= table->stars_line > 0;
        table->stars_line = 0;
    }
}

// Goes to the line before the first row.
static bool find_first_row(const struct record_text *t, struct table *out) {
    struct lines l;
    lines_init(&l, t);
    out->rows = l;
    while (lines_next(&l)) {
        if (is_row(lines_without_comment(l.line))) {
            out->first_line = l.number;
            return true;
        }
        note_caption(out, &l);
        out->rows = l;
    }
    return false;
}

// True if the comma of a field must be a decimal comma. The comma of 1,234 may separate thousands.
static bool is_decimal_comma(struct piece field, const char *comma) {
    const bool has_sign = field.text[0] == '+' || field.text[0] == '-';
    const char *whole = field.text + has_sign;
    const size_t n_behind = (size_t)(field.text + field.n - comma) - 1;
    return n_behind != 3 || comma == whole || comma - whole > 3 || *whole == '0';
}

static bool has_decimal_commas(struct lines rows) {
    bool is_certain = false;
    while (table_next(&rows)) {
        struct piece rest = rows.line, field;
        if (!memchr(rest.text, ';', rest.n) || memchr(rest.text, '.', rest.n)) {
            return false;
        }
        while (lines_field(&rest, ";", &field)) {
            const char *comma = memchr(field.text, ',', field.n);
            if (comma && memchr(comma + 1, ',', (size_t)(field.text + field.n - comma) - 1)) {
                return false;
            }
            is_certain |= comma && is_decimal_comma(field, comma);
        }
    }
    return is_certain;
}

bool table_find(const struct record_text *t, struct table *out) {
    *out = (struct table){.caption = {.text = t->text}};
    if (!find_first_row(t, out)) {
        return false;
    }
    out->comma = has_decimal_commas(out->rows);
    out->separators = out->comma ? ";" : table_separators;
    struct lines l = out->rows;
    while (table_next(&l)) {
        size_t n = lines_count(l.line, out->separators);
        if (out->n_row == 0) {
            out->n_column = n;
        } else {
            out->n_ragged += out->n_last != out->n_column;
        }
        out->n_last = n;
        out->n_row++;
    }
    return true;
}

int table_number(const struct table *table, const struct number_field *f, double *value,
                 struct error *e) {
    enum { LONGEST = 60 };
    char copy[LONGEST];
    struct number_field with_point = *f;
    char *comma = NULL;
    if (table->comma && f->field.n < sizeof copy) {
        memcpy(copy, f->field.text, f->field.n);
        comma = memchr(copy, ',', f->field.n);
    }
    if (comma) {
        *comma = '.';
        with_point.field.text = copy;
    }
    return lines_read_number(&with_point, value, e);
}

// The unit of a time step in s, in any case; 0: not a unit of time.
static double step_unit(struct piece word) {
    static const struct {
        const char *name;
        double si;
    } units[] = {{"S", 1}, {"SEC", 1}, {"SECONDS", 1}, {"MS", 1e-3}, {"MSEC", 1e-3}};
    for (size_t i = 0; i < sizeof units / sizeof units[0]; i++) {
        if (word.n == strlen(units[i].name) && lines_contain(word, units[i].name)) {
            return units[i].si;
        }
    }
    return 0;
}

// The step after its name: `= 0.02`, `: 0.02 s`, `0.02s`, ` (ms) = 20`. 0: there is none.
static double read_step(struct piece rest) {
    static const char marks[] = "=:,()[]";
    double step = 0, unit = 1;
    struct piece field;
    while (step == 0 && lines_field(&rest, marks, &field)) {
        struct piece number = field;
        while (number.n > 0 && (number.text[number.n - 1] | 0x20) >= 'a') {
            number.n--;
        }
        const struct piece word = {field.text + number.n, field.n - number.n};
        unit = word.n > 0 ? step_unit(word) : unit;
        if (unit == 0 || (number.n > 0 && lines_number(number, &step) != NUMBER_OK)) {
            return 0;
        }
    }
    if (lines_field(&rest, marks, &field) && step_unit(field) > 0) {
        unit = step_unit(field);
    }
    return step > 0 ? step * unit : 0;
}

double table_noted_step(const struct record_text *t, const struct table *table, int *line) {
    static const char *const names[] = {"DT", "TIME STEP", "TIMESTEP", "SAMPLING INTERVAL"};
    double step = 0;
    struct lines l;
    lines_init(&l, t);
    while (step == 0 && lines_next(&l) && l.number < table->first_line) {
        for (size_t i = 0; step == 0 && i < sizeof names / sizeof names[0]; i++) {
            step = read_step(lines_behind(l.line, names[i]));
        }
        *line = l.number;
    }
    return step;
}

// True if commas separate some values of the line and something else separates others.
static bool has_odd_commas(struct piece line) {
    size_t n_comma = 0;
    size_t n_other = 0;
    struct piece field;
    while (lines_field(&line, table_separators, &field) && line.n > 0) {
        const char *gap = field.text + field.n;
        size_t n = (size_t)(line.text - gap);
        if (memchr(gap, ',', n)) {
            n_comma++;
        } else {
            n_other++;
        }
    }
    return n_comma > 0 && n_other > 0;
}

// True if the caption is a row except for one of its fields, or for the text after a #.
static bool caption_is_row(const struct table *table) {
    struct piece rest = table->caption;
    const char *mark = memchr(rest.text, '#', rest.n);
    struct piece first;
    return (mark && is_row((struct piece){rest.text, (size_t)(mark - rest.text)})) ||
           (lines_field(&rest, table->separators, &first) && lines_number_like(first) &&
            lines_count(table->caption, table->separators) == table->n_column);
}

int table_read(const struct record_text *t, struct table *table, struct error *e) {
    if (!table_find(t, table)) {
        return lines_error(e, t->path, 0, "the file has no line of numbers");
    }
    if (caption_is_row(table)) {
        struct excerpt shown = lines_excerpt(table->caption);
        return lines_error(e, t->path, table->caption_line,
                           "'%s' is neither a row of numbers nor a caption", shown.text);
    }
    if (table->stars_line > 0 && !table->framed) {
        return lines_overflow_error(e, t, table->stars_line, "", table->stars,
                                    " before the first number");
    }
    const int status = values_check_comments(t, table->rows, e);
    if (status != STATUS_OK) {
        return status;
    }
    struct lines l = table->rows;
    while (table_next(&l)) {
        if (!table->comma && has_odd_commas(l.line)) {
            struct excerpt shown = lines_excerpt(l.line);
            return lines_error(e, t->path, l.number,
                               "'%s' has commas beside other separators; numbers need a decimal "
                               "point",
                               shown.text);
        }
    }
    return STATUS_OK;
}
