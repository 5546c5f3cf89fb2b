// SPDX-License-Identifier: GPL-3.0-or-later
#include "study/number_list.h"

#include <stdio.h>
#include <string.h>

static const char more[] = ", ...";

static void flush(struct number_list *l) {
    char range[64] = "";
    if (l->first == 0 || l->full) {
        return;
    }
    int n = snprintf(range, sizeof range, "%s%ld", l->used > 0 ? ", " : "", l->first);
    if (l->last > l->first) {
        n += snprintf(range + n, sizeof range - (size_t)n, "%s%ld",
                      l->last == l->first + 1 ? ", " : "-", l->last);
    }
    l->full = l->used + (size_t)n + sizeof more > l->size;
    memcpy(l->text + l->used, l->full ? more : range, l->full ? sizeof more : (size_t)n + 1);
    l->used += l->full ? 0 : (size_t)n;
}

void number_list_add(struct number_list *l, long number) {
    l->n++;
    if (l->first == 0 || number != l->last + 1) {
        flush(l);
        l->first = number;
    }
    l->last = number;
}

void number_list_end(struct number_list *l) {
    flush(l);
    l->first = 0;
}
