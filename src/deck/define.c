// SPDX-License-Identifier: GPL-3.0-or-later
// -D NAME=VALUE of the command line.
#include <string.h>

#include "core/arena.h"
#include "core/text.h"
#include "deck/reader.h"

struct define *define_find(const struct deck *d, const char *name) {
    for (int i = 0; i < d->reader->n_define; i++) {
        if (strcmp(d->reader->define[i].name, name) == 0) {
            return &d->reader->define[i];
        }
    }
    return NULL;
}

static void check(struct deck *d, struct define *define) {
    struct word name = define->value;
    name.text = define->name;
    define->taken = true;
    if (text_not_plain(define->name) || text_not_plain(define->value.text)) {
        deck_error(d, &name, "this is not UTF-8 text without control characters");
    } else if (!define->value.text[0]) {
        deck_error(d, &name, "it must be -D NAME=VALUE");
    } else if (parameter_check_name(d, &name)) {
        define->taken = false;
        for (struct define *other = d->reader->define; other < define; other++) {
            if (strcmp(other->name, define->name) == 0) {
                deck_error(d, &name, "'%s' is given twice", define->name);
                define->taken = true;
                return;
            }
        }
    }
}

static bool split(struct deck *d, const char *text, struct define *define) {
    size_t n = strcspn(text, "=");
    const char *value = text + n + (text[n] == '=');
    size_t size = strlen(value);
    bool quoted = size >= 2 && value[0] == '"' && value[size - 1] == '"';
    define->name = arena_text(d->arena, text, n);
    define->value.text =
        quoted ? arena_text(d->arena, value + 1, size - 2) : arena_text(d->arena, value, size);
    define->source.name = arena_format(d->arena, "-D %s", text);
    if (!define->name || !define->value.text || !define->source.name) {
        return false;
    }
    define->value.quoted = quoted;
    define->value.place.source = &define->source;
    return true;
}

bool define_open(struct deck *d, const char *const *define, int n_define) {
    d->reader->define = arena_alloc(d->arena, (size_t)n_define, sizeof *d->reader->define);
    if (!d->reader->define) {
        return false;
    }
    for (int i = 0; i < n_define; i++) {
        d->reader->n_define = i + 1;
        if (!split(d, define[i], &d->reader->define[i])) {
            return false;
        }
    }
    return true;
}

void define_check(struct deck *d) {
    for (int i = 0; i < d->reader->n_define; i++) {
        check(d, &d->reader->define[i]);
    }
}

void define_turn(struct deck *d, struct define *define, const char *name, int number) {
    const char *text = arena_format(d->arena, "%d", number);
    if (!text) {
        diagnostics_no_memory(&d->diagnostics);
        return;
    }
    define->name = name;
    define->value.text = text;
    define->beside = NULL;
    d->reader->turned = true;
}

void define_bind(struct deck *d, const struct deck *first) {
    for (int i = 0; i < d->reader->n_define; i++) {
        d->reader->define[i].name = first->reader->define[i].name;
        d->reader->define[i].value.text = first->reader->define[i].value.text;
        d->reader->define[i].beside = first->reader->define[i].beside;
    }
}
