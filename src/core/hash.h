// SPDX-License-Identifier: GPL-3.0-or-later
// A hash for tables of names and for seeds. Checksums of contents are in core/checksum.h.
#ifndef JOSTLE_HASH_H
#define JOSTLE_HASH_H

#include <stddef.h>
#include <stdint.h>

static const uint64_t hash_start = UINT64_C(14695981039346656037);

// Continues `hash` with `n` more bytes: FNV-1a of 64 bits (Fowler, Noll, Vo). It is fast for names.
// Seeds of random sweeps depend on it, too.
uint64_t hash_add(uint64_t hash, const void *data, size_t n);

#endif
