// SPDX-License-Identifier: GPL-3.0-or-later
// Collects messages that point at places in text files, and prints them as compilers do.
#include <assert.h>
#include <stdarg.h>
#include <string.h>

#include "core/arena.h"
#include "core/text.h"
#include "jostle/error.h"

// Longest source line shown [characters]; of a longer one this much, with LEAD characters to the
// left of the column. The dots that mark a cut are part of it.
enum { SHOWN_MAX = 160, LEAD = 60, DOTS = 3, MESSAGE_MAX = 1024 };

void diagnostics_init(struct diagnostics *d, struct arena *arena) {
    assert(d && arena);
    *d = (struct diagnostics){.arena = arena};
}

void diagnostics_no_memory(struct diagnostics *d) {
    if (!d->out_of_memory) {
        d->out_of_memory = true;
        d->n_error++;
    }
}

// The byte at which character `n` of the line of `size` bytes starts, counted from 0.
static size_t character_offset(const char *line, size_t size, int n) {
    size_t at = 0;
    for (int i = 0; i < n && at < size; i++) {
        size_t bytes = text_character(line + at, size - at);
        at += bytes ? bytes : 1;
    }
    return at;
}

static char *clean_copy(struct arena *a, const char *text, size_t n) {
    char *copy = arena_alloc(a, n + 1, 1);
    if (copy) {
        text_clean(copy, n + 1, text, n);
    }
    return copy;
}

// The source line of `item` as it is shown: cut to SHOWN_MAX characters around its column.
static char *shown_line(struct arena *a, struct diagnostic *item) {
    const char *line = item->source_line;
    size_t size = strcspn(line, "\n");
    if (size > 0 && line[size - 1] == '\r') {
        size--;
    }
    item->source_first = 1;
    size_t limit = character_offset(line, size, SHOWN_MAX);
    if (limit == size) {
        return clean_copy(a, line, size);
    }
    int first = item->column > LEAD + DOTS ? item->column - LEAD : 1;
    bool cut = first > 1;
    size_t from = character_offset(line, size, first - 1);
    size_t n = character_offset(line + from, size - from, SHOWN_MAX - DOTS - (cut ? DOTS : 0));
    char *part = clean_copy(a, line + from, n);
    item->source_first = cut ? first - DOTS : 1;
    bool ends = from + n == size;
    return part ? arena_format(a, "%s%s%s", cut ? "..." : "", part, ends ? "" : "...") : NULL;
}

static int keep(struct diagnostics *d, const struct diagnostic *entry, const char *message) {
    if (!d->item) {
        d->item = arena_alloc(d->arena, DIAGNOSTICS_MAX, sizeof *d->item);
        if (!d->item) {
            return -1;
        }
    }
    struct diagnostic item = *entry;
    item.message = clean_copy(d->arena, message, strlen(message));
    item.file = clean_copy(d->arena, entry->file, strlen(entry->file));
    if (entry->source_line) {
        item.source_line = shown_line(d->arena, &item);
    }
    if (!item.message || !item.file || (entry->source_line && !item.source_line)) {
        return -1;
    }
    d->item[d->n_item++] = item;
    return 0;
}

void diagnostics_add(struct diagnostics *d, const struct diagnostic *entry, const char *format,
                     ...) {
    assert(entry && format);
    if (entry->severity == SEVERITY_ERROR) {
        d->n_error++;
    } else {
        d->n_warning++;
    }
    if (d->n_item == DIAGNOSTICS_MAX) {
        return;
    }
    char message[MESSAGE_MAX];
    va_list list;
    va_start(list, format);
    text_compose(message, sizeof message, format, list);
    va_end(list);
    if (keep(d, entry, message) != 0) {
        diagnostics_no_memory(d);
    }
}

static void print_item(const struct diagnostic *item, FILE *to, bool colour) {
    bool error = item->severity == SEVERITY_ERROR;
    const char *tint = error ? "\033[31m" : "\033[35m";
    if (item->line > 0) {
        fprintf(to, "%s:%d:%d: ", item->file, item->line, item->column);
    } else {
        fprintf(to, "%s: ", item->file);
    }
    fprintf(to, "%s%s:%s %s\n", colour ? tint : "", error ? "error" : "warning",
            colour ? "\033[0m" : "", item->message);
    if (item->line > 0 && item->source_line) {
        int columns = text_columns(item->source_line, strlen(item->source_line));
        int first = item->source_first > 1 ? item->source_first : 1;
        int offset = item->column - first;
        fprintf(to, "    %s\n    %*s%s^", item->source_line, offset > 0 ? offset : 0, "",
                colour ? "\033[32m" : "");
        for (int i = 1; i < item->width && offset + i < columns; i++) {
            fputc('~', to);
        }
        fprintf(to, "%s\n", colour ? "\033[0m" : "");
    }
}

int diagnostics_cause(const struct diagnostics *d, struct error *e) {
    if (d->out_of_memory) {
        return error_no_memory(e);  // errors that were reported may follow from it
    }
    const int status = d->system ? STATUS_SYSTEM : e->status;
    e->status = status;
    for (int i = 0; i < d->n_item; i++) {
        const struct diagnostic *item = &d->item[i];
        if (item->severity == SEVERITY_ERROR) {
            return item->line > 0 ? error_set(e, status, "%s:%d:%d: %s", item->file, item->line,
                                              item->column, item->message)
                                  : error_set(e, status, "%s: %s", item->file, item->message);
        }
    }
    return status;
}

void diagnostics_print(const struct diagnostics *d, FILE *to, bool colour) {
    assert(d && to);
    for (int i = 0; i < d->n_item; i++) {
        print_item(&d->item[i], to, colour);
    }
    int more = d->n_error + d->n_warning - d->n_item - (d->out_of_memory ? 1 : 0);
    if (more > 0) {
        fprintf(to, "%d more messages are not shown\n", more);
    }
    if (d->out_of_memory) {
        fprintf(to, "out of memory\n");
    }
}
