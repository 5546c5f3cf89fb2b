// SPDX-License-Identifier: GPL-3.0-or-later
// The writer of a run, shared by writer.c (the file and its rows) and writer_tree.c (all else).
#ifndef JOSTLE_WRITER_H
#define JOSTLE_WRITER_H

#include "result/tree.h"

// Where in a row_view the values of a stream come from. The first seven are in the order of the
// bits of enum field.
enum row_source {
    SOURCE_FLOOR_FIELD = 0,
    SOURCE_FORCE = FLOOR_FIELD_COUNT,
    SOURCE_PENETRATION,
    SOURCE_TIME,
    SOURCE_GROUND,
    SOURCE_ENERGY,
    SOURCE_MEMBER_FORCE,
    SOURCE_COUNT
};

// One history dataset and its rows not yet written.
struct stream {
    hid_t dataset;
    int source;    // enum row_source
    size_t first;  // of its values in the source
    size_t width;  // values a row
    double *row;   // (capacity, width)
};

struct result_writer {
    struct h5 *h;               // `own`, or borrowed from a study
    hid_t root;                 // the group that holds everything
    const struct model *model;  // borrowed
    struct report *report;      // owned: before the run
    struct tree tree;           // of its groups
    int n_stream, stream_capacity;
    struct stream *stream;             // owned
    double *rows;                      // owned: the rows of all streams
    size_t capacity;                   // rows
    size_t pending;                    // rows in memory
    long n_written;                    // rows in the file
    const struct result_place *place;  // borrowed; NULL: in a file of its own
    const struct observer *watch;      // borrowed: whom result_analyse asks whether to go on

    // Of a file of its own.
    struct h5 own;
    char *partial;  // in the report's arena
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
