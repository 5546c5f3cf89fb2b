// SPDX-License-Identifier: GPL-3.0-or-later
// The sweeps of a study in its file. The values of a sweep are a scale, and those of parameters
// that go together along it are datasets over that scale.
#ifndef JOSTLE_STUDY_SWEEP_H
#define JOSTLE_STUDY_SWEEP_H

#include "jostle/deck.h"
#include "result/h5.h"

// Whether one of the `n` sweeps, or a parameter along it, has this name.
bool study_sweep_has(const struct sweep *const *sweep, int n, const char *name);

// The box over the `n` sweeps that starts at run `first` and holds at most `most` >= 1 runs that
// follow one another.
struct h5_box study_sweep_box(const struct sweep *const *sweep, int n, long first, long most);

// Writes the values of a sweep, and those along it, into a group. The scale stays open.
hid_t study_sweep_put(struct h5 *h, hid_t group, const struct sweep *s);

// Links the scales of the `n` sweeps, and the values along them from /sweep, into a group. An
// attribute "coordinates" names the latter for xarray, as they are no results.
void study_sweep_link(struct h5 *h, hid_t group, const struct sweep *const *sweep,
                      const hid_t *scale, int n);

// The dimension of the values, if it is known, so that a file can be made of this one.
void study_sweep_put_dimension(struct h5 *h, hid_t values, const struct sweep *s);
void study_sweep_get_dimension(struct h5 *h, hid_t values, struct sweep *s);

// The sweep in the dataset `name` of a group, which is open as `scale`, and what goes together
// along it. NULL after a failure.
struct sweep *study_sweep_get(struct h5 *h, struct arena *a, hid_t group, hid_t scale,
                              const char *name);

#endif
