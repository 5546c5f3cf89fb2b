// SPDX-License-Identifier: GPL-3.0-or-later
// A result file while it is being made: what writers of all kinds check first.
#ifndef JOSTLE_PART_H
#define JOSTLE_PART_H

#include "jostle/result.h"
#include "result/h5.h"

// Can a result of `r` be written under this name? Errors: STATUS_INPUT (the file exists, a name of
// a building that cannot stand in the file).
int part_check(const struct report *r, const struct result_options *o, struct error *e);

// Makes sure that the file `part` of the result `path` is ours and empty: one left by a killed run
// is removed, one that another run is writing (the library holds a lock on it) is left alone.
// Errors: STATUS_SYSTEM.
int part_claim(const char *path, const char *part, struct error *e);

// What every result says of itself at its root; its status is "running".
void part_attributes(struct h5 *h, hid_t root, const struct report *r);

#endif
