// SPDX-License-Identifier: GPL-3.0-or-later
// A file is walked twice: first every object gets a number, in the order of the names, as
// references may lead to objects that come later. Then each link adds its name and the number of
// its object, and the first link to an object adds its content too.
#include "result/seal.h"

#include <stdlib.h>
#include <string.h>

#include "core/checksum.h"
#include "core/hash.h"
#include "result/seal_type.h"

enum { BUFFER_BYTES = 1 << 20, ATTRIBUTE_BYTES_MAX = 1 << 28, DEPTH_MAX = 32, SLOTS_FIRST = 256 };

static const char seal_name[] = "data_sha256";

struct object {
    hobj_ref_t address;  // 0: an empty slot
    uint32_t number;     // from 1
    bool added;
};

struct walk {
    struct h5 *h;
    struct checksum_sum *to;            // that values are added to
    struct checksum_sum data, results;  // of everything; of the datasets only
    struct object *object;              // (n_slot) by their addresses
    size_t n_object, n_slot;            // n_slot: a power of 2
    unsigned char *buffer;              // (BUFFER_BYTES)
    int depth;
};

static struct object *slot_of(const struct walk *w, hobj_ref_t address) {
    size_t i = (size_t)hash_add(hash_start, &address, sizeof address) & (w->n_slot - 1);
    while (w->object[i].address != 0 && w->object[i].address != address) {
        i = (i + 1) & (w->n_slot - 1);
    }
    return &w->object[i];
}

// Makes room for one more.
static bool grow(struct walk *w) {
    if (2 * (w->n_object + 1) <= w->n_slot) {
        return true;
    }
    struct walk more = *w;
    more.n_slot = w->n_slot ? 2 * w->n_slot : SLOTS_FIRST;
    more.object = calloc(more.n_slot, sizeof *more.object);
    if (!more.object) {
        h5_no_memory(w->h);
        return false;
    }
    for (size_t i = 0; i < w->n_slot; i++) {
        if (w->object[i].address != 0) {
            *slot_of(&more, w->object[i].address) = w->object[i];
        }
    }
    free(w->object);
    *w = more;
    return true;
}

// Where the object behind a link of a group is; 0 after a failure.
static hobj_ref_t address_of(struct walk *w, hid_t group, const char *name,
                             const H5L_info_t *info) {
    hobj_ref_t address = 0;
    if (info->type != H5L_TYPE_HARD) {
        h5_fail(w->h, "'%s' is a link of a kind that jostle does not write", name);
    } else if (h5_has_room(w->h)) {
        h5_failed(w->h, H5Rcreate(&address, group, name, H5R_OBJECT, -1));
    }
    return w->h->failed ? 0 : address;
}

static herr_t number_object(hid_t root, const char *path, const H5L_info_t *info, void *context) {
    struct walk *w = context;
    const hobj_ref_t address = grow(w) ? address_of(w, root, path, info) : 0;
    struct object *o = address != 0 ? slot_of(w, address) : NULL;
    if (o && o->address == 0) {
        *o = (struct object){.address = address, .number = (uint32_t)++w->n_object};
    }
    return w->h->failed ? -1 : 0;
}

static void add_reference(struct walk *w, const void *from) {
    hobj_ref_t address;
    memcpy(&address, from, sizeof address);
    const struct object *o = slot_of(w, address);
    if (o->address == 0) {
        h5_fail(w->h, "a dimension scale is not in the file");
    }
    checksum_add_number(w->to, o->number);
}

static void add_text(struct walk *w, const struct h5_reference *r) {
    size_t n;
    const void *text = h5_heap_get(w->h, r, 1, &n);
    checksum_add_number(w->to, n);
    checksum_add(w->to, text, n);
}

static void add_scales(struct walk *w, const struct h5_reference *r) {
    size_t n;
    const unsigned char *list = h5_heap_get(w->h, r, sizeof(hobj_ref_t), &n);
    checksum_add_number(w->to, n);
    for (size_t i = 0; i < n; i++) {
        add_reference(w, list + i * sizeof(hobj_ref_t));
    }
}

