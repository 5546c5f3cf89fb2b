// SPDX-License-Identifier: GPL-3.0-or-later
// The largest values over all computed steps, and their times.
#ifndef JOSTLE_PEAKS_H
#define JOSTLE_PEAKS_H

#include <math.h>

#include "solve/state.h"

// Room for the results of a model; false: no memory.
bool peaks_alloc(struct results *r, const struct model *m, struct arena *a);

// Takes state `s` into the envelopes of floors and contacts.
void peaks_update(struct results *r, const struct model *m, const struct state *s);

// The same of floors only.
void peaks_floors(struct results *r, const struct model *m, const struct state *s);

// Raises a peak, and its time, to |x| where that is greater.
static inline void peak_raise(double x, double time, double *peak, double *peak_time) {
    double size = fabs(x);
    *peak_time = size > *peak ? time : *peak_time;
    *peak = size > *peak ? size : *peak;
}

// Raises the largest velocity of any floor so far to the peaks of n floors from `first` on.
void peaks_speed(struct results *r, int first, int n);

// What counts of a force or penetration x of link k: of a bilateral one its size.
static inline double peaks_size(const struct model *m, int k, double x) {
    return k >= m->n_contact ? fabs(x) : x;
}

// Raise the largest penetration and the largest force of link k.
static inline void peaks_penetration(struct results *r, int k, double delta, double time) {
    if (delta > r->deepest[k]) {
        r->deepest[k] = r->link[k].penetration = delta;
        r->link[k].penetration_time = time;
    }
}

static inline void peaks_force(struct results *r, int k, double force, double time) {
    if (force > r->link[k].force) {
        r->link[k].force = force;
        r->link[k].force_time = time;
    }
}

// The same from state `s`, of a live link.
static inline void peaks_link(struct results *r, const struct model *m, const struct state *s,
                              int k) {
    peaks_force(r, k, peaks_size(m, k, s->link[k].force), s->time);
    peaks_penetration(r, k, peaks_size(m, k, s->delta[k]), s->time);
}

#endif
