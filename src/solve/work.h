// SPDX-License-Identifier: GPL-3.0-or-later
// Scratch of the solver. Only the factors outlive a step: they are kept as long as the step size
// and the tangents stay the same. All of it is allocated before the first step.
#ifndef JOSTLE_WORK_H
#define JOSTLE_WORK_H

#include "solve/contact/gaps.h"
#include "solve/floors/effective.h"
#include "solve/floors/floors.h"
#include "solve/forcing.h"
#include "solve/pace.h"
#include "solve/state.h"

// What to do when the iteration of contacts or storeys does not converge.
enum strictness {
    STEP_STRICT,  // give STATUS_RETRY: the step is rejected
    STEP_ACCEPT,  // take the last iterate and count it: the step is as short as it gets
};

// Newton's iteration on the storeys, in newmark.c: each is linear about its point at the trial.
struct storeys {
    double *drift, *shear;  // (n_dof) [L] [F] shears on their tangents
    double *rate;           // (n_dof) [L/T] of the drifts of buildings with parts
};

struct link_scratch;

// Clusters: live links that are connected by buildings that they share. Newton steps on all links
// of a cluster at once speed up the sweeps of contact.c. This struct lists the clusters, and has
// the scratch of these steps. A cluster has the number of one of its buildings. Arrays are
// (n_building) if no other shape is given.
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

struct work {
    const struct model *model;  // borrowed, as are the next two
    struct totals *totals;      // counters
    struct memory *memory;

    // The step in hand.
    double h;                     // [T] step of the factors; 0: none yet
    double b, per_b;              // beta h^2, which may be 0, and 1 / b
    double g, per_g;              // gamma h and 1 / g
    struct effective *effective;  // (n_building) `home` or `other`
    struct effective *home;       // (n_building) for steps of the model's size
    struct effective *other;      // (n_building) for shorter ones
    long factors;                 // counts its factorisations
    enum strictness strictness;
    int held;  // link that stays open or closed in this step; -1: none
    int lost;  // building a part of which had no equilibrium in this step; -1: none

    // Borrowed; NULL: steps are fixed, and do not end at corners.
    const struct forcing *forcing;
    const struct scales *scales;

    // Its floors.
    struct forcing_ahead ahead;  // of steps of the model's size
    struct floors floors;
    double *u_trial, *v_trial;  // (n_dof) at the end of the step if the accelerations stay; of
                                // linear models, for buildings that gaps.touched lists
    double *correction;         // (n_dof) [L/T^2] of the accelerations
    struct storeys storeys;

    // Its links.
    struct gaps gaps;
    struct link_scratch *link;     // (n_link) what the solution for its force needs of each link
    int n_acting;                  // live links whose forces are being solved for,
    struct link_scratch **acting;  // (n_link) in ascending order
    double most_links;             // most links with a force law that any floor has
    bool commits;                  // some law remembers what happens in contact
    int n_toggled, *toggled;       // links that have closed or opened in the step in hand
    int n_rigid, *rigid;           // contacts of laws without a force
    double others_d, others_v;     // [L] [L/T] rounding error that other links cause at a link
    struct clusters clusters;
};

// Room for the scratch of a model, whose factors are still to be found, for a run with these
// results and memory; false: no memory.
bool work_alloc(struct work *w, const struct model *m, struct results *r, struct memory *memory,
                struct arena *a);

// Prepares the scratch for another state, after its memory and home factors' tangents have been
// replaced.
void work_resume(struct work *w);

// Factorises for steps of size h. The factors for the model's own step size are kept meanwhile.
// STATUS_RETRY: a matrix is not positive definite.
int work_factor(struct work *w, double h);

#endif
