// SPDX-License-Identifier: GPL-3.0-or-later
#include "study/manifest.h"

#include <string.h>

#include "core/checksum.h"

int manifest_init(struct manifest *m, const char *deck, struct error *e) {
    const char *slash = strrchr(deck, '/');
    *m = (struct manifest){
        .arena = arena_create(), .deck = deck, .folder = slash ? (size_t)(slash - deck) + 1 : 0};
    return m->arena ? STATUS_OK : error_no_memory(e);
}

void manifest_close(struct manifest *m) {
    arena_free(m->arena);
    *m = (struct manifest){.arena = NULL};
}

// Of an included deck what it means counts, so that its comments may change.
static struct checksum sum_of(const char *path, bool included) {
    struct checksum sum;
    struct error e;
    const int status =
        included ? deck_meaning_of_file(path, &sum, &e) : checksum_file(path, &sum, &e);
    return status == STATUS_OK ? sum : (struct checksum){.digits = ""};
}

static struct stat look(const char *path) {
    struct stat s;
    if (stat(path, &s) != 0) {
        memset(&s, 0, sizeof s);
    }
    return s;
}

// Files are read again only where they may have changed.
static bool looks_the_same(const struct stat *a, const struct stat *b) {
    return a->st_ino != 0 && a->st_dev == b->st_dev && a->st_ino == b->st_ino &&
           a->st_size == b->st_size && a->st_mtim.tv_sec == b->st_mtim.tv_sec &&
           a->st_mtim.tv_nsec == b->st_mtim.tv_nsec && a->st_ctim.tv_sec == b->st_ctim.tv_sec &&
           a->st_ctim.tv_nsec == b->st_ctim.tv_nsec;
}

static struct manifest_file *find(const struct manifest *m, const char *name) {
    struct manifest_file *f = m->file;
    while (f && strcmp(f->name, name) != 0) {
        f = f->next;
    }
    return f;
}

static struct manifest_file *enter(struct manifest *m, const char *name, bool included) {
    struct manifest_file *f = arena_alloc(m->arena, 1, sizeof *f);
    const int folder = name[0] == '/' ? 0 : (int)m->folder;
    const char *path = arena_format(m->arena, "%.*s%s", folder, m->deck, name);
    if (!f || !path) {
        return NULL;
    }
    f->name = path + folder;
    f->path = path;
    f->seen = look(path);
    f->included = included;
    f->sum = sum_of(path, included);
    f->next = m->file;
    m->file = f;
    m->n_file++;
    return f;
}

int manifest_check(struct manifest *m, const struct deck_path *file,
                   const struct manifest_file **entry, struct error *e) {
    const char *path = file->path, *name = file->absolute ? path : path + m->folder;
    struct manifest_file *f = find(m, name);
    *entry = f ? f : enter(m, name, file->included);
    if (!f) {
        return *entry ? STATUS_OK : error_no_memory(e);
    }
    const struct stat now = look(path);
    if (looks_the_same(&f->seen, &now)) {
        return STATUS_OK;
    }
    const struct checksum sum = sum_of(path, f->included);
    if (!checksum_equal(&sum, &f->sum)) {
        return error_set(e, STATUS_INPUT, "%s has changed since the study was started", path);
    }
    f->seen = now;
    return STATUS_OK;
}

int manifest_expect(struct manifest *m, const char *name, const struct checksum *sum,
                    struct error *e) {
    struct manifest_file *f = find(m, name);
    f = f ? f : enter(m, name, false);
    if (!f) {
        return error_no_memory(e);
    }
    if (checksum_equal(sum, &f->sum)) {
        return STATUS_OK;
    }
    const struct checksum meaning = sum_of(f->path, true);  // the file may be an included deck
    if (f->included || !checksum_equal(sum, &meaning)) {
        return error_set(e, STATUS_INPUT, "%s", name);
    }
    f->included = true;
    f->sum = meaning;
    return STATUS_OK;
}
