// SPDX-License-Identifier: GPL-3.0-or-later
// Quick sweeps over the live links: Newton steps one link after the other, from data that stand
// side by side.
#ifndef JOSTLE_QUICK_H
#define JOSTLE_QUICK_H

#include "solve/work.h"

// One live link within a contact solve.
struct quick {
    const struct link *link;
    const double *history;
    int index;                   // of the link
    bool trusted;                // its force is on the closed branch: a Newton step may start there
    bool smooth;                 // its law is CONTACT_SMOOTH
    bool settled;                // its force obeyed the law when it saw `seen`
    bool open;                   // its force is 0 as long as d <= 0
    int end[2];                  // of the link among the arrays of struct chain
    int lanes[2];                // floors of the building at either end, in whole lanes; wall: 0
    double *correction[2];       // [L/T^2] of those floors
    const double *column[2];     // of A^-1 for the floors of the link
    double d_trial, v_trial;     // [L] [L/T] without corrections
    double flexibility;          // S_ll
    double seen;                 // [L/T^2] difference of the corrections
    double room, room_v;         // [L/T^2] by how much it may change where d and v were then
    double slope;                // dF per difference of corrections
    struct contact_response law;  // at the last Newton step
};

// What a sweep found.
struct progress {
    double change, largest;  // [F] largest change of a force that matters, and largest force
    double enough;           // [F] changes below this do not matter
};

// Gathers the live links of `next` into w->quick.
void quick_gather(struct work *w, const struct state *next);

// Takes Newton steps from link `first` of w->quick on, until one that is not safe; returns its
// index, or how many links there are.
int quick_sweep(struct work *w, struct state *next, int first, struct progress *progress);

#endif
