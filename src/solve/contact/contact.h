// SPDX-License-Identifier: GPL-3.0-or-later
// The links in a step: which act, and their forces at its end, with the buildings linear about
// their trial state.
#ifndef JOSTLE_CONTACT_H
#define JOSTLE_CONTACT_H

#include <math.h>
#include <stdalign.h>

#include "core/lanes.h"
#include "solve/work.h"

// Newton sweeps over the live links: a Newton step for one link after the other, on data that lie
// side by side in memory.

// The state of a link at the end of a step.
enum branch {
    BRANCH_OPEN,    // force 0
    BRANCH_CLOSED,  // force of the law, d > 0
    BRANCH_JUMP,    // d = 0, the force within the jump of the law at closure, or of a rigid contact
    BRANCH_NONE,  // neither open nor closed: the opening lies inside the step; *force is the jump's
};

// Links that are gathered, evaluated and visited together in the first sweep.
enum { SWEEP_GROUP = 16 };

// The tangent of a law, which Newton steps follow: a step from x = origin + dx changes the force by
// base + rate dx.
struct tangent {
    double base, rate;  // [F] [F T^2/L]
    double origin;      // [L/T^2] x where the law was evaluated
    double reach;       // [L/T^2] how far from there until it must be evaluated again
    double range;       // [L/T^2] how far a step may lead from there
    double damped;      // 1 / (1 + S_ll t)
};

// One link, in four lines of the cache. The first has what every visit of a sweep looks at. The
// second, from tangent.range on, has what a visit needs besides where it changes the force. The
// third has what evaluating the law needs, and the last one the rest.
struct link_scratch {
    alignas(LANES_LINE) int end[2];  // among the arrays of struct chain; -1: an end is a row
    enum branch branch;              // that its force is on
    bool stale;                      // the law must be evaluated again, if it is trusted
    bool trusted;                    // on the closed branch, where a Newton step may start
    bool open;                       // its force is 0 as long as d <= 0
    bool clamped;                    // its law may pull, but is not allowed to
    double force;                    // [F]
    double per_coupling;             // 1 / the most that |S_lm| of all other links may add up to
    struct tangent tangent;

    double flexibility;       // S_ll
    double coupling;          // the sum of |S_lm| of all other links as a share of that, at most
    const double *column[2];  // at either end the column of A^-1,
    int first[2];             // from this floor on,
    int lanes[2];             // over so many floors, in whole lanes; 0 for a wall

    double d_trial, v_trial;        // [L] [L/T] without corrections
    double dfdd;                    // [F/L] of the law when it was last evaluated
    const struct contact_law *law;  // borrowed, as are the next two
    const double *constant;         // of the law
    const double *history;          // of the law, at the start of the step
    double dfdv;                    // [F T/L] as dfdd
    double gap;                     // [L]

    long factors;               // work.factors that flexibility and columns are of
    double kept;                // [F] to step back to
    double v_rest;              // [L/T] at the end of the step, of a rigid contact at rest
    struct resolved *resolved;  // borrowed, as is the next
    const struct link *link;
    double *combined[2];  // (lanes) column of an end that is a row; NULL: it is a floor
    int index;            // of the link
    bool bilateral;
    bool moving_ground;
};

// What a sweep found.
struct progress {
    double tolerance;      // [F] changes below this do not matter
    double law_tolerance;  // [F] the largest tolerance at which a law was evaluated
    double largest;        // [F] largest force
    double moved[2];  // [F] by enum knowledge of sweep_step.h, the largest changes that matter: of
                      // forces on their tangents, and of those whose law must be evaluated again
    double feedback;  // the largest change of a force on its tangent that the changes of others
                      // may cause, at most, as a share of the largest of those; of all sweeps
    double margin;    // [F] changes of others up to this leave open links open, and the others
                      // within the reach of their tangents
    bool some_exact;  // a force was solved for exactly: feedback does not know of it
};

// The difference of x, an array (n_dof), between both ends of a link, and the sum of its sizes.
static inline double sweep_across(const struct link_scratch *p, const double *x) {
    return p->end[0] >= 0 ? x[p->end[0]] - x[p->end[1]] : link_across(p->link, x);
}

static inline double sweep_size(const struct link_scratch *p, const double *x) {
    return p->end[0] >= 0 ? fabs(x[p->end[0]]) + fabs(x[p->end[1]]) : link_size(p->link, x);
}

// What sweep_step.h asks for with one lane.
LANES_INLINE void sweep_see(const struct work *w, const struct link_scratch *p, double *x) {
    *x = sweep_across(p, w->correction);
}

LANES_INLINE void sweep_law(const struct link_scratch *p, const double *d, const double *v,
                            struct contact_response *law) {
    *law = p->law->force(p->constant, p->history, *d, *v);
}

