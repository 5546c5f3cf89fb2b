// SPDX-License-Identifier: GPL-3.0-or-later
// The pounding force spectrum after Jankowski (2006), Engineering Structures 28, 1149-1161: the
// largest contact force of two structures over the period of each, on several threads. The deck is
// read anew for every pair, with its params T1 and T2 overridden, so law, gap, record and all else
// are the deck's.
#ifndef JOSTLE_FORCE_MAP_H
#define JOSTLE_FORCE_MAP_H

#include "jostle/error.h"

// What is overridden for one pair of periods [s].
struct force_map_pair {
    char define[2][64];  // NAME=VALUE
};
void force_map_pair(struct force_map_pair *pair, double t1, double t2);

struct force_map_request {
    const char *path;           // of the deck
    const char *const *define;  // (n_define) NAME=VALUE besides T1 and T2
    int n_define;
    const double *period;  // (n_period) [s] of each structure
    int n_period;
    int n_thread;  // at least 1
    // Called every tenth of a second by the thread that called. A result other than 0
    // ends the map with that status.
    int (*poll)(void *context, long n_done, struct error *e);
    void *context;
};

// Fills force (n_period, n_period) [F], the first structure's period first; what it gives does not
// depend on the number of threads, to the last bit. Errors: of the first pair that fails, opened by
// its periods: STATUS_INPUT (the deck is wrong), STATUS_FAILED (the analysis); STATUS_SYSTEM; what
// `poll` returned.
int force_map_run(const struct force_map_request *q, double *force, struct error *e);

#endif
