// SPDX-License-Identifier: GPL-3.0-or-later
#include "result/h5_partial.h"

#include <errno.h>
#include <stdio.h>
#include <string.h>
#include <strings.h>
#include <unistd.h>

#include "core/file.h"
#include "result/partial_file.h"

struct making {
    struct h5 *h;
    const char *path, *partial;
};

// Did another run come in between, as it made the file, locked it to see whether it is an old one,
// or removed it for one, which the library tells in its own words?
static bool was_raced(const struct h5 *h, const char *partial) {
    static const char removed[] = "can't retrieve stat info for file";
    if (h->file >= 0) {
        return h->lock >= 0 && !(file_lock(h->lock) && file_is_named(h->lock, partial));
    }
    return strcmp(h->cause, strerror(EEXIST)) == 0 || strcmp(h->cause, strerror(EAGAIN)) == 0 ||
           strcmp(h->cause, strerror(EINTR)) == 0 || strcmp(h->cause, removed) == 0;
}

static int make_file(void *context, struct error *e) {
    const struct making *m = context;
    const int status = partial_file_clear(m->path, m->partial, e);
    if (status != STATUS_OK) {
        return status;
    }
    h5_create(m->h, m->partial);
    if (!was_raced(m->h, m->partial)) {
        return STATUS_OK;  // or it failed: h->failed
    }
    h5_close_types(m->h);
    h5_close_file(m->h);
    h5_unlock(m->h);
    m->h->failed = false;
    return STATUS_RETRY;
}

int h5_partial_create(struct h5 *h, const char *path, const char *partial, struct error *e) {
    struct making making = {h, path, partial};
    int status = file_retry(path, partial, make_file, &making, e);
    if (status != STATUS_OK || !h->failed) {
        return status;
    }
    if (h->file >= 0) {
        unlink(partial);
    } else {
        status = partial_file_clear(path, partial, e);  // what the library has left on a full disk
    }
    return status == STATUS_OK ? error_set(e, STATUS_SYSTEM, "cannot write %s: %s", path, h->cause)
                               : status;
}

static bool has_ending(const char *path, const char *const *ending, size_t n) {
    const char *point = strrchr(path, '.');
    for (size_t i = 0; point && i < n; i++) {
        if (strcasecmp(point + 1, ending[i]) == 0) {
            return true;
        }
    }
    return false;
}

// Does a file begin as HDF5 files do? One that is empty, or cannot be read, might.
static bool may_be_hdf5(const char *path) {
    static const char begin[] = {'\x89', 'H', 'D', 'F'};
    char found[sizeof begin];
    FILE *file = fopen(path, "rb");
    if (!file) {
        return true;
    }
    const size_t n = fread(found, 1, sizeof found, file);
    fclose(file);
    return n == 0 || (n == sizeof begin && memcmp(found, begin, n) == 0);
}

int h5_partial_check(const struct report *r, const struct result_options *o, struct error *e) {
    static const char *const other[] = {"csv", "tsv", "txt", "json", "png", "svg", "pdf", "deck"};
    static const char *const own[] = {"h5", "hdf5", "hdf"};
    const char *path = o->path;
    const int status = result_check_path(path, o->existing, e);
    if (status != STATUS_OK) {
        return status;
    }
    // A name that promises another kind of file. Any other ending is the user's choice.
    if (has_ending(path, other, sizeof other / sizeof other[0])) {
        return error_set(e, STATUS_INPUT,
                         "%s: a result is an HDF5 file, not %s; call it NAME.h5 (jostle show "
                         "prints tables of it, jostle plot draws it)",
                         path, strrchr(path, '.') + 1);
    }
    // Keeps --force from a record or a script, the name of which stands behind -o by mistake.
    if (!has_ending(path, own, sizeof own / sizeof own[0]) && !may_be_hdf5(path)) {
        return error_set(e, STATUS_INPUT,
                         "%s exists and is not an HDF5 file; --force overwrites HDF5 files only",
                         path);
    }
    // Names of buildings become names of groups.
    for (int i = 0; i < r->n_building; i++) {
        const char *name = r->building[i].name;
        if (strchr(name, '/') || strcmp(name, ".") == 0 || name[0] == '\0') {
            return error_set(e, STATUS_INPUT,
                             "building name '%s' cannot be in a result file; it must not be "
                             "empty, '.' or contain '/'",
                             name);
        }
    }
    return STATUS_OK;
}

void h5_partial_attributes(struct h5 *h, hid_t root, const struct report *r, int numerics) {
    h5_put_text(h, root, "format", "jostle");
    h5_put_long(h, root, "format_version", RESULT_FORMAT_VERSION);
    h5_put_long(h, root, "numerics_version", numerics);
    h5_put_text(h, root, "status", "running");
    h5_put_text(h, root, "unit_force", r->units.force_name);
    h5_put_text(h, root, "unit_length", r->units.length_name);
    h5_put_text(h, root, "unit_time", r->units.time_name);
}
