// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/file.h"

#include <assert.h>
#include <errno.h>
#include <fcntl.h>
#include <stdlib.h>
#include <string.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

static int open_file(const char *path, int flags) {
    int file;
    do {
        file = open(path, flags | O_NONBLOCK | O_CLOEXEC, 0666);
    } while (file < 0 && errno == EINTR);
    return file;
}

int file_open(const char *path, int *file, struct error *e) {
    assert(path && file);
    *file = open_file(path, O_RDONLY);
    if (*file >= 0) {
        return STATUS_OK;
    }
    const bool missing = errno == ENOENT || errno == ENOTDIR;
    const char *hint = strcmp(path, "-") == 0 ? "; the standard input is not read" : "";
    return error_set(e, missing ? STATUS_INPUT : STATUS_SYSTEM, "cannot open %s: %s%s", path,
                     strerror(errno), hint);
}

ssize_t file_read(int file, void *to, size_t n, off_t at) {
    assert(file >= 0 && (to || n == 0) && at >= 0);
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

int file_write(int file, const void *from, size_t n, off_t at) {
    assert(file >= 0 && (from || n == 0) && at >= 0);
    size_t put = 0;
    while (put < n) {
        const ssize_t more = pwrite(file, (const char *)from + put, n - put, at + (off_t)put);
        if (more < 0 && errno != EINTR) {
            return -1;
        }
        put += more > 0 ? (size_t)more : 0;
    }
    return 0;
}

int file_cut(int file, off_t size) {
    assert(file >= 0 && size >= 0);
    int status;
    do {
        status = ftruncate(file, size);
    } while (status != 0 && errno == EINTR);
    return status;
}

int file_sync(int file) {
    int status;
    do {
        status = fsync(file);
    } while (status != 0 && errno == EINTR);
    return status;
}

int file_sync_folder(int folder) {
    return file_sync(folder) == 0 || errno == EINVAL || errno == EBADF ? 0 : -1;
}

int file_open_folder(const char *path) {
    const char *slash = strrchr(path, '/');
    char *folder = slash ? strndup(path, (size_t)(slash - path) + 1) : NULL;
    const int file =
        slash && !folder ? -1 : open_file(folder ? folder : ".", O_RDONLY | O_DIRECTORY);
    free(folder);
    return file;
}

const char *file_obstacle(int folder, const char *path) {
    struct stat found;
    if (fstatat(folder, path, &found, AT_SYMLINK_NOFOLLOW) != 0 || S_ISREG(found.st_mode)) {
        return NULL;
    }
    return S_ISDIR(found.st_mode)   ? "a directory"
           : S_ISLNK(found.st_mode) ? "a symbolic link"
                                    : "not a regular file";
}

bool file_is_named(int file, const char *path) {
    struct stat own, named;
    return fstat(file, &own) == 0 && S_ISREG(own.st_mode) && lstat(path, &named) == 0 &&
           own.st_dev == named.st_dev && own.st_ino == named.st_ino;
}

static bool lock(int file, int kind) {
    int status;
    do {
        status = flock(file, kind | LOCK_NB);
    } while (status != 0 && errno == EINTR);
    return status == 0 || errno != EWOULDBLOCK;
}

bool file_lock(int file) {
    return lock(file, LOCK_EX);
}

bool file_share(int file) {
    return lock(file, LOCK_SH);
}

static int taken(const char *wanted, const char *path, struct error *e) {
    return error_set(e, STATUS_SYSTEM, "cannot write %s: another run is writing %s", wanted,
                     strcmp(wanted, path) == 0 ? "it" : path);
}

int file_claim(const char *wanted, const char *path, int flags, int *file, struct error *e) {
    assert(wanted && path && file);
    const char *obstacle = file_obstacle(AT_FDCWD, path);
    *file = -1;
    if (obstacle) {
        return error_set(e, STATUS_SYSTEM, "cannot write %s: %s is %s", wanted, path, obstacle);
    }
    const int opened = open_file(path, O_RDWR | O_NOFOLLOW | O_NOCTTY | flags);
    if (opened < 0) {
        // `path` could not be opened.
        if (errno == ENOENT && !(flags & O_CREAT)) {
            return STATUS_OK;
        }
        return errno == EEXIST || errno == ELOOP
                   ? STATUS_RETRY
                   : error_set(e, STATUS_SYSTEM, "cannot write %s: %s", wanted, strerror(errno));
    }
    const bool locked = file_lock(opened);
    if (locked && file_is_named(opened, path)) {
        *file = opened;
        return STATUS_OK;
    }
    close(opened);
    return locked ? STATUS_RETRY : taken(wanted, path, e);
}

int file_retry(const char *wanted, const char *path, file_attempt *attempt, void *context,
               struct error *e) {
    assert(wanted && path && attempt);
    enum { ATTEMPTS = 20 };
    for (int i = 0; i < ATTEMPTS; i++) {
        const int status = attempt(context, e);
        if (status != STATUS_RETRY) {
            return status;
        }
    }
    return taken(wanted, path, e);
}