static void add_use(struct walk *w, hid_t type, const unsigned char *entry) {
    add_reference(w, entry + H5Tget_member_offset(type, 0));
    checksum_add(w->to, entry + H5Tget_member_offset(type, 1), sizeof(int));
}

// Adds `n` values as they were read.
static void add_values(struct walk *w, hid_t type, enum seal_kind kind, const void *value,
                       size_t n) {
    const size_t size = H5Tget_size(type);
    const unsigned char *byte = value;
    const struct h5_reference *reference = value;
    if (kind == KIND_BYTES) {
        checksum_add(w->to, value, n * size);
        return;
    }
    for (size_t i = 0; i < n && !w->h->failed; i++) {
        if (kind == KIND_TEXT) {
            add_text(w, &reference[i]);
        } else if (kind == KIND_SCALES) {
            add_scales(w, &reference[i]);
        } else {
            add_use(w, type, byte + i * size);
        }
    }
}

// Texts and lists are read as references.
static hid_t type_in_memory(const struct walk *w, hid_t type, enum seal_kind kind) {
    return kind == KIND_TEXT || kind == KIND_SCALES ? w->h->heap.reference : type;
}

// Adds type and shape, and gives what is needed for reading; false after a failure.
static bool add_shape(struct walk *w, hid_t type, hid_t space, const char *name,
                      enum seal_kind *kind, hsize_t *dim, int *n_dim) {
    *kind = seal_kind_of(type);
    *n_dim = H5Sget_simple_extent_ndims(space);
    if (*kind == KIND_NONE || *n_dim < 0 || *n_dim > H5_DIMENSIONS_MAX ||
        H5Sget_simple_extent_dims(space, dim, NULL) != *n_dim) {
        h5_fail(w->h, "'%s' is of a kind that jostle does not write", name);
        return false;
    }
    seal_add_type(w->to, type, *kind);
    checksum_add_number(w->to, (uint64_t)*n_dim);
    for (int i = 0; i < *n_dim; i++) {
        checksum_add_number(w->to, dim[i]);
    }
    return true;
}

static void add_attribute(struct walk *w, hid_t attribute, const char *name) {
    hid_t type = H5Aget_type(attribute), space = H5Aget_space(attribute);
    hsize_t dim[H5_DIMENSIONS_MAX];
    enum seal_kind kind = KIND_NONE;
    int n_dim;
    checksum_add_text(w->to, name);
    if (add_shape(w, type, space, name, &kind, dim, &n_dim)) {
        const hid_t memory = type_in_memory(w, type, kind);
        const hssize_t n = H5Sget_simple_extent_npoints(space);
        const size_t size = H5Tget_size(memory);
        const bool few = n >= 0 && size > 0 && (size_t)n <= ATTRIBUTE_BYTES_MAX / size;
        const bool fits = few && (size_t)n * size <= BUFFER_BYTES;
        void *more = few && !fits ? malloc((size_t)n * size) : NULL;
        void *value = fits ? w->buffer : more;
        if (!few) {
            h5_fail(w->h, "attribute '%s' has too many values", name);
        } else if (!value) {
            h5_no_memory(w->h);
        } else if (!h5_failed(w->h, H5Aread(attribute, memory, value))) {
            add_values(w, type, kind, value, (size_t)n);
        }
        free(more);
    }
    H5Tclose(type);
    H5Sclose(space);
}

static herr_t visit_attribute(hid_t object, const char *name, const H5A_info_t *info,
                              void *context) {
    (void)info;
    struct walk *w = context;
    const bool own = w->depth == 0 && strcmp(name, seal_name) == 0;
    hid_t attribute = own || !h5_has_room(w->h) ? -1 : H5Aopen(object, name, H5P_DEFAULT);
    if (!own && !h5_failed(w->h, attribute)) {
        add_attribute(w, attribute, name);
        H5Aclose(attribute);
    }
    return w->h->failed ? -1 : 0;
}

