// SPDX-License-Identifier: GPL-3.0-or-later
// Random parameters in a study file: values along the scale of their sample.
#ifndef JOSTLE_STUDY_SAMPLES_H
#define JOSTLE_STUDY_SAMPLES_H

#include "result/study_writer.h"

// Attribute of the scale of a sample: the names of the parameters along it, with blanks between.
#define STUDY_SAMPLES_NAMES "sampled"

// Writes the names of all random parameters along the `n` sweeps as a text attribute of `object`;
// none if there are none. As "coordinates" of a group it tells xarray that they are no results.
void study_samples_name(struct h5 *h, hid_t object, const struct sweep *const *sweep, int n,
                        const char *attribute);

// Writes the dimension of the values, if it is known, so that a file can be made of this one.
void study_samples_put_dimension(struct h5 *h, hid_t values, const struct sweep *s);
void study_samples_get_dimension(struct h5 *h, hid_t values, struct sweep *s);

// Links the values along `s` from /sweep into a group.
void study_samples_link(struct study_writer *w, hid_t group, const struct sweep *s);

// Whether one of the `n` sweeps, or a random parameter along it, has this name.
bool study_samples_has(const struct sweep *const *sweep, int n, const char *name);

// Reads the random values along the sweep `s` whose scale this is in `group`.
void study_samples_get(struct h5 *h, struct arena *a, hid_t group, hid_t scale, struct sweep *s);

#endif
