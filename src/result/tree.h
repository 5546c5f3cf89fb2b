// SPDX-License-Identifier: GPL-3.0-or-later
// Groups of the tree that files of runs and of studies share.
#ifndef JOSTLE_TREE_H
#define JOSTLE_TREE_H

#include "jostle/deck.h"
#include "jostle/result.h"
#include "result/h5.h"

// What the values of a tree are over: those of a run over time, those of a study over its sweeps.
struct tree {
    struct h5 *h;
    hid_t time;  // the scale of all histories of a run
    int n_sweep;
    const struct sweep *sweep[STUDY_SWEEPS_MAX];
    hid_t scale[STUDY_SWEEPS_MAX];  // of each sweep
};

// An open group, and the scale 1, 2, ... of its values in it.
struct tree_group {
    hid_t group, scale;
    const char *name;  // of the scale
};

// Creates a group of the layout in the file or group `root`; buildings get their attributes. The
// time or the sweeps are linked into it, so that a group opened alone (as xarray does) shows its
// coordinates.
struct tree_group tree_group(const struct tree *t, hid_t root, const struct layout_group *g);

// Creates the group "envelope" in it with the same scale and the sweeps; open.
hid_t tree_envelope(const struct tree *t, const struct tree_group *g);
void tree_close(const struct tree *t, const struct tree_group *g);

#endif
