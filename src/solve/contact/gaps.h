// SPDX-License-Identifier: GPL-3.0-or-later
// Penetrations of all links, a run of neighbouring links at a time.
#ifndef JOSTLE_GAPS_H
#define JOSTLE_GAPS_H

#include <math.h>

#include "core/number.h"
#include "solve/state.h"

// Links first to first + n - 1. On each side their ends are floors of one building, one above the
// other, or a wall. A link with an end that is a row is a run by itself.
struct gap_run {
    int first, n;
    int left, right;         // ends of link `first` among the arrays of struct chain
    int building[2];         // WALL
    int ground[2];           // under its ends; equal where the grounds do not move them apart
    int gap;                 // where its gaps are among those of all runs
    const struct link *row;  // borrowed: the link with a row; NULL: all ends are floors
};

struct gaps {
    const struct model *model;  // borrowed
    double *gap;                // [L] of each run in whole lanes, infinite where it has no link
    double *limit;  // [L] (n_link) a link beyond this may close or is nearer than ever: infinite
                    // for links that act, else 0 or its largest penetration, the lesser
    double *nearest, *time;  // borrowed: results.deepest, results.deepest_time
    int n_run;
    struct gap_run *run;
    int *run_of;               // (n_link)
    bool *beyond;              // (n_run) one of its links was beyond its limit when last updated
    int *start, *of_building;  // (n_building + 1): runs at each building, one list behind another
    int n_pressed, *pressed;   // runs in which a link that does not act had d > 0 then
    int n_acting, *acting;     // links that act in this step
    bool *acts;                // (n_run) one of them is in the run
    int n_touched, *touched;   // their buildings
    bool *is_touched;          // (n_building)
};

// Room for the links of a model, and their runs; their largest penetrations are in `r`. False: no
// memory.
bool gaps_alloc(struct gaps *g, const struct model *m, const struct results *r, struct arena *a);

// Starts with what is in the results: no link acts.
void gaps_resume(struct gaps *g);

// Brings s->delta to the displacements of `s`, at the buildings that have `moved`; NULL: at all.
void gaps_update(struct gaps *g, struct state *s, const bool *moved);

// Records penetrations that are larger than ever.
void gaps_peaks(struct gaps *g, const struct state *s);

// The same of link k with penetration d.
static inline void gaps_note(struct gaps *g, int k, double d, double time) {
    if (d > g->nearest[k]) {
        g->nearest[k] = d;
        g->time[k] = time;
        g->limit[k] = g->limit[k] > 0.0 ? g->limit[k] : number_min(d, 0.0);
    }
}

// No link acts, and no building is touched any more.
void gaps_forget(struct gaps *g);

// Makes link k act and touch its buildings.
static inline void gaps_touch(struct gaps *g, int k) {
    const int run = g->run_of[k];
    for (int i = 0; i < 2 && !g->acts[run]; i++) {
        int b = g->run[run].building[i];
        if (b != WALL && !g->is_touched[b]) {
            g->is_touched[b] = true;
            g->touched[g->n_touched++] = b;
        }
    }
    g->acts[run] = true;
    g->acting[g->n_acting++] = k;
    g->limit[k] = INFINITY;
}

#endif
