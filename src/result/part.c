// SPDX-License-Identifier: GPL-3.0-or-later
#include "result/part.h"

#include <errno.h>
#include <fcntl.h>
#include <string.h>
#include <sys/file.h>
#include <unistd.h>

#include "core/file_name.h"

// Locks it, where the library has not (HDF5_USE_FILE_LOCKING=FALSE); it must still have its name
// then. Where no file can be locked nothing is known of others.
static bool is_ours(int file, const char *path) {
    return (flock(file, LOCK_EX | LOCK_NB) == 0 || errno != EWOULDBLOCK) &&
           file_is_named(file, path);
}

static int taken(const char *path, const char *part, struct error *e) {
    return error_set(e, STATUS_SYSTEM, "cannot write %s: another run is writing %s", path, part);
}

static int cannot_write(const char *path, const struct h5 *h, struct error *e) {
    return error_set(e, STATUS_SYSTEM, "cannot write %s: %s", path, h->cause);
}

// Removes what a killed run has left. Whoever removes a file has it locked, and whoever writes one
// keeps it locked until it has its name, so that nobody removes or names the file of another.
static int remove_old(const char *path, const char *part, struct error *e) {
    const int old = open(part, O_RDWR | O_CLOEXEC);
    if (old < 0) {
        return errno == ENOENT
                   ? STATUS_OK
                   : error_set(e, STATUS_SYSTEM, "cannot write %s: %s is in the way: %s", path,
                               part, strerror(errno));
    }
    const bool locked = flock(old, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK;
    if (!locked && file_is_named(old, part)) {
        unlink(part);
    }
    close(old);
    return locked ? taken(path, part, e) : STATUS_OK;
}

// Did another run come in between, as it made the file or locked it to see whether it is an old
// one?
static bool was_raced(const struct h5 *h, const char *part) {
    if (h->file >= 0) {
        return h->lock >= 0 && !is_ours(h->lock, part);
    }
    return strcmp(h->cause, strerror(EEXIST)) == 0 || strcmp(h->cause, strerror(EAGAIN)) == 0;
}

static void give_up(struct h5 *h) {
    h5_close_types(h);
    h5_close_file(h);
    h5_unlock(h);
    h->failed = false;
}

// Between its making and its lock another run may take the file for an old one, and so may that one
// lose its own: then all try again, until one finds the file of another locked.
static int create_alone(struct h5 *h, const char *path, const char *part, struct error *e) {
    enum { ATTEMPTS = 20 };
    for (int attempt = 0; attempt < ATTEMPTS; attempt++) {
        const int status = remove_old(path, part, e);
        if (status != STATUS_OK) {
            return status;
        }
        h5_create(h, part);
        if (!was_raced(h, part)) {
            return STATUS_OK;
        }
        give_up(h);
    }
    return taken(path, part, e);
}

int part_create(struct h5 *h, const char *path, const char *part, struct error *e) {
    int status = create_alone(h, path, part, e);
    if (status != STATUS_OK || !h->failed) {
        return status;
    }
    if (h->file >= 0) {
        unlink(part);
    } else {
        status = remove_old(path, part, e);  // what the library has left on a full disk
    }
    return status == STATUS_OK ? cannot_write(path, h, e) : status;
}

// Names of buildings become names of groups.
static int check_names(const struct report *r, struct error *e) {
    for (int i = 0; i < r->n_building; i++) {
        const char *name = r->building[i].name;
        if (strchr(name, '/') || strcmp(name, ".") == 0 || name[0] == '\0') {
            return error_set(e, STATUS_INPUT,
                             "building name '%s' cannot stand in a result file; it must not be "
                             "empty, '.' or contain '/'",
                             name);
        }
    }
    return STATUS_OK;
}

int part_check(const struct report *r, const struct result_options *o, struct error *e) {
    int status = result_check_path(o->path, o->existing, e);
    return status == STATUS_OK ? check_names(r, e) : status;
}

void part_attributes(struct h5 *h, hid_t root, const struct report *r) {
    h5_put_text(h, root, "format", "jostle");
    h5_put_long(h, root, "format_version", RESULT_FORMAT_VERSION);
    h5_put_text(h, root, "status", "running");
    h5_put_text(h, root, "unit_force", r->units.force_name);
    h5_put_text(h, root, "unit_length", r->units.length_name);
    h5_put_text(h, root, "unit_time", r->units.time_name);
}
