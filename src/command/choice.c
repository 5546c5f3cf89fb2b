// SPDX-License-Identifier: GPL-3.0-or-later
#include "command/choice.h"

#include <stdlib.h>

static int by_index(const void *left, const void *right) {
    const struct choice *a = left, *b = right;
    return (a->index > b->index) - (a->index < b->index);
}

static int by_rank(const void *left, const void *right) {
    const struct choice *a = left, *b = right;
    if (a->rank != b->rank) {
        return a->rank < b->rank ? 1 : -1;
    }
    return by_index(left, right);
}

int choice_add(struct choice *shown, int n, int most, struct choice c) {
    if (n == most && by_rank(&c, &shown[n - 1]) > 0) {
        return n;
    }
    int i = n == most ? n - 1 : n;
    for (; i > 0 && by_rank(&c, &shown[i - 1]) < 0; i--) {
        shown[i] = shown[i - 1];
    }
    shown[i] = c;
    return n == most ? n : n + 1;
}

void choice_sort(struct choice *shown, int n) {
    qsort(shown, (size_t)n, sizeof *shown, by_index);
}
