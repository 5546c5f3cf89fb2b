// SPDX-License-Identifier: GPL-3.0-or-later
#include "result/part.h"

#include <errno.h>
#include <fcntl.h>
#include <string.h>
#include <sys/file.h>
#include <unistd.h>

int part_claim(const char *path, const char *part, struct error *e) {
    int old = open(part, O_RDWR);
    if (old >= 0) {
        const int locked = flock(old, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK;
        close(old);
        if (locked) {
            return error_set(e, STATUS_SYSTEM, "cannot write %s: another run is writing %s", path,
                             part);
        }
        unlink(part);
    }
    int file = open(part, O_RDWR | O_CREAT | O_EXCL, 0666);
    if (file < 0) {
        return error_set(e, STATUS_SYSTEM, "cannot write %s: %s", path, strerror(errno));
    }
    close(file);
    return STATUS_OK;
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