static void add_attributes(struct walk *w, hid_t object) {
    if (!w->h->failed) {
        h5_failed(w->h, H5Aiterate2(object, H5_INDEX_NAME, H5_ITER_INC, NULL, visit_attribute, w));
    }
    checksum_add_text(w->to, "");  // no name: the end
}

// How many values are read at a time: whole chunks if that is possible, so that none is unpacked
// twice.
static hsize_t values_at_once(hid_t dataset, size_t size, int n_dim) {
    hsize_t chunk[H5_DIMENSIONS_MAX], values = 1;
    const hsize_t most = BUFFER_BYTES / size;
    hid_t list = H5Dget_create_plist(dataset);
    const bool in_chunks =
        H5Pget_layout(list) == H5D_CHUNKED && H5Pget_chunk(list, n_dim, chunk) == n_dim;
    H5Pclose(list);
    for (int i = 0; in_chunks && i < n_dim; i++) {
        values *= chunk[i];
    }
    return values > 0 && values <= most ? most - most % values : most;
}

static void add_blocks(struct walk *w, hid_t dataset, const hsize_t *dim, int n_dim, hid_t type,
                       enum seal_kind kind) {
    const hid_t memory = type_in_memory(w, type, kind);
    const size_t size = H5Tget_size(memory);
    hsize_t n = 1, most = BUFFER_BYTES / size;
    for (int i = 0; i < n_dim; i++) {
        n *= dim[i];
    }
    most = n <= most ? most : values_at_once(dataset, size, n_dim);
    for (hsize_t first = 0; first < n && !w->h->failed;) {
        const struct h5_box box = h5_box(dim, n_dim, first, most);
        h5_get_box(w->h, dataset, box.n == n ? NULL : &box, memory, w->buffer);
        add_values(w, type, kind, w->buffer, w->h->failed ? 0 : (size_t)box.n);
        first += box.n;
    }
}

static void add_dataset(struct walk *w, hid_t dataset, const char *name) {
    hid_t type = H5Dget_type(dataset), space = H5Dget_space(dataset);
    hsize_t dim[H5_DIMENSIONS_MAX];
    enum seal_kind kind = KIND_NONE;
    int n_dim;
    if (add_shape(w, type, space, name, &kind, dim, &n_dim)) {
        if (H5Tget_size(type) > BUFFER_BYTES || !h5_is_stored(dataset)) {
            h5_fail(w->h, "dataset '%s' is not all there", name);
        } else {
            add_blocks(w, dataset, dim, n_dim, type, kind);
        }
    }
    H5Tclose(type);
    H5Sclose(space);
}

// The values of a dataset have a checksum of their own, which counts in both.
static void add_result(struct walk *w, hid_t dataset, const char *name) {
    struct checksum_sum sum;
    struct checksum own;
    checksum_start(&sum);
    w->to = &sum;
    add_dataset(w, dataset, name);
    checksum_end(&sum, &own);
    checksum_add_text(&w->results, own.digits);
    checksum_add_text(&w->data, own.digits);
    w->to = &w->data;
    add_attributes(w, dataset);
}

static void add_name(struct walk *w, const char *name, uint64_t number) {
    checksum_add_text(&w->data, name);
    checksum_add_number(&w->data, number);
    checksum_add_text(&w->results, name);
    checksum_add_number(&w->results, number);
}

static void add_group(struct walk *w, hid_t group);

