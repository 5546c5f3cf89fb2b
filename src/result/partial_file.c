// SPDX-License-Identifier: GPL-3.0-or-later
// A file while it is being made, and how it gets its name: on disk first, then in one step, and
// never over a file that must survive. link() fails if the name is taken; where the file system has
// no hard links, a placeholder opened with O_EXCL takes the name before the file is renamed over
// it. The folder is opened once, so that all steps are in the same folder, even if it is moved
// meanwhile.
//
// POSIX has no call that replaces only regular files: a link that takes the name between the check
// and the rename is replaced. The file behind such a link is not touched.
//
// A run that removes a file has locked it, and a run that writes a file keeps it locked until the
// file has its name. So no run removes or names the file of another.
#include "result/partial_file.h"

#include <errno.h>
#include <fcntl.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "core/file.h"

static int cannot_write(struct error *e, const char *path, int cause) {
    return error_set(e, STATUS_SYSTEM, "cannot write %s: %s", path, strerror(cause));
}

static int exists(struct error *e, const char *path) {
    return error_set(e, STATUS_INPUT, "%s exists; --force overwrites it", path);
}

static int check_obstacle(int folder, const char *name, const char *path, struct error *e) {
    const char *obstacle = file_obstacle(folder, name);
    return obstacle ? error_set(e, STATUS_INPUT, "%s is %s; only a regular file is replaced", path,
                                obstacle)
                    : STATUS_OK;
}

int result_check_path(const char *path, enum result_existing existing, struct error *e) {
    struct stat found;
    if (path[0] == '\0') {
        return error_set(e, STATUS_INPUT, "the name of the file to be written is empty");
    }
    if (strcmp(path, "-") == 0) {
        return error_set(e, STATUS_INPUT,
                         "jostle cannot write a file to standard output; ./- is a file called -");
    }
    const int status = check_obstacle(AT_FDCWD, path, path, e);
    return status == STATUS_OK && existing == RESULT_KEEP && lstat(path, &found) == 0
               ? exists(e, path)
               : status;
}

// A file about to get its name.
struct publication {
    const char *path;
    int folder;                  // AT_FDCWD: the folder cannot be read
    const char *name, *partial;  // relative to the folder
};

static int replace(const struct publication *p, struct error *e) {
    return renameat(p->folder, p->partial, p->folder, p->name) == 0
               ? STATUS_OK
               : cannot_write(e, p->path, errno);
}

static int keep(const struct publication *p, struct error *e) {
    if (linkat(p->folder, p->partial, p->folder, p->name, 0) == 0) {
        unlinkat(p->folder, p->partial, 0);
        return STATUS_OK;
    }
    if (errno == EEXIST) {
        return exists(e, p->path);
    }
    int placeholder;
    int status = file_claim(p->path, p->path, O_CREAT | O_EXCL, &placeholder, e);
    if (status != STATUS_OK) {
        return status == STATUS_RETRY ? exists(e, p->path) : status;
    }
    status = replace(p, e);
    if (status != STATUS_OK) {
        unlinkat(p->folder, p->name, 0);
    }
    close(placeholder);
    return status;
}

int result_publish(int file, const char *partial, const char *path, enum result_existing existing,
                   struct error *e) {
    const int folder = file_open_folder(path);
    const char *slash = strrchr(path, '/');
    const size_t start = folder >= 0 && slash ? (size_t)(slash - path) + 1 : 0;
    const struct publication p = {.path = path,
                                  .folder = folder >= 0 ? folder : AT_FDCWD,
                                  .name = path + start,
                                  .partial = partial + start};
    int status = file_sync(file) == 0 ? STATUS_OK : cannot_write(e, path, errno);
    // Others may read the file from here on, as it is complete. Nobody may remove it before it has
    // its name.
    if (status == STATUS_OK && (!file_share(file) || !file_is_named(file, partial))) {
        status = error_set(e, STATUS_SYSTEM, "cannot write %s: another program has taken %s", path,
                           partial);
    }
    status = status == STATUS_OK ? check_obstacle(p.folder, p.name, path, e) : status;
    if (status == STATUS_OK) {
        status = existing == RESULT_REPLACE ? replace(&p, e) : keep(&p, e);
    }
    if (status == STATUS_OK && file_sync_folder(p.folder) != 0) {
        status = cannot_write(e, path, errno);
    }
    if (status != STATUS_OK) {
        unlink(partial);
    }
    if (folder >= 0) {
        close(folder);
    }
    return status;
}

int partial_file_clear(const char *path, const char *partial, struct error *e) {
    int old;
    const int status = file_claim(path, partial, 0, &old, e);
    if (old >= 0) {
        unlink(partial);
        close(old);
    }
    return status;
}

static int make_file(void *context, struct error *e) {
    struct partial_file *f = context;
    int file;
    int status = partial_file_clear(f->path, f->name, e);
    if (status == STATUS_OK) {
        status = file_claim(f->path, f->name, O_CREAT | O_EXCL, &file, e);
    }
    if (status != STATUS_OK) {
        return status;
    }
    f->to = fdopen(file, "w");
    if (!f->to) {
        status = cannot_write(e, f->path, errno);
        unlink(f->name);
        close(file);
    }
    return status;
}

int partial_file_open(struct partial_file *f, const char *path, enum result_existing existing,
                      struct error *e) {
    *f = (struct partial_file){.existing = existing};
    const int n = snprintf(f->name, sizeof f->name, "%s.part", path);
    if (n < 0 || (size_t)n >= sizeof f->name) {
        return error_set(e, STATUS_INPUT, "the name %.40s... is too long", path);
    }
    snprintf(f->path, sizeof f->path, "%s", path);
    const int status = result_check_path(path, existing, e);
    return status == STATUS_OK ? file_retry(path, f->name, make_file, f, e) : status;
}

int partial_file_publish(struct partial_file *f, struct error *e) {
    if (fflush(f->to) != 0 || ferror(f->to)) {
        const int status = cannot_write(e, f->path, errno);
        partial_file_drop(f);
        return status;
    }
    const int status = result_publish(fileno(f->to), f->name, f->path, f->existing, e);
    fclose(f->to);  // all is on disk
    f->to = NULL;
    return status;
}

void partial_file_drop(struct partial_file *f) {
    if (f->to) {
        unlink(f->name);
        fclose(f->to);
        f->to = NULL;
    }
}
