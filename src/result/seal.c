// SPDX-License-Identifier: GPL-3.0-or-later
// A file is walked twice: first every object gets a number, in the order of the names, because
// references may lead to later objects. Then each link adds its name and the number of its object.
// The first link to an object adds its content too.
#include "result/seal.h"

#include <stdlib.h>
#include <string.h>

#include "core/checksum.h"
#include "core/hash.h"

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
    struct checksum_sum data, results;  // of everything; of the datasets outside of /origin
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

// Makes room for one more object.
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

// How values of a type are added: bytes, texts of any length, lists of references to dimension
// scales, users of such a scale. KIND_NONE: jostle does not write such a type.
enum seal_kind { KIND_NONE, KIND_BYTES, KIND_TEXT, KIND_SCALES, KIND_USES };

static enum seal_kind kind_of(hid_t type) {
    const H5T_class_t class = H5Tget_class(type);
    if (class == H5T_INTEGER || class == H5T_FLOAT || class == H5T_STRING) {
        return H5Tis_variable_str(type) > 0 ? KIND_TEXT : KIND_BYTES;
    }
    if (class == H5T_VLEN) {
        hid_t item = H5Tget_super(type);
        const bool is_list = item >= 0 && H5Tequal(item, H5T_STD_REF_OBJ) > 0;
        h5_drop(item);
        return is_list ? KIND_SCALES : KIND_NONE;
    }
    // The high-level library lists users of a scale as compounds of a reference and a number.
    const bool is_uses = class == H5T_COMPOUND && H5Tget_nmembers(type) == 2 &&
                         H5Tget_member_class(type, 0) == H5T_REFERENCE &&
                         H5Tget_member_class(type, 1) == H5T_INTEGER &&
                         H5Tget_member_offset(type, 1) + sizeof(int) <= H5Tget_size(type);
    return is_uses ? KIND_USES : KIND_NONE;
}

static void add_numbers(struct checksum_sum *to, const uint64_t *number, size_t n) {
    for (size_t i = 0; i < n; i++) {
        checksum_add_number(to, number[i]);
    }
}

