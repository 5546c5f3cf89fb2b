// SPDX-License-Identifier: GPL-3.0-or-later
// A cache of records, for studies that read the same records many times.
#ifndef JOSTLE_RECORD_CACHE_H
#define JOSTLE_RECORD_CACHE_H

#include "jostle/record.h"

struct record_cache;

// The size of the cache of a study.
enum { RECORD_CACHE_BYTES = 64 << 20 };

// A cache for records of up to `bytes_max` bytes together. All threads may use it. NULL: no memory.
struct record_cache *record_cache_create(size_t bytes_max);
void record_cache_free(struct record_cache *c);  // NULL is allowed

// Reads a record as record_read does, or takes it from the cache if the same request was read
// before. `out` has its own copy of the values from `a`. The function does not check whether the
// file has changed. c NULL: always reads the file.
int record_cache_read(struct record_cache *c, struct arena *a, const struct record_request *request,
                      struct record *out, struct error *e);

#endif
