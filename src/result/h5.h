// SPDX-License-Identifier: GPL-3.0-or-later
// The little of HDF5 that the writer and the reader need. Errors stick: after the first failure,
// whose cause is kept, every call does nothing, so that callers check once.
#ifndef JOSTLE_H5_H
#define JOSTLE_H5_H

#include <hdf5.h>
#include <stdbool.h>

#include "jostle/deck.h"
#include "jostle/units.h"
#include "result/layout.h"

enum { H5_CAUSE_MAX = 256, H5_DIMENSIONS_MAX = STUDY_SWEEPS_MAX + 1 };
struct arena;
struct h5_use;

// The chunks of a dataset.
struct h5_chunk {
    int n_dim;
    hsize_t rows, width;
    int compress;  // level of deflate; 0: none
};

// A reference to an object of the global heap, as the file stores it.
struct h5_reference {
    unsigned char byte[16];
};

// The global heap of a file, and the collection of it that was read last.
struct h5_heap {
    hid_t reference;       // type of a reference
    int file;              // the library's
    hsize_t base;          // where the addresses of the file start
    uint64_t end;          // size of the file
    uint64_t left;         // of what may be read
    unsigned char *bytes;  // (size) of the collection; heap
    uint64_t address, size;
    uint64_t at;  // the object found last
};

struct h5 {
    hid_t file;
    const char *read_path;        // borrowed: of a file that is read; NULL: it is written
    int lock;                     // descriptor that keeps the lock of a file that is written
    hid_t text;                   // type of texts: UTF-8, any length
    hid_t references;             // type of lists of references to objects
    hid_t scalar;                 // space of an attribute
    hid_t plain, compact, group;  // creation lists of contiguous datasets, of small ones, of groups
    hid_t chunked;                // of the last dataset in chunks, which was like `chunk`
    struct h5_chunk chunk;
    hid_t access;                     // of datasets in chunks
    hid_t transfer;                   // for writing, and for reading whole datasets
    const struct unit_system *units;  // borrowed
    struct h5_heap heap;              // for reading
    // For reading: dimensions in front of lists of values, in each of which these are read.
    int n_front;
    hsize_t front[H5_DIMENSIONS_MAX];
    bool ended_early;    // the run there has failed: values are NaN, and whole numbers read as 0
    uint64_t taken;      // by h5_take [bytes]
    struct h5_use *use;  // (n_use) of scales; heap
    size_t n_use, use_capacity;
    unsigned n_ask;  // calls of h5_has_room
    void *reserve;   // heap; NULL: it is spent
    bool failed;
    char cause[H5_CAUSE_MAX];
};

// A dataset to be created. Attributes units and long_name come from `quantity`.
struct h5_dataset {
    const char *name;
    struct quantity quantity;
    hid_t memory_type, file_type;
    int n_dim;
    hsize_t dim[H5_DIMENSIONS_MAX];
    hid_t scale[H5_DIMENSIONS_MAX];  // dimension scale of each dimension; 0: none, or it becomes
                                     // one itself
    hsize_t chunk_rows;  // 0: contiguous; otherwise rows of a chunk, unwritten rows read as NaN
    int compress;        // level of deflate for chunks; 0: none
    bool many_users;     // a scale that thousands of datasets refer to
    bool may_be_cut;     // h5_cut may follow; it needs chunk_rows
};

// The library crashes when memory runs out. Checks that there is memory for its next call; false,
// with a failure recorded: there is none.
bool h5_has_room(struct h5 *h);

// Records the failure that memory has run out. h5_lacks_memory: true if this is the failure.
void h5_no_memory(struct h5 *h);

// Limit of the memory [bytes] for all values of the open file, because compression can hide a
// thousand times the size of the file. h5_take counts `n` objects of `size` bytes; false, with a
// failure recorded: they exceed the limit.
uint64_t h5_memory_limit(const struct h5 *h);
bool h5_take(struct h5 *h, size_t n, size_t size);

