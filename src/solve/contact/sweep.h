// SPDX-License-Identifier: GPL-3.0-or-later
// Newton sweeps over the live links: a Newton step for one link after the other, on data that lie
// side by side in memory.
#ifndef JOSTLE_SWEEP_H
#define JOSTLE_SWEEP_H

#include <stdalign.h>

#include "core/lanes.h"
#include "solve/work.h"

// Links that are gathered, asked and visited together in the first sweep.
enum { SWEEP_GROUP = 16 };

// A law for Newton steps: with the correction x = asked it was asked, and a step from asked + dx
// changes the force by base + rate dx.
struct tangent {
    double base, rate;  // [F] [F T^2/L]
    double asked;       // [L/T^2] difference of the corrections of the link's ends
    double reach;       // [L/T^2] how far from there until the law must be asked again
    double near;        // [L/T^2] how far a step may lead from there
    double damped;      // 1 / (1 + S_ll t)
};

// One link, in four lines of the cache: what every visit of a sweep looks at, what a step needs
// too, which is from tangent.near on, what asking the law needs, and the rest.
struct link_scratch {
    alignas(LANES_LINE) int end[2];  // among the arrays of struct chain; -1: an end is a row
    enum branch branch;              // that its force is on
    bool ask;                        // the law must be asked again, if it is trusted
    bool trusted;                    // on the closed branch, where a Newton step may start
    bool open;                       // its force is 0 as long as d <= 0
    bool clamped;                    // its law may pull, but is not allowed to
    double force;                    // [F]
    double unmoved;                  // 1 / the most that |S_lm| of all other links may add up to
    struct tangent tangent;

    double flexibility;       // S_ll
    double others;            // the sum of |S_lm| as a share of that, at most
    const double *column[2];  // at either end the column of A^-1,
    int first[2];             // from this floor on,
    int lanes[2];             // over so many floors, in whole lanes; 0 for a wall

    double d_trial, v_trial;         // [L] [L/T] without corrections
    double dfdd;                     // [F/L] of the law when it was last asked
    const struct contact_law *kind;  // its law,
    const double *constant;          // with these constants
    const double *history;           // and this history
    double dfdv;                     // [F T/L] as dfdd
    double gap;                      // [L]

    long factors;               // work.factors that flexibility and columns are of
    double kept;                // [F] to step back to
    double v_rest;              // [L/T] at the end of the step, of a rigid contact at rest
    struct resolved *resolved;  // borrowed, as is the next
    const struct link *link;
    double *combined;  // (2, lanes) columns of ends that are rows; NULL: all are floors
    int index;         // of the link
    bool bilateral;
    bool moving_ground;
};

// Whether the law of a link must be asked again.
enum knowledge { LAW_KNOWN, LAW_UNKNOWN };

// What a sweep found.
struct progress {
    double enough;    // [F] changes below this do not matter
    double loosest;   // [F] the most that was enough when a law was asked
    double largest;   // [F] largest force
    double moved[2];  // [F] largest change that matters of a force that obeys its law but for what
                      // others do to it, and of one whose law must be asked again: enum knowledge
    double echo;      // by how much the changes of others may still change one of those, as a
                      // share of the largest; of sweeps before too
    double clear;   // [F] changes of others up to this leave open links open, and the others within
                    // the reach of their tangents
    bool answered;  // some link got its exact answer: echo knows nothing of it
};

// The difference of x, an array (n_dof), between both ends of a link, one of which is a row. Not in
// line: the loops over links of floors stay small.
double sweep_across_rows(const struct link_scratch *p, const double *x);

// The same of any link.
static inline double sweep_across(const struct link_scratch *p, const double *x) {
    return p->end[0] >= 0 ? x[p->end[0]] - x[p->end[1]] : sweep_across_rows(p, x);
}

// What does not change of link k; false: no memory.
bool sweep_init(struct link_scratch *p, const struct model *m, int k, struct arena *a);

// Makes the live links of `next` the acting ones; *progress is that of the guess.
void sweep_begin(struct work *w, const struct state *next, struct progress *progress);

// Gathers what changes from step to step of acting links `first` to end - 1, and asks their laws.
void sweep_gather(struct work *w, const struct state *next, int first, int end,
                  struct progress *progress);

// Asks all laws again if `enough` has become much smaller.
void sweep_ask_again(struct work *w, struct progress *progress);

// Adds the effect of a change df of the link's force to the corrections.
void sweep_push(const struct work *w, const struct link_scratch *p, double df);

// Takes Newton steps on acting links `first` to end - 1, until one that is not safe; returns its
// number, or `end`.
int sweep_newton(struct work *w, int first, int end, struct progress *progress);

#endif
