// SPDX-License-Identifier: GPL-3.0-or-later
// Newton steps on all links of a cluster at once, to speed up the sweeps of contact.c.
#ifndef JOSTLE_BLOCK_H
#define JOSTLE_BLOCK_H

#include "solve/contact/cluster.h"

struct work;

// Scratch of a cluster, and what is to be restored.
struct block {
    int most;        // links of a cluster; larger ones are left to sweeps
    double *matrix;  // (most, most)
    double *vector;  // (most)
    double *kept_q;  // [L/T^2] (n_dof)
};

// Room for the clusters of a model; false: no memory.
bool block_alloc(struct block *b, const struct model *m, struct arena *a);

// Tries Newton steps on the forces of the cluster: several whole ones, kept if a sweep after them
// moves the links by no more than half of *nearest, the least so far; else the part of one that is
// lowest on the function that sweeps minimise. False: neither helped, and one sweep was done.
bool block_step(struct work *w, const struct state *now, struct state *next,
                const struct cluster *c, double *nearest);

#endif
