// SPDX-License-Identifier: GPL-3.0-or-later
#include "result/part_file.h"

#include <errno.h>
#include <fcntl.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "core/file.h"

bool part_file_is_ours(int file, const char *part) {
    return file_lock(file) && file_is_named(file, part);
}

int part_file_taken(const char *path, const char *part, struct error *e) {
    return error_set(e, STATUS_SYSTEM, "cannot write %s: another run is writing %s", path, part);
}

// After `part` could not be opened. A symbolic link is no file of a run, and is removed.
static int clear_unopened(const char *path, const char *part, struct error *e) {
    const int cause = errno;
    struct stat found;
    const bool is_there = cause != ENOENT && lstat(part, &found) == 0;
    if (cause == ENOENT || (is_there && S_ISLNK(found.st_mode) && unlink(part) == 0)) {
        return STATUS_OK;
    }
    return is_there ? error_set(e, STATUS_SYSTEM, "cannot write %s: %s is in the way: %s", path,
                                part, strerror(cause))
                    : error_set(e, STATUS_SYSTEM, "cannot write %s: %s", path, strerror(cause));
}

// Whoever removes a file has it locked, and whoever writes one keeps it locked until it has its
// name, so that nobody removes or names the file of another.
int part_file_clear(const char *path, const char *part, struct error *e) {
    const int old = open(part, O_RDWR | O_CLOEXEC | O_NOFOLLOW);
    if (old < 0) {
        return clear_unopened(path, part, e);
    }
    const bool locked = file_lock(old);
    if (locked && file_is_named(old, part)) {
        unlink(part);
    }
    close(old);
    return locked ? STATUS_OK : part_file_taken(path, part, e);
}

static int cannot_write(const struct part_file *p, struct error *e) {
    return error_set(e, STATUS_SYSTEM, "cannot write %s: %s", p->path, strerror(errno));
}

static int give_stream(struct part_file *p, int file, struct error *e) {
    p->to = fdopen(file, "w");
    if (p->to) {
        return STATUS_OK;
    }
    const int status = cannot_write(p, e);
    unlink(p->part);
    close(file);
    return status;
}

// Between its making and its lock another run may take the file for an old one: then both try
// again, until one finds the file of another locked.
static int open_alone(struct part_file *p, struct error *e) {
    enum { ATTEMPTS = 20 };
    for (int attempt = 0; attempt < ATTEMPTS; attempt++) {
        const int status = part_file_clear(p->path, p->part, e);
        if (status != STATUS_OK) {
            return status;
        }
        const int file = open(p->part, O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
        if (file < 0 && errno != EEXIST) {
            return cannot_write(p, e);
        }
        if (file >= 0 && part_file_is_ours(file, p->part)) {
            return give_stream(p, file, e);
        }
        if (file >= 0) {
            close(file);
        }
    }
    return part_file_taken(p->path, p->part, e);
}

int part_file_open(struct part_file *p, const char *path, struct error *e) {
    p->to = NULL;
    const int n = snprintf(p->part, sizeof p->part, "%s.part", path);
    if (n < 0 || (size_t)n >= sizeof p->part) {
        return error_set(e, STATUS_INPUT, "the name %.40s... is too long", path);
    }
    snprintf(p->path, sizeof p->path, "%s", path);
    return open_alone(p, e);
}

int part_file_publish(struct part_file *p, enum result_existing existing, struct error *e) {
    if (fflush(p->to) != 0 || ferror(p->to)) {
        const int status = cannot_write(p, e);
        part_file_drop(p);
        return status;
    }
    const int status = result_publish(p->part, p->path, existing, e);
    fclose(p->to);  // all is on disk
    p->to = NULL;
    return status;
}

void part_file_drop(struct part_file *p) {
    if (p->to) {
        unlink(p->part);
        fclose(p->to);
        p->to = NULL;
    }
}