// Zeroed objects, by h5_take, and a copy of a text in an arena; NULL: no memory, which is a
// failure.
void *h5_alloc(struct h5 *h, struct arena *a, size_t n, size_t size);
char *h5_copy(struct h5 *h, struct arena *a, const char *text);
bool h5_lacks_memory(const struct h5 *h);

// The error of a file that could not be read: STATUS_INPUT ("PATH is damaged: " and the cause),
// STATUS_SYSTEM (no memory).
int h5_damaged(const struct h5 *h, const char *path, struct error *e);

// Starts the library before a file is opened, if h5_has_room. Turns off its own error messages and
// its work at exit. The start takes longer than reading a deck.
bool h5_start(struct h5 *h);

// Checks that there is a regular file that can be read. Errors: STATUS_INPUT (none, or another kind
// of file), STATUS_SYSTEM.
int h5_check_file(const char *path, struct error *e);

// Frees the memory that h5_create sets aside for closing the file, as the first failure does.
void h5_spend_reserve(struct h5 *h);

// Creates the file, which must not be there, and locks it; h->file is negative if that failed.
void h5_create(struct h5 *h, const char *path);
void h5_unlock(struct h5 *h);
// The descriptor of the open file.
int h5_descriptor(struct h5 *h);
// Opens a file for reading, with buffers of `sieve` bytes for each dataset that is read piece by
// piece.
void h5_open(struct h5 *h, const char *path, size_t sieve);
void h5_close_types(struct h5 *h);
void h5_close_file(struct h5 *h);  // after all its objects; does nothing if there is none

// Records the first failure when `result` is negative; true if anything has failed so far.
bool h5_failed(struct h5 *h, long long result);
void h5_fail(struct h5 *h, const char *format, ...) __attribute__((format(printf, 2, 3)));

// Creates a group; it is open, -1 after a failure.
hid_t h5_group(struct h5 *h, hid_t parent, const char *name);
void h5_close(struct h5 *h, hid_t object);  // a group or dataset; negative is allowed
// Gives back an identifier of any kind, a type, space or list; 0 and negative ones are allowed.
void h5_drop(hid_t id);
// Gives the object another name, in the group `parent`.
void h5_hard_link(struct h5 *h, hid_t object, hid_t parent, const char *name);

// Attributes. A text replaces one that is there.
void h5_put_text(struct h5 *h, hid_t object, const char *name, const char *text);
void h5_put_long(struct h5 *h, hid_t object, const char *name, long value);
void h5_put_double(struct h5 *h, hid_t object, const char *name, double value);

// The open dataset; -1 after a failure.
hid_t h5_dataset(struct h5 *h, hid_t parent, const struct h5_dataset *d);
// Makes scale[i] the scale of dimension i of the open dataset (n_dim); 0: none.
void h5_attach(struct h5 *h, hid_t dataset, const hid_t *scale, int n_dim);
// Writes into each scale the list of the datasets that use it. A list is written once, so all
// datasets of a scale must exist.
void h5_list_uses(struct h5 *h);
// True if the open dataset is a scale; if it has floating-point numbers.
bool h5_is_scale(hid_t dataset);
bool h5_is_number(hid_t dataset);
// The first scale of a dimension of the open dataset (n_dim), open.
hid_t h5_get_scale(struct h5 *h, hid_t dataset, int n_dim, int dimension);
// Creates, writes and closes.
void h5_put(struct h5 *h, hid_t parent, const struct h5_dataset *d, const void *data);
// Creates the dimension scale `name` with the numbers 1..n; open.
hid_t h5_put_scale(struct h5 *h, hid_t parent, const char *name, const char *long_name, size_t n);
// A box of a dataset: `n` values, or rows of values.
struct h5_box {
    hsize_t start[H5_DIMENSIONS_MAX], count[H5_DIMENSIONS_MAX];
    hsize_t n;
};
// The box of a dataset with dimensions `dim` (n_dim) that starts at value `first`, in the order of
// rows, and holds at most `most` >= 1 values that follow one another.
struct h5_box h5_box(const hsize_t *dim, int n_dim, hsize_t first, hsize_t most);

