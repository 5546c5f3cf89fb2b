// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef JOSTLE_STUDY_BOX_H
#define JOSTLE_STUDY_BOX_H

#include "jostle/deck.h"
#include "result/h5.h"

// The box over the `n` sweeps that starts at run `first` and holds at most `capacity` >= 1 runs
// that follow one another: start, count and n are set.
struct h5_block study_box(const struct sweep *const *sweep, int n, long first, long capacity);

#endif
