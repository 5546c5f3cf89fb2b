// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/file.h"

#include <errno.h>
#include <fcntl.h>
#include <string.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

int file_open(const char *path, int *file, struct error *e) {
    *file = open(path, O_RDONLY | O_NONBLOCK | O_CLOEXEC);
    if (*file >= 0) {
        return STATUS_OK;
    }
    const bool missing = errno == ENOENT || errno == ENOTDIR;
    const char *hint = strcmp(path, "-") == 0 ? "; the standard input is not read" : "";
    return error_set(e, missing ? STATUS_INPUT : STATUS_SYSTEM, "cannot open %s: %s%s", path,
                     strerror(errno), hint);
}

ssize_t file_read(int file, void *to, size_t n, off_t at) {
    size_t got = 0;
    while (got < n) {
        const ssize_t more = pread(file, (char *)to + got, n - got, at + (off_t)got);
        if (more < 0 && errno != EINTR) {
            return -1;
        }
        if (more == 0) {
            break;
        }
        got += more > 0 ? (size_t)more : 0;
    }
    return (ssize_t)got;
}

bool file_is_named(int file, const char *path) {
    struct stat own, named;
    return fstat(file, &own) == 0 && stat(path, &named) == 0 && own.st_dev == named.st_dev &&
           own.st_ino == named.st_ino;
}

bool file_lock(int file) {
    return flock(file, LOCK_EX | LOCK_NB) == 0 || errno != EWOULDBLOCK;
}