LANES_INLINE void sweep_sizes(const struct work *w, const struct link_scratch *p, double *u,
                              double *v, double *q) {
    *u = sweep_size(p, w->u_trial) + p->gap;
    *v = sweep_size(p, w->v_trial);
    *q = sweep_size(p, w->correction);
}

// Beyond the floors of the building the column is 0.
LANES_INLINE void sweep_push(const struct work *w, const struct link_scratch *p, const double *df) {
    for (int side = 0; side < 2; side++) {
        const double f = side == 0 ? -*df : *df;
        const double *restrict column = p->column[side];
        double *restrict q = w->correction + p->first[side];
        for (int i = 0, n = p->lanes[side]; i != n; i += LANES_WIDTH) {
            const lanes low = *(const lanes *)(q + i) + f * *(const lanes *)(column + i);
            const lanes high = *(const lanes *)(q + i + LANES_VECTOR) +
                               f * *(const lanes *)(column + i + LANES_VECTOR);
            *(lanes *)(q + i) = low;
            *(lanes *)(q + i + LANES_VECTOR) = high;
        }
    }
}

// What does not change of link k; false: no memory.
bool sweep_init(struct link_scratch *p, const struct model *m, int k, struct arena *a);

// Makes the live links of `next` the acting ones; *progress is that of the guess.
void sweep_begin(struct work *w, const struct state *next, struct progress *progress);

// Finds how the floors of its buildings respond to the force of a link.
void sweep_find_columns(const struct work *w, struct link_scratch *p);

// Finds d and v of a link without corrections, and its columns unless they are those of the last
// step.
void sweep_prepare(struct work *w, const struct state *next, struct link_scratch *p);

// Gathers what changes from step to step of acting links `first` to end - 1, and evaluates their
// laws.
void sweep_gather(struct work *w, const struct state *next, int first, int end,
                  struct progress *progress);

// Evaluates all laws again if the tolerance has become much tighter.
void sweep_evaluate_again(struct work *w, struct progress *progress);

// Takes Newton steps on acting links `first` to end - 1, until one that is not safe; returns its
// number, or `end`.
int sweep_newton(struct work *w, int first, int end, struct progress *progress);

// The exact force of one link while those of all others are held. Under Newmark its penetration and
// velocity at the end of a step are straight lines over its own force, which leaves one equation in
// one unknown.

// d = d_free - d_force f and v = v_free - v_force f.
struct equation {
    const struct link *link;
    const double *history;      // of the link, at the start of the step or at its closure
    double d_free, v_free;      // [L] [L/T] if its force were zero
    double d_force, v_force;    // [L/F] [L/T/F] both >= 0
    double v_rest, v_rounding;  // [L/T] of a rigid contact: the velocity it must end with, and
                                // the rounding error of that
    bool closed;                // in contact at the start of the step
    bool clamped;               // its law may pull, but is not allowed to
    bool held;                  // stays closed whatever d is: the step ends where it opens
};

// The equation of link k at the trial state of `next`.
struct equation exact_equation(const struct work *w, const struct state *now,
                               const struct state *next, int k);

// The force of the link. A closed link stays closed as long as a closed solution exists; an open
// one stays open as long as an open one does. `guess` starts the search. Cannot fail: where the law
// is not monotone (it pulls) the solution found from the guess is taken.
enum branch exact_force(const struct equation *e, double guess, double *force);

// By how much `force` exceeds the force that would have to move the link for its law to give just
// `force` there.
double exact_excess(const struct equation *e, double force);

// The force of the law and its tangents at the state that `force` leads to, and the slope of the
// law over the force, with its sign changed.
struct contact_response exact_law(const struct equation *e, double force);
static inline double exact_slope(const struct equation *e, const struct contact_response *law) {
    return e->d_force * law->dfdd + e->v_force * law->dfdv;
}

// Gives link k its exact force; returns the change of it.
double exact_solve(struct work *w, const struct state *now, struct state *next, int k);

// The same in a sweep, with what that records. Newton steps may follow where the law leaves no
// choice of branch.
void exact_visit(struct work *w, const struct state *now, struct state *next,
                 struct link_scratch *p, struct progress *progress);

// Which links act (contact_step.c), and the forces of all of them together (contact.c).

// Makes the links that are closed in `now` live in `next`, with a guess of their forces; the others
// are open.
void contact_begin(struct work *w, const struct state *now, struct state *next);

// Makes those links live that close on the way to the penetrations of `next`; returns how many.
int contact_search(struct work *w, const struct state *now, struct state *next);

// The same for link k; returns whether it closes.
bool contact_close(struct work *w, const struct state *now, struct state *next, int k);

// On entry w->correction solves the buildings' equations under the link forces next->force; on
// return both are changed so that the force of every live link also obeys its law. `now` is the
// committed state. STATUS_RETRY: not solved to the model's tolerance.
int contact_solve(struct work *w, const struct state *now, struct state *next);

// Brings the histories of closed links to the end of a step that is solved.
void contact_finish(const struct work *w, struct state *next);

// In cluster.c:

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
