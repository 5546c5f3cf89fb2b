// SPDX-License-Identifier: GPL-3.0-or-later
// Texts with parameters: $name and ${expression} inside a word stand for the text of the parameter,
// or the number with up to 15 digits; $$ stands for $. A $ before anything else stands for itself.
#include <stdio.h>
#include <string.h>

#include "core/arena.h"
#include "core/text.h"
#include "deck/reader.h"

struct buffer {
    char text[TEXT_MAX + 1];
    size_t used;
};

static bool append(struct deck *d, const struct word *w, struct buffer *b, const char *text,
                   size_t n) {
    if (n > TEXT_MAX - b->used) {
        deck_error(d, w, "the text is longer than %d bytes with its parameters replaced", TEXT_MAX);
        return false;
    }
    memcpy(b->text + b->used, text, n);
    b->used += n;
    return true;
}

static bool append_number(struct deck *d, const struct word *w, struct buffer *b, double value) {
    char number[32];
    int n = snprintf(number, sizeof number, "%.15g", value);
    return append(d, w, b, number, (size_t)n);
}

static bool append_parameter(struct deck *d, const struct word *w, struct buffer *b,
                             const char *from, const char *to) {
    const struct parameter *p = parameter_get(d, w, from, to);
    if (!p || p->kind == PARAMETER_WRONG) {
        return false;
    }
    if (p->kind == PARAMETER_TEXT) {
        return append(d, w, b, p->text, strlen(p->text));
    }
    return append_number(d, w, b, p->number.value);
}

// What the expression in braces, from `from` to `to`, gives.
static bool append_expression(struct deck *d, const struct word *w, struct buffer *b,
                              const char *from, const char *to) {
    const char *name = from + strspn(from, " \t$");
    const char *end = parameter_name_end(name);
    const char *rest = end + strspn(end, " \t");
    const struct parameter *p = parameter_find(d, name, (size_t)(end - name));
    if (rest == to && p && p->kind == PARAMETER_TEXT) {
        return append_parameter(d, w, b, name, end);
    }
    struct quantity q;
    return expression_evaluate(d, w, from, to, &q) && append_number(d, w, b, q.value);
}

// Appends what the $ at *at stands for; *at moves past it.
static bool append_dollar(struct deck *d, const struct word *w, struct buffer *b, const char **at) {
    const char *from = *at + 1;
    if (*from == '{') {
        const char *close = strchr(from, '}');
        if (!close) {
            struct word part = report_part(d, w, *at, from + 1);
            deck_error(d, &part, "the '}' to this '${' is missing");
            return false;
        }
        *at = close + 1;
        return append_expression(d, w, b, from + 1, close);
    }
    const char *to = parameter_name_end(from);
    if (to > from) {
        *at = to;
        return append_parameter(d, w, b, from, to);
    }
    *at = from + (*from == '$');
    return append(d, w, b, "$", 1);
}

static const char *keep(struct deck *d, const struct word *w, const struct buffer *b) {
    d->reader->n_replaced += b->used;
    if (d->reader->n_replaced > TEXT_TOTAL_MAX) {
        deck_error(d, w,
                   "all texts together are longer than %d bytes with their parameters replaced",
                   TEXT_TOTAL_MAX);
        return NULL;
    }
    const char *text = arena_text(d->arena, b->text, b->used);
    if (!text) {
        diagnostics_no_memory(&d->diagnostics);
    }
    return text;
}

const char *deck_text_of_file(struct deck *d, const struct word *w) {
    if (!strchr(w->text, '$')) {
        return w->text;
    }
    struct buffer b;
    b.used = 0;
    for (const char *at = w->text; *at;) {
        size_t plain = strcspn(at, "$");
        bool ok = plain > 0 ? append(d, w, &b, at, plain) : append_dollar(d, w, &b, &at);
        if (!ok) {
            return NULL;
        }
        at += plain;
    }
    return keep(d, w, &b);
}

const char *deck_text(struct deck *d, const struct word *w) {
    const bool before = reader_note_sweeps(d);
    const char *text = deck_text_of_file(d, w);
    reader_noted_sweeps(d, before);
    return text;
}

static int parameter_line(const struct parameter *p, char *text, size_t size) {
    if (p->kind == PARAMETER_WRONG) {
        return 0;
    }
    if (p->kind == PARAMETER_TEXT) {
        return snprintf(text, size, "%s = %s\n", p->name, p->text);
    }
    return snprintf(text, size, "%s = %.15g\n", p->name, p->number.value);
}

const char *deck_parameters(struct deck *d) {
    size_t size = 1;
    for (const struct parameter *p = d->reader->first; p; p = p->next) {
        size += (size_t)parameter_line(p, NULL, 0);
    }
    char *text = deck_array(d, size, 1);
    if (!text) {
        return "";
    }
    size_t used = 0;
    for (const struct parameter *p = d->reader->first; p; p = p->next) {
        used += (size_t)parameter_line(p, text + used, size - used);
    }
    return text;
}
