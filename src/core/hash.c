// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/hash.h"

uint64_t hash_add(uint64_t hash, const void *data, size_t n) {
    static const uint64_t prime = UINT64_C(1099511628211);
    const unsigned char *byte = data;
    for (size_t i = 0; i < n; i++) {
        hash = (hash ^ byte[i]) * prime;
    }
    return hash;
}
