// SPDX-License-Identifier: GPL-3.0-or-later
// Texts with parameters: $name and ${expression} inside a word stand for the text of the parameter,
// or for the number with up to 15 digits; $$ stands for $. A $ before anything else stands for
// itself.
//
// The value of a parameter is a number if its word is not quoted and starts like a number (a digit,
// or a point and a digit, either after a sign), or if the word as a whole is $name or
// ${expression}. Any other value is a text, so a text that starts with a digit must be quoted.
#include <stdio.h>
#include <string.h>

#include "core/arena.h"
#include "core/text.h"
#include "deck/expression.h"
#include "deck/parameter.h"

struct buffer {
    char text[TEXT_MAX + 1];
    size_t used;
};

static bool append(struct deck *d, const struct word *w, struct buffer *b, const char *text,
                   size_t n) {
    if (n > TEXT_MAX - b->used) {
        return deck_error(d, w, "the text is longer than %d bytes with its parameters replaced",
                          TEXT_MAX);
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

// Appends the value of the expression in braces, from `from` to `to`.
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

// Appends the value of the $name or ${expression} at *at, and moves *at past it.
static bool append_dollar(struct deck *d, const struct word *w, struct buffer *b, const char **at) {
    const char *from = *at + 1;
    if (*from == '{') {
        const char *close = strchr(from, '}');
        if (!close) {
            struct word part = deck_report_part(d, w, *at, from + 1);
            return deck_error(d, &part, "the '}' to this '${' is missing");
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
    d->reader->n_replaced += b.used;
    if (d->reader->n_replaced > TEXT_TOTAL_MAX) {
        deck_error(d, w,
                   "all texts together are longer than %d bytes with their parameters replaced",
                   TEXT_TOTAL_MAX);
        return NULL;
    }
    const char *text = arena_text(d->arena, b.text, b.used);
    if (!text) {
        diagnostics_no_memory(&d->diagnostics);
    }
    return text;
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

// True if the word is $name or ${...}, perhaps after a sign, and nothing else.
static bool is_dollar(const char *text) {
    text += *text == '-' || *text == '+';
    if (text[0] != '$') {
        return false;
    }
    if (text[1] == '{') {
        const char *close = strchr(text, '}');
        return close && close[1] == 0;
    }
    const char *end = parameter_name_end(text + 1);
    return end > text + 1 && *end == 0;
}

static bool is_number_like(const struct word *w) {
    const char *t = w->text + (*w->text == '-' || *w->text == '+');
    t += *t == '.';
    return !w->quoted && ((*t >= '0' && *t <= '9') || is_dollar(w->text));
}

// The text parameter if the whole word is $name or ${name}; NULL: any other word.
static const struct parameter *whole_text(const struct deck *d, const struct word *w) {
    if (w->quoted || w->text[0] != '$') {
        return NULL;
    }
    const char *name = w->text + 1;
    name += *name == '{';
    const char *end = parameter_name_end(name);
    const struct parameter *p = parameter_find(d, name, (size_t)(end - name));
    return is_dollar(w->text) && p && p->kind == PARAMETER_TEXT && (*end == 0 || *end == '}')
               ? p
               : NULL;
}

static const struct source *text_origin(const struct deck *d, const struct word *w) {
    const struct word bare = {.text = w->text};
    const struct parameter *p = whole_text(d, &bare);
    return p ? p->origin : w->place.source;
}

void parameter_read_text(struct deck *d, const struct word *w, struct parameter *p) {
    p->origin = text_origin(d, w);
    p->text = deck_text_of_file(d, w);
    p->kind = p->text ? PARAMETER_TEXT : PARAMETER_WRONG;
}

void parameter_read(struct deck *d, const struct word *w, struct parameter *p) {
    if (!is_number_like(w) || whole_text(d, w)) {
        parameter_read_text(d, w, p);
        return;
    }
    bool ok = expression_number(d, w, w->text, &p->number);
    p->kind = ok ? PARAMETER_NUMBER : PARAMETER_WRONG;
}

struct deck_path *deck_path_enter(struct deck *d, const struct word *w, const char *name) {
    const struct source *from = text_origin(d, w);
    const struct source top = {.name = d->path};
    from = from && from->text ? from : &top;  // a -D has no text
    const char *path = source_path(d, from, name);
    struct deck_path *file = arena_alloc(d->arena, 1, sizeof *file);
    if (!path || !file) {
        diagnostics_no_memory(&d->diagnostics);
        return NULL;
    }
    *file = (struct deck_path){
        .path = path, .absolute = from->absolute || name[0] == '/', .next = d->files};
    d->files = file;
    return file;
}

const char *deck_file(struct deck *d, const struct word *w, const char *name) {
    const struct deck_path *file = deck_path_enter(d, w, name);
    return file ? file->path : NULL;
}
