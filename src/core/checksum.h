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

// A checksum of a file, of words and so not that of its bytes. Errors: STATUS_INPUT (does not exist), STATUS_SYSTEM; they name the path.
int checksum_file(const char *path, uint64_t *sum, struct error *e);

#endif
