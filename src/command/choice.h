// SPDX-License-Identifier: GPL-3.0-or-later
// The foremost entries of a long list, for tables that show only some.
#ifndef JOSTLE_CHOICE_H
#define JOSTLE_CHOICE_H

enum { SHOWN_MAX = 20 };

struct choice {
    double rank;  // the larger, the further in front
    int index;    // of the entry in its list
};

// Puts `c` among the foremost `most` of the `n` in `shown`, kept sorted by rank. Returns how many
// there are.
int choice_add(struct choice *shown, int n, int most, struct choice c);

// Sorts them by index.
void choice_sort(struct choice *shown, int n);

#endif
