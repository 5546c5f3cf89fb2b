// SPDX-License-Identifier: GPL-3.0-or-later
// Quick sweeps over the live links: Newton steps one link after the other, from data that stand
// side by side.
#ifndef JOSTLE_QUICK_H
#define JOSTLE_QUICK_H

#include "solve/work.h"

// One link.
struct quick {
    // What does not change,
    const struct link *link;
    int index;    // of the link
    bool smooth;  // its law is CONTACT_SMOOTH
    int end[2];   // among the arrays of struct chain

    // but with the factors,
    long factors;             // work.factors that these are of
    int first[2];             // of the floors that feel its force, at either end
    int lanes[2];             // how many they are, in whole lanes; 0 for a wall
    const double *column[2];  // what they feel: of A^-1, from `first` on
    double flexibility;       // S_ll
    double others;            // the sum of |S_lm| over all other links, as a share of S_ll, at most
    double fits_to;           // [L] penetration up to which steps are short enough for its spring
    double checked;           // [T] step with which its end was last resolved

    // what is gathered where it is live,
    const double *history;    // of the law
    double d_trial, v_trial;  // [L] [L/T] without corrections
    enum branch branch;       // that its force is on
    bool clamped;             // its law may pull, but is not let
    bool trusted;             // it is on the closed branch: a Newton step may start there
    bool open;                // its force is 0 as long as d <= 0
    double force;             // [F]
    double kept;              // [F] to step back to

    // and what the last evaluation of its law found.
    struct contact_response law;
    double seen;    // [L/T^2] difference of the corrections of its ends that its force belongs to
    double slope;   // t, dF per difference of corrections
    double damped;  // 1 / (1 + S_ll t)
    double room;    // [L/T^2] by how much that may still change until the law must be asked again;
                    // negative: it must be
};

// What a sweep found.
struct progress {
    double enough;   // [F] changes below this do not matter
    double loosest;  // [F] `enough` of the sweeps that links were settled in, at most
    double largest;  // [F] largest force
    double change;   // [F] largest change that matters of a force whose law must be asked again,
    double moved;    // [F] and of one that obeys its law but for what others do to it
    double echo;     // by how much the changes of others may still change one of those, as a
                     // share of the largest; of sweeps before too
    double clear;    // [F] changes of others up to this leave open links open
    bool answered;   // some link got its exact answer: echo knows nothing of it
};

// What does not change of link k.
void quick_init(struct quick *p, const struct model *m, int k);

// The rest for the live links of `next`, which act from then on.
void quick_gather(struct work *w, const struct state *next);

// Makes links ask their laws again where those have been settled while much more was enough.
void quick_tighten(struct work *w, struct progress *progress);

// Moves the ends of the link by what a change df of its force does to them.
void quick_push(const struct work *w, const struct quick *p, double df);

// Takes Newton steps on the acting links from number `first` on, until one that is not safe;
// returns its number, or w->n_acting.
int quick_sweep(struct work *w, int first, struct progress *progress);

#endif
