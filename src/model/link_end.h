// SPDX-License-Identifier: GPL-3.0-or-later
// The ends of links as sparse rows b over the degrees of freedom: values at an end, and effects of
// a force on it. The row of a floor has one entry of weight 1. The row of a wall has no entries.
#ifndef JOSTLE_LINK_END_H
#define JOSTLE_LINK_END_H

#include <math.h>

#include "jostle/model.h"

// True if each end of the link is one floor or a wall.
static inline bool link_is_plain(const struct link *l) {
    return l->row[0].n == 0 && l->row[1].n == 0;
}

// The number of entries of an end. link_entry returns entry i.
static inline int link_entries(const struct link *l, int side) {
    return l->row[side].n > 0 ? l->row[side].n : l->dof[side] != WALL;
}

static inline struct link_entry link_entry(const struct link *l, int side, int i) {
    return l->row[side].n > 0 ? l->row[side].entry[i] : (struct link_entry){l->dof[side], 1.0};
}

// b x of a row, and of an end, for x (n_dof). The sum over a row is not in line, so that loops over
// links between floors stay small.
double link_end_row(const struct link_row *row, const double *x);

static inline double link_at(const struct link *l, int side, const double *x) {
    if (l->row[side].n > 0) {
        return link_end_row(&l->row[side], x);
    }
    return l->dof[side] == WALL ? 0.0 : x[l->dof[side]];
}

// The sum of the absolute values of the terms of link_at.
static inline double link_size_at(const struct link *l, int side, const double *x) {
    double sum = 0.0;
    for (int i = 0, n = link_entries(l, side); i < n; i++) {
        const struct link_entry e = link_entry(l, side, i);
        sum += fabs(e.weight * x[e.dof]);
    }
    return sum;
}

// The difference of x between the left end and the right end. link_size: the sum of link_size_at of
// both ends.
static inline double link_across(const struct link *l, const double *x) {
    return 0.0 + link_at(l, 0, x) - link_at(l, 1, x);
}

static inline double link_size(const struct link *l, const double *x) {
    return link_size_at(l, 0, x) + link_size_at(l, 1, x);
}

// Adds b' f of one end to x (n_dof).
static inline void link_push_at(const struct link *l, int side, double f, double *x) {
    for (int i = 0, n = link_entries(l, side); i < n; i++) {
        const struct link_entry e = link_entry(l, side, i);
        x[e.dof] += e.weight * f;
    }
}

// Adds b' f of both ends to x (n_dof), for a force f of the link, positive in compression.
static inline void link_push(const struct link *l, double f, double *x) {
    link_push_at(l, 0, -f, x);
    link_push_at(l, 1, f, x);
}

// The sum of b M^-1 b' of both ends, which is the inverse of the effective mass.
static inline double link_mobility(const struct link *l, const double *mass) {
    double sum = 0.0;
    for (int side = 0; side < 2; side++) {
        for (int i = 0, n = link_entries(l, side); i < n; i++) {
            const struct link_entry e = link_entry(l, side, i);
            sum += e.weight * e.weight / mass[e.dof];
        }
    }
    return sum;
}

#endif
