// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/checksum.h"

#include <errno.h>
#include <fcntl.h>
#include <string.h>
#include <unistd.h>

static const uint64_t prime = UINT64_C(1099511628211);

uint64_t checksum_add(uint64_t sum, const void *data, size_t n) {
    const unsigned char *byte = data;
    for (size_t i = 0; i < n; i++) {
        sum = (sum ^ byte[i]) * prime;
    }
    return sum;
}

// The same of words instead of bytes, and of four sums side by side, as each product waits for the
// one before: files are long, the program's own among them.
enum { SUMS = 4, BLOCK = 65536 / sizeof(uint64_t) };

static void add_words(uint64_t *sum, const uint64_t *word, size_t n) {
    for (size_t i = 0; i < n; i += SUMS) {
        for (size_t k = 0; k < SUMS; k++) {
            sum[k] = (sum[k] ^ word[i + k]) * prime;
        }
    }
}

// Reads a block, or what is left of the file and zeros behind it; bytes read, negative: error.
static ssize_t read_block(int file, uint64_t *word) {
    const size_t size = BLOCK * sizeof *word;
    char *to = memset(word, 0, size);
    size_t n = 0;
    ssize_t got;
    do {
        got = read(file, to + n, size - n);
        if (got < 0 && errno != EINTR) {
            return -1;
        }
        n += got > 0 ? (size_t)got : 0;
    } while (got != 0 && n < size);
    return (ssize_t)n;
}

int checksum_file(const char *path, uint64_t *sum, struct error *e) {
    int file = open(path, O_RDONLY | O_NONBLOCK | O_CLOEXEC);
    if (file < 0) {
        bool missing = errno == ENOENT || errno == ENOTDIR;
        return error_set(e, missing ? STATUS_INPUT : STATUS_SYSTEM, "cannot open %s: %s", path,
                         strerror(errno));
    }
    const uint64_t start = checksum_start;
    uint64_t word[BLOCK], part[SUMS] = {start, start, start, start}, size = 0;
    ssize_t n;
    while ((n = read_block(file, word)) > 0) {
        add_words(part, word, BLOCK);
        size += (uint64_t)n;
    }
    *sum = checksum_add(checksum_add(checksum_start, part, sizeof part), &size, sizeof size);
    int status = STATUS_OK;
    if (n < 0) {
        status = error_set(e, STATUS_SYSTEM, "cannot read %s: %s", path, strerror(errno));
    }
    close(file);
    return status;
}