// Shortens a dataset that `may_be_cut` to so many rows.
void h5_cut(struct h5 *h, hid_t dataset, size_t rows);

// Write and read the values of a box, NULL: all, which are of `type` in memory; the library
// converts them.
void h5_put_box(struct h5 *h, hid_t dataset, const struct h5_box *box, hid_t type,
                const void *value);
void h5_get_box(struct h5 *h, hid_t dataset, const struct h5_box *box, hid_t type, void *value);

// Write and read a box of `n_front` dimensions in which each value is a row of `width` values. In
// memory the rows are `stride` numbers apart.
void h5_put_columns(struct h5 *h, hid_t dataset, struct h5_box box, int n_front, size_t width,
                    size_t stride, const double *value);
void h5_get_columns(struct h5 *h, hid_t dataset, struct h5_box box, int n_front, size_t width,
                    size_t stride, double *value);

// The content of a reference: *n items of `item` bytes, valid until the next call; none after a
// failure.
const void *h5_heap_get(struct h5 *h, const struct h5_reference *r, size_t item, size_t *n);
// A text, from `a`; NULL after a failure.
char *h5_heap_text(struct h5 *h, struct arena *a, const struct h5_reference *r);
void h5_heap_open(struct h5 *h);
void h5_heap_close(struct h5 *h);

// The open object at a path.
hid_t h5_open_object(struct h5 *h, hid_t parent, const char *path);

// Column `c` of the `n` structs at `base`, as a dataset.
void h5_put_column(struct h5 *h, hid_t parent, const struct column_table *t, int c,
                   const void *base, size_t n, hid_t scale);
// A member as an attribute.
void h5_put_member(struct h5 *h, hid_t object, const struct column_table *t, int c,
                   const void *base);

// Reading; texts and arrays are from `a`.
bool h5_has(struct h5 *h, hid_t parent, const char *name);

// True if the file has as many bytes of the dataset as its shape promises. If not, it is damaged,
// and the library would read beyond them.
bool h5_is_stored(hid_t dataset);
hid_t h5_get_group(struct h5 *h, hid_t parent, const char *name);
// The text of an attribute, and the reference to it.
char *h5_get_text(struct h5 *h, struct arena *a, hid_t object, const char *name);
void h5_get_reference(struct h5 *h, hid_t object, const char *name, struct h5_reference *out);
// A text without control characters or stray bytes, such as a unit.
char *h5_get_line(struct h5 *h, struct arena *a, hid_t object, const char *name);
long h5_get_long(struct h5 *h, hid_t object, const char *name);
double h5_get_double(struct h5 *h, hid_t object, const char *name);
// The units of a file, from its attributes.
void h5_get_units(struct h5 *h, struct arena *a, struct unit_system *units);
// Lists of values are datasets of one dimension, or of n_front dimensions in front of that one.
// Length of a list; checked to be at most `limit`.
size_t h5_get_length(struct h5 *h, hid_t parent, const char *name, size_t limit);
// The `n` texts of a list.
char **h5_get_texts(struct h5 *h, struct arena *a, hid_t parent, const char *name, size_t n);
// The `n` values of a list as doubles.
double *h5_get_doubles(struct h5 *h, struct arena *a, hid_t parent, const char *name, size_t n);
// Read what h5_put_column and h5_put_member wrote.
void h5_get_column(struct h5 *h, struct arena *a, hid_t parent, const struct column_table *t, int c,
                   void *base, size_t n);
void h5_get_member(struct h5 *h, struct arena *a, hid_t object, const struct column_table *t, int c,
                   void *base);

#endif
