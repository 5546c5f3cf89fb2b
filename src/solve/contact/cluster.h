// SPDX-License-Identifier: GPL-3.0-or-later
// Links that act on each other, and Newton steps on all of them at once, to speed up the sweeps of
// contact.c.
#ifndef JOSTLE_CLUSTER_H
#define JOSTLE_CLUSTER_H

#include "solve/state.h"

struct work;

// Links connected by buildings that they share.
struct cluster {
    int n;
    const int *link;  // (n) borrowed from struct clusters
};

// Room to find all of them, and for the steps; arrays (n_building) but where another shape is
// given.
struct clusters {
    int *parent;      // of each building, towards the one that stands for its cluster
    int *end;         // of the links of each that stands for one, in `link`
    int *leader;      // the building that stands for each cluster
    int *link;        // (n_link) live links, by cluster
    double *nearest;  // [L/T^2] of each: the least that a sweep moved its links by, for contact.c
    int most;         // links of a cluster; larger ones are left to sweeps
    double *matrix;   // (most, most)
    double *vector;   // (most)
    double *kept_q;   // [L/T^2] (n_dof) corrections to be restored
};

// Room for the clusters of a model; false: no memory.
bool cluster_alloc(struct clusters *c, const struct model *m, struct arena *a);

// Puts the live links of `s` in order of their clusters; returns how many clusters there are.
int cluster_find(struct clusters *c, const struct model *m, const struct state *s);

// Cluster i of those found.
struct cluster cluster_at(const struct clusters *c, int i);

// Tries Newton steps on the forces of the cluster: several whole ones, kept if a sweep after them
// moves the links by no more than half of *nearest, the least so far; else the part of one that is
// lowest on the function that sweeps minimise. False: neither helped, and one sweep was done.
bool cluster_step(struct work *w, const struct state *now, struct state *next,
                  const struct cluster *c, double *nearest);

#endif
