// SPDX-License-Identifier: GPL-3.0-or-later
// FNV-1a of 64 bits (Fowler, Noll, Vo): tells texts apart and finds damage. A single changed byte
// always changes it, as each step is a bijection; other changes slip through once in 2^64.
#ifndef JOSTLE_CHECKSUM_H
#define JOSTLE_CHECKSUM_H

#include <stddef.h>
#include <stdint.h>

#include "jostle/error.h"

static const uint64_t checksum_start = UINT64_C(14695981039346656037);

// The checksum of what `sum` is of, followed by the `n` bytes at `data`.
uint64_t checksum_add(uint64_t sum, const void *data, size_t n);

// The same for long data, in less time: words instead of bytes, and four sums side by side, as each
// product waits for the one before. Another number, which depends on the order of the bytes in a
// word, and on how the data is cut.
uint64_t checksum_many(uint64_t sum, const void *data, size_t n);

// checksum_many of a file. Errors: STATUS_INPUT (does not exist), STATUS_SYSTEM; they name the
// path.
int checksum_file(const char *path, uint64_t *sum, struct error *e);

#endif
