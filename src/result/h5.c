// SPDX-License-Identifier: GPL-3.0-or-later
// Types, groups and links: what h5_write.c and h5_read.c share.
#include "result/h5.h"

#include <errno.h>
#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "core/arena.h"
#include "core/file.h"

// In bytes. RESERVE is so large that the C library maps it by itself, away from the pages that
// core/heap.c has got ready.
enum { CONVERSION_BUFFER = 16384, HEADER_CACHE = 1 << 18, RESERVE = 4 << 20 };

// Half as many entries as a node of the file's trees has: of those of groups, which have some ten
// links, in their leaves, and of those of chunks, of which most datasets have one. The library's
// own numbers, 16, 4 and 32, make a run of a study larger by a fifth, and each compressed history
// by 2 KiB.
enum { GROUP_NODE = 4, GROUP_LEAF = 5, CHUNK_NODE = 2 };

static void *of_arena(struct h5 *h, void *p) {
    if (!p) {
        h5_no_memory(h);
    }
    return p;
}

// Histories of 64 bits that deflate packs well, with times of their own, take 8 times their size;
// small files may be packed better.
uint64_t h5_memory_limit(const struct h5 *h) {
    enum { TIMES = 16, LEAST = 256 << 20 };
    const uint64_t size = h->heap.end;
    return size > LEAST / TIMES ? TIMES * size : LEAST;
}

bool h5_take(struct h5 *h, size_t n, size_t size) {
    if (n > (h5_memory_limit(h) - h->taken) / size) {
        h5_fail(h, "%.3g MB of memory are not enough for what a file of %.3g MB says to have",
                (double)h5_memory_limit(h) / 1e6, (double)h->heap.end / 1e6);
        return false;
    }
    h->taken += n * size;
    return true;
}

void *h5_alloc(struct h5 *h, struct arena *a, size_t n, size_t size) {
    return h5_take(h, n, size) ? of_arena(h, arena_alloc(a, n, size)) : NULL;
}

char *h5_copy(struct h5 *h, struct arena *a, const char *text) {
    return of_arena(h, arena_text(a, text, strlen(text)));
}

// The library's work at exit would touch what is left of a file that could not be closed, because
// the disk is full, and crash; all files are closed long before.
bool h5_start(struct h5 *h) {
    if (h5_has_room(h)) {
        H5dont_atexit();
        if (H5Eset_auto2(H5E_DEFAULT, NULL, NULL) < 0) {
            h5_no_memory(h);  // for the library's own tables
        }
    }
    return !h->failed;
}

int h5_check_file(const char *path, struct error *e) {
    struct stat found;
    int file;
    const int status = file_open(path, &file, e);
    if (status != STATUS_OK) {
        return status;
    }
    const mode_t mode = fstat(file, &found) == 0 ? found.st_mode : 0;
    close(file);
    return S_ISREG(mode) ? STATUS_OK
                         : error_set(e, STATUS_INPUT, "%s is %s", path,
                                     S_ISDIR(mode) ? "a directory" : "no regular file");
}

void h5_spend_reserve(struct h5 *h) {
    free(h->reserve);
    h->reserve = NULL;
}

// The library converts in a buffer that is 1 MiB, cleared for each call, unless it is told
// otherwise: a fifth of the time of a short run.
static void open_transfer(struct h5 *h) {
    h->transfer = h->failed ? -1 : H5Pcreate(H5P_DATASET_XFER);
    if (!h5_failed(h, h->transfer)) {
        h5_failed(h, H5Pset_buffer(h->transfer, CONVERSION_BUFFER, NULL, NULL));
    }
}

// What writing needs. Chunks are written whole and never kept in memory by the library.
static void open_lists(struct h5 *h) {
    open_transfer(h);
    if (h->failed) {
        return;
    }
    h->references = H5Tvlen_create(H5T_STD_REF_OBJ);
    h->scalar = H5Screate(H5S_SCALAR);
    h->plain = H5Pcreate(H5P_DATASET_CREATE);
    h->group = H5Pcreate(H5P_GROUP_CREATE);
    h->access = H5Pcreate(H5P_DATASET_ACCESS);
    if (h5_failed(h, h->references) || h5_failed(h, h->scalar) || h5_failed(h, h->plain) ||
        h5_failed(h, h->group) || h5_failed(h, h->access)) {
        return;
    }
    h5_failed(h, H5Pset_obj_track_times(h->plain, false));
    h5_failed(h, H5Pset_obj_track_times(h->group, false));
    h->compact = H5Pcopy(h->plain);
    h5_failed(h, H5Pset_layout(h->compact, H5D_COMPACT));
    h5_failed(h, H5Pset_chunk_cache(h->access, 0, 0, H5D_CHUNK_CACHE_W0_DEFAULT));
}

static void open_types(struct h5 *h) {
    h->text = H5Tcopy(H5T_C_S1);
    if (h5_failed(h, h->text) || h5_failed(h, H5Tset_size(h->text, H5T_VARIABLE))) {
        return;
    }
    h5_failed(h, H5Tset_cset(h->text, H5T_CSET_UTF8));
}

