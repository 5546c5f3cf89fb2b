// SPDX-License-Identifier: GPL-3.0-or-later
#include "result/draft.h"

#include <errno.h>
#include <fcntl.h>
#include <string.h>
#include <unistd.h>

#include "core/file.h"

// A run that removes a file has locked it, and a run that writes a file keeps it locked until the
// file has its name. So no run removes or names the file of another.
int draft_clear(const char *path, const char *draft, struct error *e) {
    int old;
    const int status = file_claim(path, draft, 0, &old, e);
    if (old >= 0) {
        unlink(draft);
        close(old);
    }
    return status;
}

static int cannot_write(const struct draft *d, struct error *e) {
    return error_set(e, STATUS_SYSTEM, "cannot write %s: %s", d->path, strerror(errno));
}

static int make_file(void *context, struct error *e) {
    struct draft *d = context;
    int file;
    int status = draft_clear(d->path, d->name, e);
    if (status == STATUS_OK) {
        status = file_claim(d->path, d->name, O_CREAT | O_EXCL, &file, e);
    }
    if (status != STATUS_OK) {
        return status;
    }
    d->to = fdopen(file, "w");
    if (!d->to) {
        status = cannot_write(d, e);
        unlink(d->name);
        close(file);
    }
    return status;
}

int draft_open(struct draft *d, const char *path, enum result_existing existing, struct error *e) {
    *d = (struct draft){.existing = existing};
    const int n = snprintf(d->name, sizeof d->name, "%s.part", path);
    if (n < 0 || (size_t)n >= sizeof d->name) {
        return error_set(e, STATUS_INPUT, "the name %.40s... is too long", path);
    }
    snprintf(d->path, sizeof d->path, "%s", path);
    const int status = result_check_path(path, existing, e);
    return status == STATUS_OK ? file_retry(path, d->name, make_file, d, e) : status;
}

int draft_publish(struct draft *d, struct error *e) {
    if (fflush(d->to) != 0 || ferror(d->to)) {
        const int status = cannot_write(d, e);
        draft_drop(d);
        return status;
    }
    const int status = result_publish(fileno(d->to), d->name, d->path, d->existing, e);
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
