// SPDX-License-Identifier: GPL-3.0-or-later
// An arena provides zeroed memory. Objects that are built together are freed together, in one call.
#ifndef JOSTLE_ARENA_H
#define JOSTLE_ARENA_H

#include <stdbool.h>
#include <stddef.h>

struct arena;

// An empty arena; NULL: no memory.
struct arena *arena_create(void);
void arena_free(struct arena *a);  // NULL is allowed

// True if a request has failed. After many requests one call is enough.
bool arena_failed(const struct arena *a);

// `n` zeroed objects of `size` bytes, aligned for any type; NULL: no memory or n * size too large.
// n = 0 gives a valid pointer that must not be read.
void *arena_alloc(struct arena *a, size_t n, size_t size);

// A copy of the first `n` bytes of `text` with a final 0; NULL: no memory.
char *arena_text(struct arena *a, const char *text, size_t n);

// A text in the arena, formatted as by printf; NULL: no memory.
char *arena_format(struct arena *a, const char *format, ...) __attribute__((format(printf, 2, 3)));

#endif
