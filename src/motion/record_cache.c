// SPDX-License-Identifier: GPL-3.0-or-later
// Entries are in the order of their last use, the latest first. The least recently used entries are
// removed, so that memory does not grow with the number of records of a study.
#include "motion/record_cache.h"

#include <assert.h>
#include <pthread.h>
#include <stdlib.h>
#include <string.h>

#include "core/arena.h"
#include "core/text.h"

struct entry {
    struct entry *next;
    struct arena *arena;  // owns the entry and its arrays
    struct record_request request;
    struct record record;
};

struct record_cache {
    pthread_mutex_t lock;  // guards all members below
    struct entry *first;
    size_t bytes, bytes_max;
};

struct record_cache *record_cache_create(size_t bytes_max) {
    assert(bytes_max > 0);
    struct record_cache *c = calloc(1, sizeof *c);
    if (c && pthread_mutex_init(&c->lock, NULL) != 0) {
        free(c);
        c = NULL;
    }
    if (c) {
        c->bytes_max = bytes_max;
    }
    return c;
}

void record_cache_free(struct record_cache *c) {
    if (!c) {
        return;
    }
    for (struct entry *i = c->first; i;) {
        struct entry *next = i->next;
        arena_free(i->arena);
        i = next;
    }
    pthread_mutex_destroy(&c->lock);
    free(c);
}

static bool same(const struct record_request *a, const struct record_request *b) {
    return strcmp(a->path, b->path) == 0 && text_same(a->format, b->format) && a->dt == b->dt &&
           text_same(a->unit, b->unit) && a->gravity == b->gravity && a->channel == b->channel &&
           a->demean == b->demean && a->plain == b->plain;
}

static size_t bytes_of(const struct record *r) {
    return sizeof(struct entry) + r->n * sizeof *r->value;
}

// Finds the entry and moves it to the front; NULL: there is none.
static struct entry *find(struct record_cache *c, const struct record_request *request) {
    for (struct entry **at = &c->first; *at; at = &(*at)->next) {
        struct entry *found = *at;
        if (same(&found->request, request)) {
            *at = found->next;
            found->next = c->first;
            c->first = found;
            return found;
        }
    }
    return NULL;
}

// Copies the values of `r` into memory from `a`; false: no memory.
static bool copy(struct arena *a, const struct record *r, struct record *out) {
    double *value = arena_alloc(a, r->n, sizeof *value);
    if (!value) {
        return false;
    }
    memcpy(value, r->value, r->n * sizeof *value);
    *out = *r;
    out->value = value;
    return true;
}

// Copies the texts of `request` into memory from `a`; false: no memory.
static bool copy_request(struct arena *a, const struct record_request *request,
                         struct record_request *out) {
    *out = *request;
    out->path = arena_text(a, request->path, strlen(request->path));
    if (request->format) {
        out->format = arena_text(a, request->format, strlen(request->format));
    }
    if (request->unit) {
        out->unit = arena_text(a, request->unit, strlen(request->unit));
    }
    return out->path && (out->format || !request->format) && (out->unit || !request->unit);
}

// Adds a copy of the record as the first entry.
static int put(struct record_cache *c, const struct record_request *request, const struct record *r,
               struct error *e) {
    struct arena *a = arena_create();
    struct entry *new = a ? arena_alloc(a, 1, sizeof *new) : NULL;
    if (!new || !copy_request(a, request, &new->request) || !copy(a, r, &new->record)) {
        arena_free(a);
        return error_no_memory(e);
    }
    new->arena = a;
    new->next = c->first;
    c->first = new;
    c->bytes += bytes_of(r);
    if (c->bytes > c->bytes_max) {
        // Removes the entries after those that fit into the cache.
        size_t bytes = 0;
        for (struct entry **at = &c->first; *at;) {
            struct entry *i = *at;
            if (bytes + bytes_of(&i->record) > c->bytes_max) {
                *at = i->next;
                arena_free(i->arena);
            } else {
                bytes += bytes_of(&i->record);
                at = &i->next;
            }
        }
        c->bytes = bytes;
    }
    return STATUS_OK;
}

int record_cache_read(struct record_cache *c, struct arena *a, const struct record_request *request,
                      struct record *out, struct error *e) {
    if (!c) {
        return record_read(a, request, out, e);
    }
    int status = STATUS_OK;
    *out = (struct record){.wrong = RECORD_PATH};
    pthread_mutex_lock(&c->lock);
    struct entry *found = find(c, request);
    if (!found) {
        status = record_read(a, request, out, e);
        if (status == STATUS_OK) {
            status = put(c, request, out, e);
        }
    } else if (!copy(a, &found->record, out)) {
        status = error_no_memory(e);
    }
    pthread_mutex_unlock(&c->lock);
    return status;
}
