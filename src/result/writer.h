// SPDX-License-Identifier: GPL-3.0-or-later
// The writer's state, shared by writer.c (file and rows) and writer_tables.c (everything else).
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
    int n_dim;
    double *row;  // (capacity, width)
};

struct result_writer {
    struct h5 h;
    const struct model *model;  // borrowed
    struct report *report;      // owned
    char *path, *part;          // owned
    enum result_existing existing;
    hid_t time;  // the scale of all histories
    int n_stream, stream_capacity;
    struct stream *stream;  // owned
    double *rows;           // owned: the rows of all streams
    size_t capacity;        // rows
    size_t pending;         // rows in memory
    long n_written;         // rows in the file
};

// Creates everything that is known before the run, histories included, and adds their streams.
void writer_layout(struct result_writer *w);

// Writes everything that is known only after the run.
void writer_results(struct result_writer *w, const struct report *r);

// Creates a history and its stream.
void writer_stream(struct result_writer *w, hid_t parent, const struct h5_dataset *d,
                   struct stream s);

#endif
