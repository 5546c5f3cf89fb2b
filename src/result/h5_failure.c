// SPDX-License-Identifier: GPL-3.0-or-later
// Failures of the library: want of memory, or a damaged file.
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "result/h5.h"

// In bytes. What the library takes before it is asked for again fits into ROOM: half a mebibyte for
// a file, one for converting what it reads, and some KiB for each object.
enum { ROOM = 2 << 20, ASK_EVERY = 16 };

// `volatile`: the compiler must not see that the block is not used.
static bool is_there(size_t bytes) {
    void *volatile block = malloc(bytes);
    const bool is = block;
    free(block);
    return is;
}

// Keeps the description of the innermost error: the first one visited.
static herr_t innermost(unsigned n, const H5E_error2_t *entry, void *context) {
    char *cause = context;
    if (n == 0 && entry->desc) {
        snprintf(cause, H5_CAUSE_MAX, "%s", entry->desc);
    }
    return 0;
}

// The library wraps the system's message: "... error message = 'No space left on device', ...".
static void unwrap(char *cause) {
    static const char mark[] = "error message = '";
    char *start = strstr(cause, mark);
    if (!start) {
        return;
    }
    start += sizeof mark - 1;
    char *end = strchr(start, '\'');
    size_t n = end ? (size_t)(end - start) : strlen(start);
    memmove(cause, start, n);
    cause[n] = '\0';
}

static const char no_memory[] = "out of memory";

bool h5_lacks_memory(const struct h5 *h) {
    return strcmp(h->cause, no_memory) == 0;
}

int h5_damaged(const struct h5 *h, const char *path, struct error *e) {
    return h5_lacks_memory(h) ? error_no_memory(e)
                              : error_set(e, STATUS_INPUT, "%s is damaged: %s", path, h->cause);
}

#ifndef H5E_ID
#define H5E_ID H5E_ATOM  // before HDF5 1.14
#endif

// Does an error of the library mean that memory has run out? WANT_SAID: it says so. WANT_GUESSED: a
// list of properties or objects, which is in memory only, lacks an entry, so that an allocation has
// failed at a place that did not report it.
enum want { WANT_NONE, WANT_GUESSED, WANT_SAID };

static herr_t find_memory(unsigned n, const H5E_error2_t *entry, void *want) {
    if (n == 0) {
        const bool says = entry->min_num == H5E_NOSPACE || entry->min_num == H5E_CANTALLOC;
        const bool guessed = entry->maj_num == H5E_PLIST || entry->maj_num == H5E_ID;
        *(enum want *)want = says ? WANT_SAID : guessed ? WANT_GUESSED : WANT_NONE;
    }
    return 0;
}

static herr_t visit_attribute(hid_t object, const char *name, const H5A_info_t *info,
                              void *context) {
    (void)object, (void)name, (void)info, (void)context;
    return 0;
}

static herr_t visit_object(hid_t root, const char *name, const H5O_info_t *info, void *context) {
    (void)info;
    return H5Aiterate_by_name(root, name, H5_INDEX_NAME, H5_ITER_NATIVE, NULL, visit_attribute,
                              context, H5P_DEFAULT);
}

// The library asks for as much memory as a damaged file says that its headers take. Then it fails
// in the same way when all objects and attributes are visited once more. The other driver makes
// that another file, of which nothing is in the library's caches yet.
static bool fails_again(const char *path) {
    char first[H5_CAUSE_MAX] = "", second[H5_CAUSE_MAX] = "";
    H5Ewalk2(H5E_DEFAULT, H5E_WALK_UPWARD, innermost, first);
    hid_t access = H5Pcreate(H5P_FILE_ACCESS);
    const bool opens = access >= 0 && H5Pset_fapl_log(access, NULL, 0, 0) >= 0;
    hid_t file = opens ? H5Fopen(path, H5F_ACC_RDONLY, access) : -1;
    if (file < 0 || H5Ovisit(file, H5_INDEX_NAME, H5_ITER_NATIVE, visit_object, NULL) < 0) {
        H5Ewalk2(H5E_DEFAULT, H5E_WALK_UPWARD, innermost, second);
    }
    h5_drop(file);
    h5_drop(access);
    return first[0] && strcmp(first, second) == 0;
}

// Without memory the library reports missing groups and damaged files. Replaces such a cause.
static void take_memory(struct h5 *h) {
    enum want want = is_there(ROOM) ? WANT_NONE : WANT_SAID;
    if (want == WANT_NONE && !h5_lacks_memory(h)) {
        H5Ewalk2(H5E_DEFAULT, H5E_WALK_UPWARD, find_memory, &want);
        if (want == WANT_SAID && h->read_path && fails_again(h->read_path)) {
            want = WANT_NONE;
            snprintf(h->cause, sizeof h->cause,
                     "one of its headers gives a size that is larger than the memory");
        }
    }
    if (want != WANT_NONE) {
        snprintf(h->cause, sizeof h->cause, "%s", no_memory);
    }
}

bool h5_failed(struct h5 *h, long long result) {
    if (result < 0 && !h->failed) {
        h->failed = true;
        h5_spend_reserve(h);
        snprintf(h->cause, sizeof h->cause, "unknown error of the HDF5 library");
        H5Ewalk2(H5E_DEFAULT, H5E_WALK_UPWARD, innermost, h->cause);
        unwrap(h->cause);
        take_memory(h);
    }
    return h->failed;
}

void h5_fail(struct h5 *h, const char *format, ...) {
    if (h->failed) {
        return;
    }
    h->failed = true;
    h5_spend_reserve(h);
    va_list list;
    va_start(list, format);
    vsnprintf(h->cause, sizeof h->cause, format, list);
    va_end(list);
    take_memory(h);
}

bool h5_has_room(struct h5 *h) {
    if (!h->failed && h->n_ask++ % ASK_EVERY == 0 && !is_there(ROOM)) {
        h5_no_memory(h);
    }
    return !h->failed;
}

void h5_no_memory(struct h5 *h) {
    h5_fail(h, "%s", no_memory);
}
