// SPDX-License-Identifier: GPL-3.0-or-later
// The checksums of what a result file says: SHA-256 over the names, types, shapes and values of all
// datasets and attributes in the order of their names. They do not depend on where and how the file
// stores its values: chunks, compression and unused space do not count, and references between
// objects count by the objects that they refer to. Memory does not grow with the values, but by 16
// to 32 bytes for each object.
#ifndef JOSTLE_SEAL_H
#define JOSTLE_SEAL_H

#include "jostle/result.h"
#include "result/h5.h"

// Writes the checksum of the file, which is otherwise complete, into its attribute.
void seal_put(struct h5 *h);

// Computes the checksums of the open file `path`, and compares that of the data with the attribute.
// Errors: STATUS_FAILED (the data differ), STATUS_INPUT (they cannot be read, or there is no
// checksum), STATUS_SYSTEM (no memory); they name the path.
int seal_check(struct h5 *h, const char *path, struct result_sums *out, struct error *e);

#endif