int h5_descriptor(struct h5 *h) {
    void *handle = NULL;
    return h5_failed(h, H5Fget_vfd_handle(h->file, H5P_DEFAULT, &handle)) ? -1
                                                                          : *(const int *)handle;
}

// The library keeps headers of objects in memory up to a size that it counts as in the file. Those
// of datasets in chunks take twenty times as much once they are decoded, so this size is small.
static bool set_header_cache(struct h5 *h, hid_t access) {
    H5AC_cache_config_t c = {.version = H5AC__CURR_CACHE_CONFIG_VERSION};
    if (h5_failed(h, H5Pget_mdc_config(access, &c))) {
        return false;
    }
    c.set_initial_size = true;
    c.initial_size = c.min_size = c.max_size = HEADER_CACHE;
    c.incr_mode = H5C_incr__off;
    c.flash_incr_mode = H5C_flash_incr__off;
    c.decr_mode = H5C_decr__off;
    return !h5_failed(h, H5Pset_mdc_config(access, &c));
}

// Datasets are written whole or in large blocks: no buffer of the library's between.
void h5_create(struct h5 *h, const char *path) {
    h->reserve = malloc(RESERVE);
    if (!h->reserve || !h5_start(h)) {
        h5_no_memory(h);
        return;
    }
    hid_t list = H5Pcreate(H5P_FILE_CREATE), access = H5Pcreate(H5P_FILE_ACCESS);
    if (!h5_failed(h, list) && !h5_failed(h, access) && set_header_cache(h, access) &&
        !h5_failed(h, H5Pset_obj_track_times(list, false)) &&
        !h5_failed(h, H5Pset_sym_k(list, GROUP_NODE, GROUP_LEAF)) &&
        !h5_failed(h, H5Pset_istore_k(list, CHUNK_NODE)) &&
        !h5_failed(h, H5Pset_fapl_sec2(access)) &&
        !h5_failed(h, H5Pset_sieve_buf_size(access, 0))) {
        h->file = H5Fcreate(path, H5F_ACC_EXCL, list, access);
        h5_failed(h, h->file);
    }
    h5_drop(list);
    h5_drop(access);
    if (h->file >= 0) {
        h->lock = fcntl(h5_descriptor(h), F_DUPFD_CLOEXEC, 0);  // outlives the library's
        if (h->lock < 0) {
            h5_fail(h, "%s", strerror(errno));
        }
    }
    if (!h->failed) {
        open_types(h);
        open_lists(h);
    }
}

void h5_unlock(struct h5 *h) {
    if (h->lock >= 0) {
        close(h->lock);
    }
    h->lock = -1;
}

void h5_open(struct h5 *h, const char *path, size_t sieve) {
    h->file = -1;
    h->read_path = path;
    hid_t access = h5_start(h) ? H5Pcreate(H5P_FILE_ACCESS) : -1;
    if (!h5_failed(h, access) && set_header_cache(h, access) &&
        !h5_failed(h, H5Pset_fapl_sec2(access)) &&
        !h5_failed(h, H5Pset_sieve_buf_size(access, sieve))) {
        h->file = H5Fopen(path, H5F_ACC_RDONLY, access);
        if (h5_failed(h, h->file) && strcmp(h->cause, strerror(EAGAIN)) == 0) {
            snprintf(h->cause, sizeof h->cause, "another run is writing it");
        }
    }
    h5_drop(access);
    if (!h->failed) {
        open_types(h);
        open_transfer(h);
        h5_heap_open(h);
    }
}

void h5_close_types(struct h5 *h) {
    hid_t *const held[] = {&h->text,  &h->references, &h->scalar, &h->plain,   &h->compact,
                           &h->group, &h->chunked,    &h->access, &h->transfer};
    for (size_t i = 0; i < sizeof held / sizeof held[0]; i++) {
        h5_drop(*held[i]);
        *held[i] = 0;
    }
    h5_heap_close(h);
    free(h->use);
    h->use = NULL;
    h->n_use = h->use_capacity = 0;
    h5_spend_reserve(h);
}

void h5_close_file(struct h5 *h) {
    if (h->file >= 0) {
        h5_failed(h, H5Fclose(h->file));
    }
    h->file = -1;
}

hid_t h5_group(struct h5 *h, hid_t parent, const char *name) {
    if (h->failed) {
        return -1;
    }
    hid_t group = H5Gcreate2(parent, name, H5P_DEFAULT, h->group, H5P_DEFAULT);
    h5_failed(h, group);
    return group;
}

hid_t h5_open_object(struct h5 *h, hid_t parent, const char *path) {
    if (h->failed) {
        return -1;
    }
    hid_t object = H5Oopen(parent, path, H5P_DEFAULT);
    h5_failed(h, object);
    return object;
}

void h5_drop(hid_t id) {
    if (id > 0) {
        H5Idec_ref(id);
    }
}

void h5_close(struct h5 *h, hid_t object) {
    if (object >= 0) {
        h5_failed(h, H5Oclose(object));
    }
}

void h5_hard_link(struct h5 *h, hid_t object, hid_t parent, const char *name) {
    if (!h->failed) {
        h5_failed(h, H5Olink(object, parent, name, H5P_DEFAULT, H5P_DEFAULT));
    }
}
