// SPDX-License-Identifier: GPL-3.0-or-later
// An index of names: a hash table with open addresses in an arena.
#ifndef JOSTLE_MODEL_NAME_INDEX_H
#define JOSTLE_MODEL_NAME_INDEX_H

#include <stdbool.h>
#include <stddef.h>

struct arena;

struct name_index {
    const char **name;  // (n_slot) NULL: free
    int *item;          // (n_slot)
    size_t n_slot, n;   // n_slot: a power of 2, at least 2 n
};

// The item of the name, which need not end with 0; -1: not found.
int name_index_find(const struct name_index *x, const char *name, size_t length);

// Adds a new name, which must outlive the index; false: no memory.
bool name_index_add(struct name_index *x, struct arena *a, const char *name, int item);

#endif
