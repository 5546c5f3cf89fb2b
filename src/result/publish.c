// SPDX-License-Identifier: GPL-3.0-or-later
// Gives a finished file its name: on disk first, then in one step, and never over a file that must
// survive. link() fails if the name is taken; where the file system has no hard links, a
// placeholder opened with O_EXCL takes the name before the file is renamed over it.
#include <errno.h>
#include <fcntl.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "jostle/result.h"

static int cannot_write(struct error *e, const char *path, int cause) {
    return error_set(e, STATUS_SYSTEM, "cannot write %s: %s", path, strerror(cause));
}

static int exists(struct error *e, const char *path) {
    return error_set(e, STATUS_INPUT, "%s exists; --force overwrites it", path);
}

int result_check_path(const char *path, enum result_existing existing, struct error *e) {
    struct stat found;
    if (path[0] == '\0') {
        return error_set(e, STATUS_INPUT, "the name of the file to be written is empty");
    }
    if (strcmp(path, "-") == 0) {
        return error_set(e, STATUS_INPUT,
                         "no file is written to the standard output; ./- is a file called -");
    }
    if (stat(path, &found) != 0) {
        return STATUS_OK;
    }
    if (S_ISDIR(found.st_mode)) {
        return error_set(e, STATUS_INPUT, "%s is a directory; a file is to be written", path);
    }
    if (!S_ISREG(found.st_mode)) {
        return error_set(e, STATUS_INPUT,
                         "%s is no regular file; the file that is written would take its place",
                         path);
    }
    return existing == RESULT_KEEP ? exists(e, path) : STATUS_OK;
}

static int synchronise(const char *draft, const char *path, struct error *e) {
    int file = open(draft, O_RDWR);
    if (file < 0 || fsync(file) != 0) {
        int cause = errno;
        if (file >= 0) {
            close(file);
        }
        return cannot_write(e, path, cause);
    }
    return close(file) == 0 ? STATUS_OK : cannot_write(e, path, errno);
}

static int replace(const char *draft, const char *path, struct error *e) {
    return rename(draft, path) == 0 ? STATUS_OK : cannot_write(e, path, errno);
}

static int keep(const char *draft, const char *path, struct error *e) {
    if (link(draft, path) == 0) {
        unlink(draft);
        return STATUS_OK;
    }
    if (errno == EEXIST) {
        return exists(e, path);
    }
    int placeholder = open(path, O_WRONLY | O_CREAT | O_EXCL, 0666);
    if (placeholder < 0) {
        return errno == EEXIST ? exists(e, path) : cannot_write(e, path, errno);
    }
    close(placeholder);
    int status = replace(draft, path, e);
    if (status != STATUS_OK) {
        unlink(path);
    }
    return status;
}

int result_publish(const char *draft, const char *path, enum result_existing existing,
                   struct error *e) {
    int status = synchronise(draft, path, e);
    if (status == STATUS_OK) {
        status = existing == RESULT_REPLACE ? replace(draft, path, e) : keep(draft, path, e);
    }
    if (status != STATUS_OK) {
        unlink(draft);
    }
    return status;
}
