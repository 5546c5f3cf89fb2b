// SPDX-License-Identifier: GPL-3.0-or-later
// Reads whole files.
#include <assert.h>
#include <errno.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "core/arena.h"
#include "core/file.h"
#include "core/text.h"

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
    *text = arena_alloc(a, (size_t)s.st_size + 1, 1);
    if (!*text) {
        return error_no_memory(e);
    }
    const ssize_t n = file_read(file, *text, (size_t)s.st_size, 0);
    if (n < 0) {
        return error_set(e, STATUS_SYSTEM, "cannot read %s: %s", path, strerror(errno));
    }
    *size = (size_t)n;
    return STATUS_OK;
}

int text_file(struct arena *a, const char *path, size_t limit, char **text, size_t *size,
              struct error *e) {
    assert(path && text && size);
    int file;
    int status = file_open(path, &file, e);
    if (status == STATUS_OK) {
        status = read_open(a, file, path, limit, text, size, e);
        close(file);
    }
    return status;
}