// Adds everything about a type on which the values depend: where the bits of a number are and what
// they mean, as with another type the same bytes are other values.
static void add_type(struct checksum_sum *to, hid_t type, enum seal_kind kind) {
    const H5T_class_t class = H5Tget_class(type);
    add_numbers(to, (const uint64_t[]){(uint64_t)kind, (uint64_t) class}, 2);
    if (kind == KIND_BYTES) {
        checksum_add_number(to, H5Tget_size(type));
    }
    if (class == H5T_INTEGER || class == H5T_FLOAT) {
        H5T_pad_t low = H5T_PAD_ERROR, high = H5T_PAD_ERROR;
        H5Tget_pad(type, &low, &high);
        const uint64_t bits[] = {(uint64_t)H5Tget_order(type), H5Tget_precision(type),
                                 (uint64_t)H5Tget_offset(type), (uint64_t)low, (uint64_t)high};
        add_numbers(to, bits, sizeof bits / sizeof bits[0]);
    }
    if (class == H5T_INTEGER) {
        checksum_add_number(to, (uint64_t)H5Tget_sign(type));
    } else if (class == H5T_FLOAT) {
        size_t sign = 0, exponent = 0, n_exponent = 0, mantissa = 0, n_mantissa = 0;
        H5Tget_fields(type, &sign, &exponent, &n_exponent, &mantissa, &n_mantissa);
        const uint64_t fields[] = {sign, exponent, n_exponent, mantissa, n_mantissa};
        const uint64_t rules[] = {H5Tget_ebias(type), (uint64_t)H5Tget_norm(type),
                                  (uint64_t)H5Tget_inpad(type)};
        add_numbers(to, fields, sizeof fields / sizeof fields[0]);
        add_numbers(to, rules, sizeof rules / sizeof rules[0]);
    } else if (class == H5T_STRING) {
        const uint64_t text[] = {(uint64_t)H5Tget_cset(type), (uint64_t)H5Tget_strpad(type)};
        add_numbers(to, text, 2);
    }
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

// Adds `n` values as they were read.
static void add_values(struct walk *w, hid_t type, enum seal_kind kind, const void *value,
                       size_t n) {
    const size_t size = H5Tget_size(type);
    if (kind == KIND_BYTES) {
        checksum_add(w->to, value, n * size);
        return;
    }
    for (size_t i = 0; i < n && !w->h->failed; i++) {
        if (kind == KIND_USES) {
            const unsigned char *use = (const unsigned char *)value + i * size;
            add_reference(w, use + H5Tget_member_offset(type, 0));
            checksum_add(w->to, use + H5Tget_member_offset(type, 1), sizeof(int));
            continue;
        }
        const size_t item = kind == KIND_TEXT ? 1 : sizeof(hobj_ref_t);
        const struct h5_reference *reference = (const struct h5_reference *)value + i;
        size_t n_item;
        const unsigned char *list = h5_heap_get(w->h, reference, item, &n_item);
        checksum_add_number(w->to, n_item);
        if (kind == KIND_TEXT) {
            checksum_add(w->to, list, n_item);
        }
        for (size_t k = 0; kind == KIND_SCALES && k < n_item; k++) {
            add_reference(w, list + k * item);
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
    *kind = kind_of(type);
    *n_dim = H5Sget_simple_extent_ndims(space);
    if (*kind == KIND_NONE || *n_dim < 0 || *n_dim > H5_DIMENSIONS_MAX ||
        H5Sget_simple_extent_dims(space, dim, NULL) != *n_dim) {
        h5_fail(w->h, "'%s' is of a kind that jostle does not write", name);
        return false;
    }
    add_type(w->to, type, *kind);
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

static void add_dataset(struct walk *w, hid_t dataset, const char *name) {
    hid_t type = H5Dget_type(dataset), space = H5Dget_space(dataset);
    hsize_t dim[H5_DIMENSIONS_MAX], n = 1;
    enum seal_kind kind = KIND_NONE;
    int n_dim;
    const bool added = add_shape(w, type, space, name, &kind, dim, &n_dim);
    if (added && (H5Tget_size(type) > BUFFER_BYTES || !h5_is_stored(dataset))) {
        h5_fail(w->h, "dataset '%s' is not all there", name);
    }
    for (int i = 0; added && i < n_dim; i++) {
        n *= dim[i];
    }
    const hid_t memory = type_in_memory(w, type, kind);
    hsize_t most = w->h->failed ? 0 : BUFFER_BYTES / H5Tget_size(memory);
    if (n > most && !w->h->failed) {
        // Whole chunks if that is possible, so that none is unpacked twice.
        hsize_t chunk[H5_DIMENSIONS_MAX], values = 1;
        hid_t list = H5Dget_create_plist(dataset);
        const bool in_chunks =
            H5Pget_layout(list) == H5D_CHUNKED && H5Pget_chunk(list, n_dim, chunk) == n_dim;
        H5Pclose(list);
        for (int i = 0; in_chunks && i < n_dim; i++) {
            values *= chunk[i];
        }
        most -= values > 0 && values <= most ? most % values : 0;
    }
    for (hsize_t first = 0; first < n && !w->h->failed;) {
        const struct h5_box box = h5_box(dim, n_dim, first, most);
        h5_get_box(w->h, dataset, box.n == n ? NULL : &box, memory, w->buffer);
        add_values(w, type, kind, w->buffer, w->h->failed ? 0 : (size_t)box.n);
        first += box.n;
    }
    H5Tclose(type);
    H5Sclose(space);
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
        // The values of a dataset have a checksum of their own, which counts in both.
        struct checksum_sum sum;
        struct checksum own;
        checksum_start(&sum);
        w->to = &sum;
        add_dataset(w, object, name);
        checksum_end(&sum, &own);
        checksum_add_text(&w->results, own.digits);
        checksum_add_text(&w->data, own.digits);
        w->to = &w->data;
        add_attributes(w, object);
    } else if (type == H5I_GROUP) {
        const struct checksum_sum before = w->results;
        add_group(w, object);
        w->results = w->depth == 1 && !strcmp(name, "origin") ? before : w->results;
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
    struct walk w = {.h = h, .to = &w.data, .buffer = malloc(BUFFER_BYTES)};
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

#define NO_SEAL                                                                                    \
    "%s: it has no checksum of its data: an earlier version wrote it, or another program"
#define BROKEN_SEAL "%s: its data have changed since it was written: their checksum differs"

int seal_check(struct h5 *h, const char *path, struct result_sums *out, struct error *e) {
    struct h5_reference reference;
    struct checksum noted = {.digits = ""};
    size_t n;
    if (!h->failed && H5Aexists(h->file, seal_name) <= 0) {
        return error_set(e, STATUS_INPUT, NO_SEAL, path);
    }
    h5_get_reference(h, h->file, seal_name, &reference);
    const char *text = h5_heap_get(h, &reference, 1, &n);
    memcpy(noted.digits, text, n < CHECKSUM_DIGITS ? n : CHECKSUM_DIGITS);
    seal_find(h, out);
    if (h->failed) {
        return h5_damaged(h, path, e);
    }
    return checksum_equal(&noted, &out->data) ? STATUS_OK
                                              : error_set(e, STATUS_FAILED, BROKEN_SEAL, path);
}
