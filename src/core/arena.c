// SPDX-License-Identifier: GPL-3.0-or-later
// Blocks of memory in a list, each twice as large as the last up to a limit. A request that does
// not fit opens a new block.
#include "core/arena.h"

#include <assert.h>
#include <stdalign.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { FIRST_BLOCK = 4096, LARGEST_BLOCK = 1 << 20 };

struct block {
    struct block *previous;
    size_t size;  // bytes behind the header
    size_t used;
    alignas(max_align_t) char byte[];
};

struct arena {
    struct block *last;
    bool failed;
};

struct arena *arena_create(void) {
    return calloc(1, sizeof(struct arena));
}

void arena_free(struct arena *a) {
    if (!a) {
        return;
    }
    for (struct block *b = a->last; b;) {
        struct block *previous = b->previous;
        free(b);
        b = previous;
    }
    free(a);
}

bool arena_failed(const struct arena *a) {
    assert(a);
    return a->failed;
}

static struct block *block_open(struct arena *a, size_t bytes) {
    size_t size = a->last ? 2 * a->last->size : FIRST_BLOCK;
    if (size > LARGEST_BLOCK) {
        size = LARGEST_BLOCK;
    }
    if (size < bytes) {
        size = bytes;
    }
    struct block *b = calloc(1, sizeof *b + size);
    if (!b) {
        return NULL;
    }
    b->size = size;
    b->previous = a->last;
    a->last = b;
    return b;
}

static void *fail(struct arena *a) {
    a->failed = true;
    return NULL;
}

void *arena_alloc(struct arena *a, size_t n, size_t size) {
    assert(a && size > 0);
    const size_t unit = alignof(max_align_t);
    if (size != 0 && n > (SIZE_MAX / 2 - unit) / size) {
        return fail(a);
    }
    size_t bytes = (n * size + unit - 1) / unit * unit;
    struct block *b = a->last;
    if (!b || b->size - b->used < bytes) {
        b = block_open(a, bytes);
        if (!b) {
            return fail(a);
        }
    }
    void *p = b->byte + b->used;
    b->used += bytes;
    return p;
}

char *arena_text(struct arena *a, const char *text, size_t n) {
    assert(a && (text || n == 0));
    char *copy = arena_alloc(a, n + 1, 1);
    if (copy) {
        memcpy(copy, text, n);
    }
    return copy;
}

char *arena_format(struct arena *a, const char *format, ...) {
    assert(a && format);
    va_list list;
    va_start(list, format);
    int n = vsnprintf(NULL, 0, format, list);
    va_end(list);
    char *text = arena_alloc(a, n < 0 ? SIZE_MAX : (size_t)n + 1, 1);
    if (text) {
        va_start(list, format);
        vsnprintf(text, (size_t)n + 1, format, list);
        va_end(list);
    }
    return text;
}
