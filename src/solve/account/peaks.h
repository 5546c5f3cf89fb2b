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

// Raises the largest penetration of contact k.
static inline void peaks_penetration(struct results *r, int k, double delta, double time) {
    if (delta > r->deepest[k]) {
        r->deepest[k] = r->link[k].penetration = delta;
        r->link[k].penetration_time = time;
    }
}

// Raises the largest force and penetration of live link k.
static inline void peaks_link(struct results *r, const struct model *m, const struct state *s,
                              int k) {
    struct link_peak *p = &r->link[k];
    bool both = k >= m->n_contact;
    double force = both ? fabs(s->link[k].force) : s->link[k].force;
    if (force > p->force) {
        p->force = force;
        p->force_time = s->time;
    }
    if (!both) {
        peaks_penetration(r, k, s->delta[k], s->time);
    } else if (fabs(s->delta[k]) > p->penetration) {
        p->penetration = fabs(s->delta[k]);
        p->penetration_time = s->time;
    }
}

#endif
