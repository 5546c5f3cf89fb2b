// SPDX-License-Identifier: GPL-3.0-or-later
// A result file while it is being made: what writers of all kinds check first.
#ifndef JOSTLE_PART_H
#define JOSTLE_PART_H

#include "jostle/result.h"
#include "result/h5.h"

// Can a result of `r` be written under this name? Errors: STATUS_INPUT (the file exists, a name of
// a building that the file cannot have).
int part_check(const struct report *r, const struct result_options *o, struct error *e);

// Creates the file `part` of the result `path`, locked until h5_unlock: one left by a killed run is
// removed, one that another run is writing is left alone. Errors: STATUS_SYSTEM; h->file is
// negative if there is no file of ours.
int part_create(struct h5 *h, const char *path, const char *part, struct error *e);

// What every result says of itself at its root; its status is "running".
void part_attributes(struct h5 *h, hid_t root, const struct report *r);

#endif
