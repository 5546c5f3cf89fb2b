// SPDX-License-Identifier: GPL-3.0-or-later
// SHA-256 (FIPS 180-4), by Nettle: identifies contents and detects damage.
#ifndef JOSTLE_CHECKSUM_H
#define JOSTLE_CHECKSUM_H

#include <nettle/sha2.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "jostle/checksum.h"
#include "jostle/error.h"

// The checksum of bytes that are added piece by piece.
struct checksum_sum {
    struct sha256_ctx sha;
};
void checksum_start(struct checksum_sum *s);
void checksum_add(struct checksum_sum *s, const void *data, size_t n);
// Adds a text with its final 0, so that two texts differ from their concatenation.
void checksum_add_text(struct checksum_sum *s, const char *text);
// Adds a number as 8 bytes, the lowest first on all machines.
void checksum_add_number(struct checksum_sum *s, uint64_t number);
// Writes the checksum and starts `s` again.
void checksum_end(struct checksum_sum *s, struct checksum *out);

// The same as bytes.
void checksum_end_bytes(struct checksum_sum *s, unsigned char out[SHA256_DIGEST_SIZE]);

// The first 8 bytes of the checksum of `n` bytes, for entries that are checked one by one. Other
// bytes have an equal value with probability 2^-64.
uint64_t checksum_short(const void *data, size_t n);

// The checksum of a file. Errors: STATUS_INPUT (does not exist), STATUS_SYSTEM; they name the path.
int checksum_file(const char *path, struct checksum *out, struct error *e);

bool checksum_equal(const struct checksum *a, const struct checksum *b);

#endif
