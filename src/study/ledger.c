// SPDX-License-Identifier: GPL-3.0-or-later
#include "study/ledger.h"

#include <string.h>

#include "core/checksum.h"

int ledger_init(struct ledger *l, struct error *e) {
    *l = (struct ledger){.arena = arena_create()};
    return l->arena ? STATUS_OK : error_no_memory(e);
}

void ledger_close(struct ledger *l) {
    arena_free(l->arena);
    *l = (struct ledger){.arena = NULL};
}

static uint64_t sum_of(const char *path) {
    uint64_t sum;
    struct error e;
    return checksum_file(path, &sum, &e) == STATUS_OK ? sum : 0;
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

static struct ledger_file *find(const struct ledger *l, const char *path) {
    struct ledger_file *f = l->file;
    while (f && strcmp(f->path, path) != 0) {
        f = f->next;
    }
    return f;
}

static struct ledger_file *enter(struct ledger *l, const char *path) {
    struct ledger_file *f = arena_alloc(l->arena, 1, sizeof *f);
    char *copy = arena_text(l->arena, path, strlen(path));
    if (!f || !copy) {
        return NULL;
    }
    f->path = copy;
    f->seen = look(path);
    f->sum = sum_of(path);
    f->next = l->file;
    l->file = f;
    return f;
}

static int changed(const char *path, struct error *e) {
    return error_set(e, STATUS_INPUT, "%s has changed since the study was started", path);
}

int ledger_check(struct ledger *l, const char *path, const struct ledger_file **added,
                 struct error *e) {
    struct ledger_file *f = find(l, path);
    *added = NULL;
    if (!f) {
        *added = enter(l, path);
        return *added ? STATUS_OK : error_no_memory(e);
    }
    const struct stat now = look(path);
    if (looks_the_same(&f->seen, &now)) {
        return STATUS_OK;
    }
    if (sum_of(path) != f->sum) {
        return changed(path, e);
    }
    f->seen = now;
    return STATUS_OK;
}

int ledger_expect(struct ledger *l, const char *path, uint64_t sum, struct error *e) {
    struct ledger_file *f = enter(l, path);
    if (!f) {
        return error_no_memory(e);
    }
    return f->sum == sum ? STATUS_OK : changed(path, e);
}
