// SPDX-License-Identifier: GPL-3.0-or-later
// The files of a deck.
#include <stdio.h>
#include <string.h>

#include "core/arena.h"
#include "core/text.h"
#include "deck/reader.h"

static const char byte_order_mark[] = "\xEF\xBB\xBF";

static size_t text_start(const struct source *s) {
    return strncmp(s->text, byte_order_mark, 3) == 0 ? 3 : 0;
}

struct source *source_add(struct deck *d, const char *name, const char *text, size_t size) {
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

const char *source_line(const struct source *s, int line) {
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

struct place source_end(const struct deck *d) {
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

void source_enter(struct deck *d, struct source *s) {
    struct reader *r = d->reader;
    r->bytes += s->size;
    r->frame[r->n_frame++] = (struct frame){.source = s, .offset = text_start(s), .line = 1};
}

static const char include_mark[] = "# include ";

// Its mark and line feeds included; the last one only where the text has none.
static size_t include_size(const struct source *s) {
    bool ends = s->size > 0 && s->text[s->size - 1] == '\n';
    return strlen(include_mark) + strlen(s->name) + 1 + s->size + (ends ? 0 : 1);
}

// The sources are listed the last one first, so the text is filled from its end; the first one is
// the deck itself.
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
