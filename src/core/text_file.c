// SPDX-License-Identifier: GPL-3.0-or-later
// Reads whole files. Opens without waiting, so that a pipe in place of a file cannot hang us.
#include <errno.h>
#include <fcntl.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "core/arena.h"
#include "core/text.h"

// Reads until `size` bytes are there or the file ends.
static int read_all(int file, char *text, size_t *size) {
    size_t n = 0;
    while (n < *size) {
        ssize_t got = read(file, text + n, *size - n);
        if (got < 0 && errno == EINTR) {
            continue;
        }
        if (got < 0) {
            return -1;
        }
        if (got == 0) {
            break;
        }
        n += (size_t)got;
    }
    *size = n;
    return 0;
}

static int check_kind(const struct stat *s, const char *path, size_t limit, struct error *e) {
    if (S_ISDIR(s->st_mode)) {
        return error_set(e, STATUS_INPUT, "%s is a directory", path);
    }
    if (!S_ISREG(s->st_mode)) {
        return error_set(e, STATUS_INPUT, "%s is not a regular file", path);
    }
    if ((unsigned long long)s->st_size > limit) {
        return error_set(e, STATUS_INPUT, "%s has %lld bytes; at most %zu are read", path,
                         (long long)s->st_size, limit);
    }
    return STATUS_OK;
}

static int read_open(struct arena *a, int file, const char *path, size_t limit, char **text,
                     size_t *size, struct error *e) {
    struct stat s;
    if (fstat(file, &s) != 0) {
        return error_set(e, STATUS_SYSTEM, "cannot read %s: %s", path, strerror(errno));
    }
    int status = check_kind(&s, path, limit, e);
    if (status != STATUS_OK) {
        return status;
    }
    *size = (size_t)s.st_size;
    *text = arena_alloc(a, *size + 1, 1);
    if (!*text) {
        return error_no_memory(e);
    }
    if (read_all(file, *text, size) != 0) {
        return error_set(e, STATUS_SYSTEM, "cannot read %s: %s", path, strerror(errno));
    }
    (*text)[*size] = 0;
    return STATUS_OK;
}

int text_file(struct arena *a, const char *path, size_t limit, char **text, size_t *size,
              struct error *e) {
    int file = open(path, O_RDONLY | O_NONBLOCK | O_CLOEXEC);
    if (file < 0) {
        bool missing = errno == ENOENT || errno == ENOTDIR;
        const char *hint = strcmp(path, "-") == 0 ? "; the standard input is not read" : "";
        return error_set(e, missing ? STATUS_INPUT : STATUS_SYSTEM, "cannot open %s: %s%s", path,
                         strerror(errno), hint);
    }
    int status = read_open(a, file, path, limit, text, size, e);
    close(file);
    return status;
}
