// SPDX-License-Identifier: GPL-3.0-or-later
// Records that have been read lately, for studies that read the same ones again and again.
#ifndef JOSTLE_SHELF_H
#define JOSTLE_SHELF_H

#include "jostle/record.h"

struct shelf;

// What a study keeps of them.
enum { SHELF_BYTES = 64 << 20 };

// A shelf for records of `bytes_max` in all, that any number of threads may use; NULL: no memory.
struct shelf *shelf_create(size_t bytes_max);
void shelf_free(struct shelf *s);  // NULL is allowed

// record_read, from the shelf where the same request was read before; `out` has its own copy of the
// values from `a`. Whether the file is still the same is not looked at. s NULL: from the file.
int shelf_read(struct shelf *s, struct arena *a, const struct record_request *request,
               struct record *out, struct error *e);

#endif
