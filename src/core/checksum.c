// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/checksum.h"

#include <assert.h>
#include <errno.h>
#include <nettle/base16.h>
#include <string.h>
#include <unistd.h>

#include "core/file.h"

void checksum_start(struct checksum_sum *s) {
    sha256_init(&s->sha);
}

void checksum_add(struct checksum_sum *s, const void *data, size_t n) {
    assert(s && (data || n == 0));
    sha256_update(&s->sha, n, data);
}

void checksum_add_text(struct checksum_sum *s, const char *text) {
    assert(text);
    checksum_add(s, text, strlen(text) + 1);
}

void checksum_add_number(struct checksum_sum *s, uint64_t number) {
    unsigned char byte[sizeof number];
    for (size_t i = 0; i < sizeof number; i++) {
        byte[i] = (unsigned char)(number >> 8 * i);
    }
    checksum_add(s, byte, sizeof byte);
}

void checksum_end_bytes(struct checksum_sum *s, unsigned char out[SHA256_DIGEST_SIZE]) {
    sha256_digest(&s->sha, SHA256_DIGEST_SIZE, out);
}

void checksum_end(struct checksum_sum *s, struct checksum *out) {
    unsigned char byte[SHA256_DIGEST_SIZE];
    _Static_assert(BASE16_ENCODE_LENGTH(SHA256_DIGEST_SIZE) == CHECKSUM_DIGITS, "two for a byte");
    checksum_end_bytes(s, byte);
    base16_encode_update(out->digits, sizeof byte, byte);
    out->digits[CHECKSUM_DIGITS] = '\0';
}

uint64_t checksum_short(const void *data, size_t n) {
    struct checksum_sum s;
    uint64_t sum;
    unsigned char byte[sizeof sum];
    checksum_start(&s);
    checksum_add(&s, data, n);
    sha256_digest(&s.sha, sizeof byte, byte);
    memcpy(&sum, byte, sizeof sum);
    return sum;
}

int checksum_file(const char *path, struct checksum *out, struct error *e) {
    assert(path && out);
    enum { BLOCK = 16384 };
    char block[BLOCK];
    struct checksum_sum sum;
    int file;
    int status = file_open(path, &file, e);
    if (status != STATUS_OK) {
        return status;
    }
    checksum_start(&sum);
    ssize_t n;
    for (off_t at = 0; (n = file_read(file, block, sizeof block, at)) > 0; at += n) {
        checksum_add(&sum, block, (size_t)n);
    }
    checksum_end(&sum, out);
    if (n < 0) {
        status = error_set(e, STATUS_SYSTEM, "cannot read %s: %s", path, strerror(errno));
    }
    close(file);
    return status;
}

bool checksum_equal(const struct checksum *a, const struct checksum *b) {
    return strcmp(a->digits, b->digits) == 0;
}
