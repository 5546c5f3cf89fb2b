// SPDX-License-Identifier: GPL-3.0-or-later
// Parameters that go together in a study file: values along the scale of their dimension.
#ifndef JOSTLE_STUDY_ALONG_H
#define JOSTLE_STUDY_ALONG_H

#include "result/study_writer.h"

// Writes the names of all parameters along the `n` sweeps, with blanks between, as the attribute
// "coordinates" of a group, which tells xarray that they are no results; none if there are none.
void study_along_put_coordinates(struct h5 *h, hid_t group, const struct sweep *const *sweep,
                                 int n);

// Writes which parameters are along `s` as attributes of its scale: "together" names all of them
// where they are not all random, "sampled" those that are.
void study_along_put_names(struct h5 *h, hid_t scale, const struct sweep *s);

// Reads the values along the sweep `s` whose scale this is in `group`.
void study_along_get(struct h5 *h, struct arena *a, hid_t group, hid_t scale, struct sweep *s);

// Writes the dimension of the values, if it is known, so that a file can be made of this one.
void study_along_put_dimension(struct h5 *h, hid_t values, const struct sweep *s);
void study_along_get_dimension(struct h5 *h, hid_t values, struct sweep *s);

// Links the values along `s` from /sweep into a group.
void study_along_link(struct study_writer *w, hid_t group, const struct sweep *s);

// Whether one of the `n` sweeps, or a parameter along it, has this name.
bool study_along_has(const struct sweep *const *sweep, int n, const char *name);

#endif
