// SPDX-License-Identifier: GPL-3.0-or-later
// The files of a deck, and the errors and warnings at their words.
#include <assert.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

#include "core/arena.h"
#include "core/text.h"
#include "deck/reader.h"

void *deck_array(struct deck *d, size_t n, size_t size) {
    assert(size > 0);
    void *array = arena_alloc(d->arena, n, size);
    if (!array) {
        diagnostics_no_memory(&d->diagnostics);
    }
    return array;
}

static const char byte_order_mark[] = "\xEF\xBB\xBF";

static size_t text_start(const struct source *s) {
    return strncmp(s->text, byte_order_mark, 3) == 0 ? 3 : 0;
}

struct source *source_add(struct deck *d, const char *name, const char *text, size_t size) {
    assert(name && text);
    struct source *s = arena_alloc(d->arena, 1, sizeof *s);
    char *cell = arena_text(d->arena, text, size);
    if (!s || !cell) {
        return NULL;
    }
    *s = (struct source){
        .name = name, .text = text, .size = size, .cell = cell, .next = d->reader->source};
    struct stat status;
    if (stat(name, &status) == 0) {
        s->on_disk = true;
        s->device = status.st_dev;
        s->inode = status.st_ino;
    }
    d->reader->source = s;
    return s;
}

// The text of line `line` (from 1).
static const char *source_line(const struct source *s, int line) {
    const char *at = s->text + text_start(s), *end = s->text + s->size;
    for (int i = 1; i < line; i++) {
        const char *feed = memchr(at, '\n', (size_t)(end - at));
        if (!feed) {
            return end;
        }
        at = feed + 1;
    }
    return at;
}

// The place after the last word of the deck.
static struct place source_end(const struct deck *d) {
    const struct source *s = d->reader->source;
    while (s->next) {
        s = s->next;
    }
    const char *start = s->text + text_start(s), *end = s->text + s->size;
    while (end > start && strchr(" \t\r\n", end[-1])) {
        end--;
    }
    struct place p = {.source = s, .line = 1, .width = 1};
    const char *feed;
    while ((feed = memchr(start, '\n', (size_t)(end - start)))) {
        start = feed + 1;
        p.line++;
    }
    p.column = text_columns(start, (size_t)(end - start)) + 1;
    return p;
}

const char *source_path(struct deck *d, const struct source *s, const char *name) {
    const char *slash = strrchr(s->name, '/');
    if (name[0] == '/' || !slash) {
        return arena_text(d->arena, name, strlen(name));
    }
    size_t n = (size_t)(slash - s->name) + 1, m = strlen(name);
    char *path = arena_alloc(d->arena, n + m + 1, 1);
    if (path) {
        memcpy(path, s->name, n);
        memcpy(path + n, name, m);
    }
    return path;
}

// Reports the first 0 byte of a source, which is then not read: it may be anything but a deck.
static bool has_zero(struct deck *d, const struct source *s) {
    const char *zero = memchr(s->text, 0, s->size);
    if (!zero) {
        return false;
    }
    const char *start = s->text + text_start(s), *feed;
    struct word w = {.text = "", .place = {.source = s, .line = 1, .width = 1}};
    while ((feed = memchr(start, '\n', (size_t)(zero - start)))) {
        start = feed + 1;
        w.place.line++;
    }
    w.place.column = text_columns(start, (size_t)(zero - start)) + 1;
    deck_error(d, &w, "a 0 byte; a deck is text");
    d->torn = true;
    return true;
}

void source_enter(struct deck *d, struct source *s) {
    struct reader *r = d->reader;
    if (has_zero(d, s)) {
        return;
    }
    r->bytes += s->size;
    r->frame[r->n_frame++] = (struct frame){.source = s, .offset = text_start(s), .line = 1};
}

static const char include_mark[] = "# include ";

// The bytes of one entry of deck_includes: the line of the mark, and the text. The text gets a
// final line feed if it has none.
static size_t include_size(const struct source *s) {
    bool ends = s->size > 0 && s->text[s->size - 1] == '\n';
    return strlen(include_mark) + strlen(s->name) + 1 + s->size + (ends ? 0 : 1);
}

// The list starts with the last source, so the text is filled from its end. The first source is the
// deck itself and is left out.
const char *deck_includes(struct deck *d) {
    size_t size = 0;
    for (const struct source *s = d->reader->source; s && s->next; s = s->next) {
        size += include_size(s);
    }
    char *text = arena_alloc(d->arena, size + 1, 1);
    for (const struct source *s = d->reader->source; text && s && s->next; s = s->next) {
        size_t n = include_size(s);
        char *at = text + (size -= n);
        int head = sprintf(at, "%s%s\n", include_mark, s->name);
        memcpy(at + head, s->text, s->size);
        memset(at + head + s->size, '\n', n - (size_t)head - s->size);
    }
    return text;
}

const char *source_mention(struct deck *d, const struct place *p, const struct place *from) {
    struct text_short name;
    const char *text = p->source == from->source ? arena_format(d->arena, "line %d", p->line)
                                                 : arena_format(d->arena, "line %d of %s", p->line,
                                                                text_short(&name, p->source->name));
    return text ? text : "another line";
}

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
        // Messages above the limit are not kept and need no line.
        if (p.line > 0 && d->diagnostics.n_item < DIAGNOSTICS_MAX) {
            entry.source_line = source_line(p.source, p.line);
        }
    }
    diagnostics_add(&d->diagnostics, &entry, "%s", message);
}

bool deck_error(struct deck *d, const struct word *w, const char *format, ...) {
    va_list list;
    va_start(list, format);
    report(d, w, SEVERITY_ERROR, format, list);
    va_end(list);
    return false;
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

struct word deck_report_part(struct deck *d, const struct word *w, const char *from,
                             const char *to) {
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

bool deck_report_false(struct deck *d, const struct word *w, const char *from, const char *to,
                       const char *format, ...) {
    struct word part = deck_report_part(d, w, from, to);
    va_list list;
    va_start(list, format);
    report(d, &part, SEVERITY_ERROR, format, list);
    va_end(list);
    return false;
}
