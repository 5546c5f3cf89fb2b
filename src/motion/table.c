// SPDX-License-Identifier: GPL-3.0-or-later
// Files of numbers in rows: where the numbers begin, how many there are, and what stands above.
#include "motion/table.h"

#include <string.h>

const char table_separators[] = ",;";

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
    while (text.n > 0 && strchr("#%!*/ \t", text.text[0])) {
        text.text++;
        text.n--;
    }
    if (text.n > 0) {
        table->caption = text;
        table->caption_line = l->number;
    }
}

// Steps to the line before the first row.
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

bool table_find(const struct record_text *t, struct table *out) {
    *out = (struct table){.caption = {.text = t->text}};
    if (!find_first_row(t, out)) {
        return false;
    }
    struct lines l = out->rows;
    while (table_next(&l)) {
        size_t n = lines_count(l.line, table_separators);
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

// True if commas separate some values of the line and something else separates others.
static bool has_decimal_commas(struct piece line) {
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

int table_check(const struct record_text *t, const struct table *table, struct error *e) {
    struct piece rest = table->caption;
    struct piece first;
    if (lines_field(&rest, table_separators, &first) && lines_number_like(first) &&
        lines_count(table->caption, table_separators) == table->n_column) {
        struct excerpt shown = lines_excerpt(table->caption);
        return lines_error(e, t->path, table->caption_line,
                           "'%s' is neither a row of numbers nor a caption", shown.text);
    }
    struct lines l = table->rows;
    while (table_next(&l)) {
        if (has_decimal_commas(l.line)) {
            struct excerpt shown = lines_excerpt(l.line);
            return lines_error(e, t->path, l.number,
                               "'%s' has commas beside other separators; numbers need a decimal "
                               "point",
                               shown.text);
        }
    }
    return STATUS_OK;
}
