// SPDX-License-Identifier: GPL-3.0-or-later
// Quick sweeps over the live links: Newton steps one link after the other, from data that stand
// side by side.
#ifndef JOSTLE_QUICK_H
#define JOSTLE_QUICK_H

#include "solve/work.h"

// One link. What changes is gathered where it is live.
struct quick {
    const struct link *link;
    int index;                // of the link
    bool smooth;              // its law is CONTACT_SMOOTH
    bool trusted;             // its force is on the closed branch: a Newton step may start there
    bool open;                // its force is 0 as long as d <= 0
    bool settled;             // its force obeyed the law when it saw `seen`
    int end[2];               // among the arrays of struct chain
    int first[2];             // of the floors there that feel its force, at either end
    int lanes[2];             // how many they are, in whole lanes; 0 for a wall
    const double *column[2];  // what they feel: of A^-1, from `first` on
    long factors;             // work.factors that these and the flexibility are of
    const double *history;    // of the law
    double d_trial, v_trial;  // [L] [L/T] without corrections
    double flexibility;       // S_ll
    double seen;              // [L/T^2] difference of the corrections of its ends
    double slope;             // dF per difference of corrections
    double room, room_v;      // [L] [L/T] by how much d and v may move from where they were
    struct contact_response law;  // at the last Newton step
    double within;                // [F] what did not matter then
};

// What a sweep found.
struct progress {
    double change, largest;  // [F] largest change of a force that matters, and largest force
    double enough;           // [F] changes below this do not matter
};

// What does not change of link k.
void quick_init(struct quick *p, const struct model *m, int k);

// The rest for the live links of `next`.
void quick_gather(struct work *w, const struct state *next);

// Takes Newton steps on the live links of `next` from number `first` on, until one that is not
// safe; returns its number, or next->n_live.
int quick_sweep(struct work *w, struct state *next, int first, struct progress *progress);

#endif
