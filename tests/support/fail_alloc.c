// SPDX-License-Identifier: GPL-3.0-or-later
// The linker sends calls of malloc and its like to the __wrap_ functions below and makes the
// true ones reachable as __real_. Counters are atomic because a study allocates in its workers,
// too.
#include "support/fail_alloc.h"

#include <stdatomic.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include "support/support.h"

struct arena;

void *__real_malloc(size_t size);
void *__real_calloc(size_t n, size_t size);
void *__real_realloc(void *p, size_t size);
void *__wrap_malloc(size_t size);
void *__wrap_calloc(size_t n, size_t size);
void *__wrap_realloc(void *p, size_t size);
void *__real_arena_alloc(struct arena *a, size_t n, size_t size);
char *__real_arena_text(struct arena *a, const char *text, size_t n);
void *__wrap_arena_alloc(struct arena *a, size_t n, size_t size);
char *__wrap_arena_text(struct arena *a, const char *text, size_t n);

static atomic_bool active;
static atomic_long count;
static atomic_long failing;

void fail_alloc_at(long k) {
    count = 0;
    failing = k;
    active = true;
}

long fail_alloc_stop(void) {
    active = false;
    return count;
}

void fail_alloc_each(int (*attempt)(void *context, struct error *e), void *context, long least) {
    struct error e = {.message = ""};
    fail_alloc_at(0);
    if (attempt(context, &e) != STATUS_OK) {
        fail_msg("%s", e.message);
    }
    const long n = fail_alloc_stop();
    assert_in_range(n, least, 20000);
    // Under the sanitizers an attempt takes ten times as long: every third allocation fails there.
    for (long k = 1; k <= n; k += getenv("JOSTLE_SANITIZED") ? 3 : 1) {
        e.message[0] = '\0';
        fail_alloc_at(k);
        const int status = attempt(context, &e);
        fail_alloc_stop();
        if (status != STATUS_SYSTEM || !strstr(e.message, "out of memory")) {
            fail_msg("allocation %ld of %ld failed, with status %d and the message '%s'", k, n,
                     status, e.message);
        }
    }
}

static bool fails_now(void) {
    return active && atomic_fetch_add(&count, 1) + 1 == failing;
}

void *__wrap_malloc(size_t size) {
    return fails_now() ? NULL : __real_malloc(size);
}

void *__wrap_calloc(size_t n, size_t size) {
    return fails_now() ? NULL : __real_calloc(n, size);
}

void *__wrap_realloc(void *p, size_t size) {
    return fails_now() ? NULL : __real_realloc(p, size);
}

void *__wrap_arena_alloc(struct arena *a, size_t n, size_t size) {
    return __real_arena_alloc(a, fails_now() ? SIZE_MAX : n, size);
}

char *__wrap_arena_text(struct arena *a, const char *text, size_t n) {
    return fails_now() ? __real_arena_alloc(a, SIZE_MAX, 1) : __real_arena_text(a, text, n);
}
