// SPDX-License-Identifier: GPL-3.0-or-later
// A cache of records, for studies that read the same records many times.
#ifndef JOSTLE_SHELF_H
#define JOSTLE_SHELF_H

#include "jostle/record.h"

struct shelf;

// The size of the cache of a study.
enum { SHELF_BYTES = 64 << 20 };

// A cache for records of up to `bytes_max` bytes together. All threads may use it. NULL: no memory.
struct shelf *shelf_create(size_t bytes_max);
void shelf_free(struct shelf *s);  // NULL is allowed

// Reads a record as record_read does, or takes it from the cache if the same request was read
// before. `out` has its own copy of the values from `a`. The function does not check whether the
// file has changed. s NULL: always reads the file.
int shelf_read(struct shelf *s, struct arena *a, const struct record_request *request,
               struct record *out, struct error *e);

#endif
