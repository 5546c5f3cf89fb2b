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

int checksum_file(const char *path, uint64_t *sum, struct error *e) {
    enum { BUFFER = 16384 };
    unsigned char buffer[BUFFER];
    int file = open(path, O_RDONLY | O_NONBLOCK | O_CLOEXEC);
    if (file < 0) {
        bool missing = errno == ENOENT || errno == ENOTDIR;
        return error_set(e, missing ? STATUS_INPUT : STATUS_SYSTEM, "cannot open %s: %s", path,
                         strerror(errno));
    }
    *sum = checksum_start;
    ssize_t n;
    while ((n = read(file, buffer, sizeof buffer)) > 0 || (n < 0 && errno == EINTR)) {
        *sum = checksum_add(*sum, buffer, n > 0 ? (size_t)n : 0);
    }
    int status = STATUS_OK;
    if (n < 0) {
        status = error_set(e, STATUS_SYSTEM, "cannot read %s: %s", path, strerror(errno));
    }
    close(file);
    return status;
}
