// SPDX-License-Identifier: GPL-3.0-or-later
// A result file while it is being made: what writers of all kinds check first.
#ifndef JOSTLE_H5_PARTIAL_H
#define JOSTLE_H5_PARTIAL_H

#include "jostle/result.h"
#include "result/h5.h"

// Can a result of `r` be written under this name? Errors: STATUS_INPUT (the file exists, its ending
// is that of another kind of file, a name of a building that the file cannot have).
int h5_partial_check(const struct report *r, const struct result_options *o, struct error *e);

// Creates the file `partial` of the result `path`, locked until h5_unlock: one left by a killed run
// is removed, one that another run is writing is left alone. Errors: STATUS_SYSTEM; h->file is
// negative if there is no file of ours.
int h5_partial_create(struct h5 *h, const char *path, const char *partial, struct error *e);

// What every result says of itself at its root; its status is "running".
void h5_partial_attributes(struct h5 *h, hid_t root, const struct report *r, int numerics);

#endif
