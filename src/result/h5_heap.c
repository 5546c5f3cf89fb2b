// SPDX-License-Identifier: GPL-3.0-or-later
// Reads what has no length of its own, texts and lists of references: it lies in collections of the
// file's global heap ("HDF5 File Format Specification Version 3.0", III.E), and where it belongs
// there is a reference: length, address of the collection, number of the object in it.
//
// The library (1.10) trusts all three and the heap: over a damaged file it goes round for ever, or
// copies more than there is room for. So it is asked for the references only, unconverted.
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "core/arena.h"
#include "core/file.h"
#include "result/h5.h"

// Bytes of the head of a collection and of an object, the place of the size in both, and the
// multiple that objects are padded to.
enum { HEAD = 16, SIZE_AT = 8, PADDING = 8 };
// What is read of a sound file is in it once or twice, and collections of small objects, 64 KiB at
// most, may be looked at in turns.
enum { READ_TIMES = 4, LOOK_SHARE = 1024 };

static uint64_t number(const unsigned char *byte, int n) {
    uint64_t x = 0;
    while (n-- > 0) {
        x = x << 8 | byte[n];
    }
    return x;
}

// A conversion that leaves references unchanged, of type H5T_conv_t.
static herr_t keep(hid_t from, hid_t to, H5T_cdata_t *data, size_t n, size_t stride,
                   size_t other_stride, void *value, void *other, hid_t list) {
    (void)from, (void)to, (void)n, (void)stride, (void)other_stride;
    (void)value, (void)other, (void)list;
    data->need_bkg = H5T_BKG_NO;
    return 0;
}

// Where the file is, and its addresses start.
static void locate(struct h5 *h, struct h5_heap *heap) {
    size_t address = 0, length = 0;
    struct stat found;
    hid_t list = H5Fget_create_plist(h->file);
    if (h5_failed(h, list)) {
        return;
    }
    h5_failed(h, H5Pget_userblock(list, &heap->base));
    h5_failed(h, H5Pget_sizes(list, &address, &length));
    H5Pclose(list);
    if (h->failed) {
        return;
    }
    heap->file = h5_descriptor(h);
    if (address != sizeof(uint64_t) || length != sizeof(uint64_t) ||
        fstat(heap->file, &found) != 0) {
        h5_fail(h, "its addresses have not %zu bytes", sizeof(uint64_t));
        return;
    }
    heap->end = (uint64_t)found.st_size;
    heap->left = READ_TIMES * heap->end;
}

void h5_heap_open(struct h5 *h) {
    H5T_cdata_t *data = NULL;
    struct h5_heap *heap = &h->heap;
    heap->reference = H5Tcreate(H5T_OPAQUE, sizeof(struct h5_reference));
    if (h5_failed(h, heap->reference)) {
        return;
    }
    if (!H5Tfind(h->text, heap->reference, &data)) {  // not yet, by an earlier file
        h5_failed(h, H5Tregister(H5T_PERS_SOFT, "keep", h->text, heap->reference, keep));
    }
    locate(h, heap);
}

void h5_heap_close(struct h5 *h) {
    free(h->heap.bytes);
    if (h->heap.reference > 0) {
        H5Tclose(h->heap.reference);
    }
    h->heap = (struct h5_heap){.bytes = NULL};
}

static bool spend(struct h5 *h, uint64_t cost) {
    if (cost > h->heap.left) {
        h5_fail(h, "its texts are longer than the file");
        return false;
    }
    h->heap.left -= cost;
    return true;
}

static bool read_at(const struct h5_heap *heap, void *to, size_t n, uint64_t at) {
    return file_read(heap->file, to, n, (off_t)(heap->base + at)) == (ssize_t)n;
}

// The collection at an address, into heap->bytes.
static bool load(struct h5 *h, uint64_t address) {
    struct h5_heap *heap = &h->heap;
    unsigned char head[HEAD];
    if (heap->bytes && heap->address == address) {
        return true;
    }
    const bool inside = address < heap->end && heap->base < heap->end - address;
    if (!inside || !read_at(heap, head, HEAD, address) || memcmp(head, "GCOL\1", 5) != 0) {
        return false;
    }
    const uint64_t size = number(head + SIZE_AT, 8);
    if (size < HEAD || size > heap->end - heap->base - address || !spend(h, size / LOOK_SHARE)) {
        return false;
    }
    free(heap->bytes);
    heap->bytes = malloc(size);
    if (!heap->bytes) {
        h5_no_memory(h);
        return false;
    }
    heap->address = address;
    heap->size = size;
    heap->at = HEAD;
    return read_at(heap, heap->bytes, size, address);
}

// Looks for an object of the collection from *at on; its content, or NULL with *at at the end. The
// free space is object 0, and its head counts.
static const unsigned char *look(const struct h5_heap *heap, uint64_t object, uint64_t *at,
                                 uint64_t *size) {
    while (heap->size - *at >= HEAD) {
        const unsigned char *head = heap->bytes + *at;
        const uint64_t room = heap->size - *at - HEAD, found = number(head, 2);
        *size = number(head + SIZE_AT, 8);
        if (*size > room || found == 0) {
            break;
        }
        if (found == object) {
            return head + HEAD;
        }
        const uint64_t padded = (*size + PADDING - 1) / PADDING * PADDING;
        *at += HEAD + (padded < room ? padded : room);
    }
    *at = heap->size;
    return NULL;
}

// The same, from where the last one was found and then from the start.
static const unsigned char *find(struct h5 *h, uint64_t object, uint64_t *size) {
    struct h5_heap *heap = &h->heap;
    uint64_t at = heap->at;
    const unsigned char *found = look(heap, object, &at, size);
    if (!spend(h, (at - heap->at) / LOOK_SHARE)) {
        return NULL;
    }
    if (!found) {
        at = HEAD;
        found = look(heap, object, &at, size);
        found = spend(h, at / LOOK_SHARE) ? found : NULL;
    }
    heap->at = found ? at : HEAD;
    return found;
}

const void *h5_heap_get(struct h5 *h, const struct h5_reference *r, size_t item, size_t *n) {
    uint64_t size = 0;
    *n = (size_t)number(r->byte, 4);
    if (*n == 0 || h->failed) {
        *n = 0;
        return "";
    }
    const unsigned char *found =
        load(h, number(r->byte + 4, 8)) ? find(h, number(r->byte + 12, 4), &size) : NULL;
    if (!found || *n > size / item || !spend(h, *n * item)) {
        h5_fail(h, "a text or a list of scales is damaged");
        *n = 0;
        return "";
    }
    return found;
}

char *h5_heap_text(struct h5 *h, struct arena *a, const struct h5_reference *r) {
    size_t n;
    const char *found = h5_heap_get(h, r, 1, &n);
    char *text = h->failed ? NULL : arena_text(a, found, strnlen(found, n));
    if (!text) {
        h5_no_memory(h);
    }
    return text;
}
