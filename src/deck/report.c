// SPDX-License-Identifier: GPL-3.0-or-later
// Reports errors and warnings at words.
#include <stdarg.h>
#include <string.h>

#include "core/arena.h"
#include "core/text.h"
#include "deck/reader.h"

enum { MESSAGE_MAX = 1024 };

static void report(struct deck *d, const struct word *w, enum severity severity, const char *format,
                   va_list list) {
    char message[MESSAGE_MAX];
    vsnprintf(message, sizeof message, format, list);
    struct diagnostic entry = {.severity = severity, .file = d->path};
    const struct place p = w ? w->place : source_end(d);
    if (p.source) {
        entry.file = p.source->name;
        entry.line = p.line;
        entry.column = p.column;
        entry.width = p.width;
        // Beyond the last message kept there is no need to search for the line.
        if (p.line > 0 && d->diagnostics.n_item < DIAGNOSTICS_MAX) {
            entry.source_line = source_line(p.source, p.line);
        }
    }
    diagnostics_add(&d->diagnostics, &entry, "%s", message);
}

void deck_error(struct deck *d, const struct word *w, const char *format, ...) {
    va_list list;
    va_start(list, format);
    report(d, w, SEVERITY_ERROR, format, list);
    va_end(list);
}

void deck_error_of(struct deck *d, const struct word *w, const struct error *e) {
    deck_error(d, w, "%s", e->message);
    d->diagnostics.system = d->diagnostics.system || e->status == STATUS_SYSTEM;
}

void deck_warning(struct deck *d, const struct word *w, const char *format, ...) {
    va_list list;
    va_start(list, format);
    report(d, w, SEVERITY_WARNING, format, list);
    va_end(list);
}

const char *deck_quote(struct deck_quote *q, const struct word *w, const char *value) {
    struct text_short shown, from;
    const bool replaced = strchr(w->text, '$') && strcmp(w->text, value) != 0;
    snprintf(q->text, sizeof q->text, "'%s'%s%s%s", text_short(&shown, value),
             replaced ? " (from " : "", replaced ? text_short(&from, w->text) : "",
             replaced ? ")" : "");
    return q->text;
}

const char *deck_unknown(struct deck *d, const struct word *w, const char *value, const char *what,
                         const char *const *known, int n) {
    struct deck_quote word;
    deck_quote(&word, w, value);
    const char *nearest = text_nearest(value, known, n);
    if (nearest) {
        deck_error(d, w, "unknown %s %s; did you mean '%s'?", what, word.text, nearest);
        return nearest;
    }
    if (n == 0 || n > TEXT_LISTED_MAX) {
        deck_error(d, w, "unknown %s %s", what, word.text);
        return NULL;
    }
    char list[MESSAGE_MAX - 2 * sizeof word];
    deck_error(d, w, "unknown %s %s; available: %s", what, word.text,
               text_list(list, sizeof list, known, n));
    return NULL;
}

int deck_keyword(struct deck *d, const struct word *w, const char *what, const char *const *known,
                 int n) {
    for (int i = 0; i < n; i++) {
        if (strcmp(w->text, known[i]) == 0) {
            return i;
        }
    }
    deck_unknown(d, w, w->text, what, known, n);
    return -1;
}

struct word report_part(struct deck *d, const struct word *w, const char *from, const char *to) {
    size_t n = (size_t)(to - from);
    struct word part = *w;
    part.place.column += (w->quoted ? 1 : 0) + text_columns(w->text, (size_t)(from - w->text));
    part.place.width = n > 0 ? text_columns(from, n) : 1;
    const size_t longest = sizeof(struct text_short);  // messages show no more
    part.text = arena_text(d->arena, from, n < longest ? n : longest);
    if (!part.text) {
        diagnostics_no_memory(&d->diagnostics);
        part.text = "";
    }
    return part;
}

bool report_false(struct deck *d, const struct word *w, const char *from, const char *to,
                  const char *format, ...) {
    struct word part = report_part(d, w, from, to);
    va_list list;
    va_start(list, format);
    report(d, &part, SEVERITY_ERROR, format, list);
    va_end(list);
    return false;
}
