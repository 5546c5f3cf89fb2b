// SPDX-License-Identifier: GPL-3.0-or-later
#include "result/draft.h"

#include <errno.h>
#include <fcntl.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "core/file.h"

static int taken(const char *path, const char *draft, struct error *e) {
    return error_set(e, STATUS_SYSTEM, "cannot write %s: another run is writing %s", path, draft);
}

bool draft_is_ours(int file, const char *draft) {
    return file_lock(file) && file_is_named(file, draft);
}

// After `draft` could not be opened. A symbolic link is no file of a run, and is removed.
static int clear_unopened(const char *path, const char *draft, struct error *e) {
    const int cause = errno;
    struct stat found;
    const bool is_there = cause != ENOENT && lstat(draft, &found) == 0;
    if (cause == ENOENT || (is_there && S_ISLNK(found.st_mode) && unlink(draft) == 0)) {
        return STATUS_OK;
    }
    return is_there ? error_set(e, STATUS_SYSTEM, "cannot write %s: %s is in the way: %s", path,
                                draft, strerror(cause))
                    : error_set(e, STATUS_SYSTEM, "cannot write %s: %s", path, strerror(cause));
}

// Whoever removes a file has it locked, and whoever writes one keeps it locked until it has its
// name, so that nobody removes or names the file of another.
int draft_clear(const char *path, const char *draft, struct error *e) {
    const int old = open(draft, O_RDWR | O_CLOEXEC | O_NOFOLLOW);
    if (old < 0) {
        return clear_unopened(path, draft, e);
    }
    const bool locked = file_lock(old);
    if (locked && file_is_named(old, draft)) {
        unlink(draft);
    }
    close(old);
    return locked ? STATUS_OK : taken(path, draft, e);
}

int draft_make(const char *path, const char *draft, draft_function *make, void *context,
               struct error *e) {
    enum { ATTEMPTS = 20 };
    for (int attempt = 0; attempt < ATTEMPTS; attempt++) {
        int status = draft_clear(path, draft, e);
        if (status == STATUS_OK) {
            status = make(context, draft, e);
        }
        if (status != STATUS_RETRY) {
            return status;
        }
    }
    return taken(path, draft, e);
}

static int cannot_write(const struct draft *d, struct error *e) {
    return error_set(e, STATUS_SYSTEM, "cannot write %s: %s", d->path, strerror(errno));
}

static int make_file(void *context, const char *name, struct error *e) {
    struct draft *d = context;
    const int file = open(name, O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    if (file < 0) {
        return errno == EEXIST ? STATUS_RETRY : cannot_write(d, e);
    }
    if (!draft_is_ours(file, name)) {
        close(file);
        return STATUS_RETRY;
    }
    d->to = fdopen(file, "w");
    if (d->to) {
        return STATUS_OK;
    }
    const int status = cannot_write(d, e);
    unlink(name);
    close(file);
    return status;
}

int draft_open(struct draft *d, const char *path, struct error *e) {
    d->to = NULL;
    const int n = snprintf(d->name, sizeof d->name, "%s.part", path);
    if (n < 0 || (size_t)n >= sizeof d->name) {
        return error_set(e, STATUS_INPUT, "the name %.40s... is too long", path);
    }
    snprintf(d->path, sizeof d->path, "%s", path);
    return draft_make(path, d->name, make_file, d, e);
}

int draft_publish(struct draft *d, enum result_existing existing, struct error *e) {
    if (fflush(d->to) != 0 || ferror(d->to)) {
        const int status = cannot_write(d, e);
        draft_drop(d);
        return status;
    }
    const int status = result_publish(d->name, d->path, existing, e);
    fclose(d->to);  // all is on disk
    d->to = NULL;
    return status;
}

void draft_drop(struct draft *d) {
    if (d->to) {
        unlink(d->name);
        fclose(d->to);
        d->to = NULL;
    }
}
