// SPDX-License-Identifier: GPL-3.0-or-later
// Clusters: live links that are connected by buildings that they share. Newton steps on all links
// of a cluster at once speed up the sweeps of contact.c.
#ifndef JOSTLE_CLUSTER_H
#define JOSTLE_CLUSTER_H

#include "solve/state.h"

struct work;

// Where clusters are found, and the scratch of their steps. A cluster has the number of one of its
// buildings. Arrays (n_building) but where another shape is given.
struct clusters {
    int *leader;      // of each building, towards the one whose number its cluster has
    int *first;       // of each cluster, its first live link; -1: it has none
    int *after;       // (n_link) of each live link, the next one of its cluster; -1: none
    int *position;    // of the first link of each building in its cluster; -1: none yet
    double *nearest;  // [L/T^2] the least that a sweep has moved the links of each cluster by
    int most;         // links of a cluster; larger ones are left to sweeps
    int n, *link;     // (most) links of the cluster in hand, in ascending order
    int width;        // how far from each other in there links are that share a building, at most
    double *matrix;   // (most, most)
    double *change;   // [F] (most) of the forces
    double *kept_q;   // [L/T^2] (n_dof) corrections to be restored
};

// Room for the clusters of a model; false: no memory.
bool cluster_alloc(struct clusters *c, const struct model *m, struct arena *a);

// Finds the clusters of the live links of `s`, which nothing has been tried on yet.
void cluster_find(struct clusters *c, const struct model *m, const struct state *s);

// Tries Newton steps on the forces of each cluster: several whole ones, kept if a sweep after them
// moves the links by no more than half of the least so far; else the part of one that is lowest on
// the function that sweeps minimise. False: neither helped any cluster, and they were swept once.
bool cluster_steps(struct work *w, const struct state *now, struct state *next);

// Solves A x = b for the matrix A (n, n), rows after each other, in place of b (n). A is 0 farther
// than `width` from its diagonal. What is left of A means nothing. False: A is singular, or not
// finite.
bool cluster_eliminate(double *a, double *b, ptrdiff_t n, ptrdiff_t width);

#endif
