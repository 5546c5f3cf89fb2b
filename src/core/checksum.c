// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/checksum.h"

#include <errno.h>
#include <string.h>
#include <unistd.h>

#include "core/file.h"

static const uint64_t prime = UINT64_C(1099511628211);

uint64_t checksum_add(uint64_t sum, const void *data, size_t n) {
    const unsigned char *byte = data;
    for (size_t i = 0; i < n; i++) {
        sum = (sum ^ byte[i]) * prime;
    }
    return sum;
}

// The upper half comes down too: a product takes no bit down, so that the highest of two words
// would undo each other.
static uint64_t add_word(uint64_t sum, uint64_t word) {
    sum = (sum ^ word) * prime;
    return sum ^ sum >> 32;
}

uint64_t checksum_many(uint64_t sum, const void *data, size_t n) {
    enum { SUMS = 4 };
    const unsigned char *byte = data;
    uint64_t part[SUMS] = {sum, sum, sum, sum}, word[SUMS];
    for (; n >= sizeof word; n -= sizeof word, byte += sizeof word) {
        memcpy(word, byte, sizeof word);
        for (int k = 0; k < SUMS; k++) {
            part[k] = add_word(part[k], word[k]);
        }
    }
    for (int k = 0; k < SUMS; k++) {
        sum = add_word(sum, part[k]);
    }
    return checksum_add(sum, byte, n);
}

int checksum_file(const char *path, uint64_t *sum, struct error *e) {
    enum { BLOCK = 65536 };
    char block[BLOCK];
    int file;
    int status = file_open(path, &file, e);
    if (status != STATUS_OK) {
        return status;
    }
    *sum = checksum_start;
    ssize_t n;
    for (off_t at = 0; (n = file_read(file, block, sizeof block, at)) > 0; at += n) {
        *sum = checksum_many(*sum, block, (size_t)n);
    }
    if (n < 0) {
        status = error_set(e, STATUS_SYSTEM, "cannot read %s: %s", path, strerror(errno));
    }
    close(file);
    return status;
}
