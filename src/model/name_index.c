// SPDX-License-Identifier: GPL-3.0-or-later
#include "model/name_index.h"

#include <assert.h>
#include <string.h>

#include "core/arena.h"
#include "core/hash.h"

enum { SLOTS_FIRST = 16 };

// The slot of the name, or the free slot for it.
static size_t slot_of(const struct name_index *x, const char *name, size_t length) {
    size_t i = (size_t)hash_add(hash_start, name, length) & (x->n_slot - 1);
    while (x->name[i] && (strncmp(x->name[i], name, length) != 0 || x->name[i][length] != '\0')) {
        i = (i + 1) & (x->n_slot - 1);
    }
    return i;
}

int name_index_find(const struct name_index *x, const char *name, size_t length) {
    assert(name && (x->n_slot & (x->n_slot - 1)) == 0);
    const size_t i = x->n > 0 ? slot_of(x, name, length) : 0;
    return x->n > 0 && x->name[i] ? x->item[i] : -1;
}

static void put(struct name_index *x, const char *name, int item) {
    const size_t i = slot_of(x, name, strlen(name));
    x->name[i] = name;
    x->item[i] = item;
    x->n++;
}

static bool grow(struct name_index *x, struct arena *a) {
    const size_t n_slot = x->n_slot ? 2 * x->n_slot : SLOTS_FIRST;
    struct name_index next = {.n_slot = n_slot};
    next.name = arena_alloc(a, n_slot, sizeof *next.name);
    next.item = arena_alloc(a, n_slot, sizeof *next.item);
    if (!next.name || !next.item) {
        return false;
    }
    for (size_t i = 0; i < x->n_slot; i++) {
        if (x->name[i]) {
            put(&next, x->name[i], x->item[i]);
        }
    }
    *x = next;
    return true;
}

bool name_index_add(struct name_index *x, struct arena *a, const char *name, int item) {
    assert(name && a && 2 * x->n <= x->n_slot);
    if (2 * (x->n + 1) > x->n_slot && !grow(x, a)) {
        return false;
    }
    put(x, name, item);
    return true;
}
