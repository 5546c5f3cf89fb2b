// SPDX-License-Identifier: GPL-3.0-or-later
// Links that act on each other.
#ifndef JOSTLE_CLUSTER_H
#define JOSTLE_CLUSTER_H

#include "solve/work.h"

// Links connected by buildings that they share.
struct cluster {
    int n;
    int *link;  // (n) borrowed from struct work
};

// Puts the live links of `next` in order of their clusters, into w->grouped; returns how many
// clusters there are.
int cluster_find(struct work *w, const struct state *next);

// Cluster i of those found.
struct cluster cluster_at(const struct work *w, int i);

#endif
