// SPDX-License-Identifier: GPL-3.0-or-later
// The writer's state, shared by writer.c (rows), writer_tables.c and writer_results.c (everything
// else), and writer_file.c (the file).
#ifndef JOSTLE_WRITER_H
#define JOSTLE_WRITER_H

#include "result/h5.h"

// Where in a row_view the values of a stream come from. The first seven are in the order of the
// bits of enum field.
enum row_source {
    SOURCE_FLOOR_FIELD = 0,
    SOURCE_FORCE = FLOOR_FIELD_COUNT,
    SOURCE_PENETRATION,
    SOURCE_TIME,
    SOURCE_GROUND,
    SOURCE_ENERGY,
    SOURCE_COUNT
};

// One history dataset and its rows not yet written.
struct stream {
    hid_t dataset;
    int source;    // enum row_source
    size_t first;  // of its values in the source
    size_t width;  // values a row
    int n_dim;     // of the dataset: 1 or 2
    double *row;   // (capacity, width)
};

struct result_writer {
    struct h5 *h;               // `own`, or borrowed from a study
    hid_t root;                 // the group that holds everything
    const struct model *model;  // borrowed
    struct report *report;      // owned
    hid_t time;                 // the scale of all histories
    int n_stream, stream_capacity;
    struct stream *stream;  // owned
    double *rows;           // owned: the rows of all streams
    size_t capacity;        // rows
    size_t pending;         // rows in memory
    long n_written;         // rows in the file

    // Of a file of its own.
    const struct result_place *place;  // borrowed; NULL: in a file of its own
    struct h5 own;
    char *path, *draft;  // owned
    enum result_existing existing;
};

// A group of the file of a study that is being written, for one of its runs.
struct result_place {
    struct h5 *h;
    hid_t group;
    const char *path;                  // of the file, for messages
    const struct sweep *const *sweep;  // (n_sweep) dimensions of the file
    int n_sweep;
};

// Report and room for the rows of the model of `w`. Errors: STATUS_SYSTEM (no memory).
int writer_alloc(struct result_writer *w, const struct result_options *o, struct error *e);
// Creates everything that is known before the run in w->root.
int writer_start(struct result_writer *w, struct error *e);
// Writes the rows left and everything that is known after the run, and marks it complete.
int writer_end(struct result_writer *w, const struct results *r, struct error *e);
// Closes the histories.
void writer_close_streams(struct result_writer *w);
int writer_failed(const struct result_writer *w, struct error *e);

// Creates everything that is known before the run, histories included, and adds their streams.
void writer_layout(struct result_writer *w);

// Writes everything that is known only after the run.
void writer_results(struct result_writer *w, const struct report *r);

// Do the rows come in several blocks? If not, all are written at the end.
bool writer_in_blocks(const struct result_writer *w);

// Creates a history and its stream.
void writer_stream(struct result_writer *w, hid_t parent, const struct h5_dataset *d,
                   struct stream s);

#endif
