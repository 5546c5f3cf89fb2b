// SPDX-License-Identifier: GPL-3.0-or-later
// The largest values over all computed steps, and their times; and the drifts that remain.
#ifndef JOSTLE_PEAKS_H
#define JOSTLE_PEAKS_H

#include <math.h>

#include "solve/state.h"

// What results hold while they grow, but for the list of impacts.
extern const struct fields results_fields;

// Room for the results of a model; false: no memory.
bool peaks_alloc(struct results *r, const struct model *m, struct arena *a);

// Gives links their largest penetrations, at the end of a run.
void peaks_finish(struct results *r, const struct model *m);

// In residual_drift.c: the size of the residual drift [L] of each storey (n_dof): where its law has
// no shear when the storey unloads from state `s`; 0 of elastic ones. NAN: the law does not unload
// to zero. False: no memory.
bool residual_drifts(const struct model *m, const struct state *s, double *out);

// The same for bilateral links: what they have lost, and their residual deformations.
void residual_links(const struct model *m, const struct state *s, struct link_peak *link);

// Takes state `s` into the envelopes of floors and contacts.
void peaks_update(struct results *r, const struct model *m, const struct state *s);

// Takes storey deformations and shears of buildings with a foundation from state `s`.
void peaks_founded(struct results *r, const struct model *m, const struct state *s);

// Takes the forces in struck columns of state `s`.
void peaks_columns(struct results *r, const struct model *m, const struct state *s);

// Takes the drift rates of state `s`.
void peaks_drift_rates(struct results *r, const struct model *m, const struct state *s);

// Raises a peak, and its time, to x where that is greater; lowers it where that is less.
static inline void peak_larger(double x, double time, double *peak, double *peak_time) {
    *peak_time = x > *peak ? time : *peak_time;
    *peak = x > *peak ? x : *peak;
}

static inline void peak_smaller(double x, double time, double *peak, double *peak_time) {
    *peak_time = x < *peak ? time : *peak_time;
    *peak = x < *peak ? x : *peak;
}

// What counts of a force or penetration x of link k: of a bilateral one its size.
static inline double peaks_size(const struct model *m, int k, double x) {
    return k >= m->n_contact ? fabs(x) : x;
}

// Raise the largest penetration and the largest force of link k.
static inline void peaks_penetration(struct results *r, int k, double delta, double time) {
    peak_larger(delta, time, &r->deepest[k], &r->deepest_time[k]);
}

static inline void peaks_force(struct results *r, int k, double force, double time) {
    peak_larger(force, time, &r->link[k].force, &r->link[k].force_time);
}

// Take a value of a force in a struck column, and of force i of those that follow from drifts.
static inline void peaks_column(struct column_peak *p, double x, double time) {
    peak_larger(x, time, &p->max, &p->max_time);
    peak_smaller(x, time, &p->min, &p->min_time);
}

static inline void peaks_member(struct results *r, int i, double x, double time) {
    if (x > r->force_max[i]) {  // seldom, so that branches are faster than choices
        peak_larger(x, time, &r->force_max[i], &r->force_max_time[i]);
    }
    if (x < r->force_min[i]) {
        peak_smaller(x, time, &r->force_min[i], &r->force_min_time[i]);
    }
}

// Takes the deformation or the shear of storey i with a foundation: PEAK_DRIFT or PEAK_SHEAR.
static inline void peaks_storey(struct results *r, enum peak q, int i, double x, double time) {
    const int k = q == PEAK_SHEAR;
    peak_larger(fabs(x), time, &r->founded_peak[k][i], &r->founded_time[k][i]);
}

// The same from state `s`, of a live link.
static inline void peaks_link(struct results *r, const struct model *m, const struct state *s,
                              int k) {
    peaks_force(r, k, peaks_size(m, k, s->link[k].force), s->time);
    peaks_penetration(r, k, peaks_size(m, k, s->delta[k]), s->time);
}

#endif