static herr_t visit_link(hid_t group, const char *name, const H5L_info_t *info, void *context) {
    struct walk *w = context;
    const hobj_ref_t address = address_of(w, group, name, info);
    struct object *o = address != 0 ? slot_of(w, address) : NULL;
    if (!o) {
        return -1;
    }
    add_name(w, name, o->number);
    if (o->added) {
        return 0;
    }
    o->added = true;
    hid_t object = h5_open_object(w->h, group, name);
    const H5I_type_t type = w->h->failed ? H5I_BADID : H5Iget_type(object);
    if (type == H5I_DATASET) {
        add_result(w, object, name);
    } else if (type == H5I_GROUP) {
        add_group(w, object);
    } else {
        h5_fail(w->h, "'%s' is neither a group nor a dataset", name);
    }
    h5_close(w->h, object);
    return w->h->failed ? -1 : 0;
}

static void add_group(struct walk *w, hid_t group) {
    if (w->depth == DEPTH_MAX) {
        h5_fail(w->h, "its groups are more than %d deep", DEPTH_MAX);
        return;
    }
    w->depth++;
    h5_failed(w->h, H5Literate(group, H5_INDEX_NAME, H5_ITER_INC, NULL, visit_link, w));
    w->depth--;
    add_name(w, "", 0);
    add_attributes(w, group);
}

// The checksums of the open file. An error is noted in `h`.
static void seal_find(struct h5 *h, struct result_sums *out) {
    struct walk w = {.h = h, .buffer = malloc(BUFFER_BYTES)};
    w.to = &w.data;
    checksum_start(&w.data);
    checksum_start(&w.results);
    if (!w.buffer) {
        h5_no_memory(h);
    }
    hid_t root = h5_open_object(h, h->file, "/");
    if (grow(&w) && !h->failed &&
        !h5_failed(h, H5Lvisit(root, H5_INDEX_NAME, H5_ITER_INC, number_object, &w))) {
        add_group(&w, root);
    }
    h5_close(h, root);
    checksum_end(&w.data, &out->data);
    checksum_end(&w.results, &out->results);
    free(w.object);
    free(w.buffer);
}

void seal_put(struct h5 *h) {
    struct result_sums sums;
    if (h->failed || h5_failed(h, H5Fflush(h->file, H5F_SCOPE_LOCAL))) {
        return;
    }
    h5_heap_open(h);
    seal_find(h, &sums);
    h5_heap_close(h);
    h5_put_text(h, h->file, seal_name, sums.data.digits);
}

int seal_check(struct h5 *h, struct result_sums *out) {
    struct h5_reference reference;
    struct checksum noted = {.digits = ""};
    size_t n;
    if (!h->failed && H5Aexists(h->file, seal_name) <= 0) {
        h5_fail(h,
                "it has no checksum of its data: an earlier version wrote it, or another program");
        return STATUS_INPUT;
    }
    h5_get_reference(h, h->file, seal_name, &reference);
    const char *text = h5_heap_get(h, &reference, 1, &n);
    memcpy(noted.digits, text, n < CHECKSUM_DIGITS ? n : CHECKSUM_DIGITS);
    seal_find(h, out);
    if (!h->failed && !checksum_equal(&noted, &out->data)) {
        h5_fail(h, "its data have changed since it was written: their checksum differs");
    }
    return !h->failed ? STATUS_OK : h5_lacks_memory(h) ? STATUS_SYSTEM : STATUS_FAILED;
}

int result_verify(const char *path, struct result_sums *out, struct error *e) {
    struct h5 h = {.file = -1, .lock = -1};
    int status = h5_check_file(path, e);
    if (status != STATUS_OK) {
        return status;
    }
    if (h5_start(&h) && H5Fis_hdf5(path) == 0) {
        return error_set(e, STATUS_INPUT, "%s is not an HDF5 file", path);
    }
    h5_open(&h, path, 0);
    status = !h.failed ? seal_check(&h, out) : h5_lacks_memory(&h) ? STATUS_SYSTEM : STATUS_INPUT;
    h5_close_types(&h);
    h5_close_file(&h);
    return status == STATUS_OK ? STATUS_OK : error_set(e, status, "%s: %s", path, h.cause);
}
