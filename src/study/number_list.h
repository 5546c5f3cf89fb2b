// SPDX-License-Identifier: GPL-3.0-or-later
// Numbers that rise, as text with ranges: "3, 5-8, 12".
#ifndef JOSTLE_NUMBER_LIST_H
#define JOSTLE_NUMBER_LIST_H

#include <stdbool.h>
#include <stddef.h>

struct number_list {
    char *text;  // (size) borrowed; "" at first
    size_t size, used;
    long first, last;  // the range not yet written; 0: none
    long n;            // numbers added
    bool full;
};

// Adds a number larger than those before it; three or more in a row become a range.
void number_list_add(struct number_list *l, long number);
// Writes what is left; ", ..." replaces what had no room.
void number_list_end(struct number_list *l);

#endif
