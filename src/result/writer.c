// SPDX-License-Identifier: GPL-3.0-or-later
// The rows of a run, streamed through a buffer, and the order in which its tree is written.
#include "result/writer.h"

#include <assert.h>
#include <stdlib.h>
#include <string.h>

#include "core/arena.h"

enum { ROWS_MAX = 4096 };
static const size_t bytes_max = (size_t)64 << 20;

int writer_failed(const struct result_writer *w, struct error *e) {
    return error_set(e, STATUS_SYSTEM, "cannot write %s: %s", w->path, w->h->cause);
}

void writer_stream(struct result_writer *w, hid_t parent, const struct h5_dataset *d,
                   struct stream s) {
    assert(w->n_stream < w->stream_capacity);
    s.dataset = h5_dataset(w->h, parent, d);
    s.n_dim = d->n_dim;
    if (s.dataset >= 0) {
        w->stream[w->n_stream++] = s;
    }
}

// Values of all streams in one row, and how many streams there are at most.
static size_t row_width(const struct model *m) {
    return (size_t)m->n_dof * FLOOR_FIELD_COUNT + 2 * (size_t)m->n_link + (size_t)m->n_ground +
           ENERGY_COUNT + 1;
}

static int stream_limit(const struct model *m) {
    return m->n_building * FLOOR_FIELD_COUNT + 4 + m->n_ground + ENERGY_COUNT + 1;
}

static bool allocate(struct result_writer *w) {
    const size_t width = row_width(w->model);
    w->capacity = bytes_max / (width * sizeof(double));
    w->capacity = w->capacity < 1 ? 1 : w->capacity > ROWS_MAX ? ROWS_MAX : w->capacity;
    assert(width > 0 && w->report->n_row > 0);
    if ((size_t)w->report->n_row < w->capacity) {
        w->capacity = (size_t)w->report->n_row;
    }
    w->rows = malloc(w->capacity * width * sizeof *w->rows);
    w->stream_capacity = stream_limit(w->model);
    w->stream = calloc((size_t)w->stream_capacity, sizeof *w->stream);
    return w->rows && w->stream;
}

static void place_streams(struct result_writer *w) {
    double *row = w->rows;
    for (int i = 0; i < w->n_stream; i++) {
        w->stream[i].row = row;
        row += w->capacity * w->stream[i].width;
    }
}

int writer_alloc(struct result_writer *w, const struct result_options *o, struct error *e) {
    int status = report_create(w->model, NULL, o->path, o->version, &w->report, e);
    if (status != STATUS_OK) {
        return status;
    }
    const char *line = o->command_line ? o->command_line : "";
    w->report->command_line = arena_text(w->report->arena, line, strlen(line));
    return w->report->command_line && allocate(w) ? STATUS_OK : error_no_memory(e);
}

bool writer_in_blocks(const struct result_writer *w) {
    return (size_t)w->report->n_row > w->capacity;
}

// A file of its own that comes in blocks can be read if the run is killed.
static void synchronise(struct result_writer *w) {
    if (!w->h->failed && w->h == &w->own && writer_in_blocks(w)) {
        h5_failed(w->h, H5Fflush(w->h->file, H5F_SCOPE_LOCAL));
    }
}

static void put_rows(struct result_writer *w, const struct stream *s) {
    if (writer_in_blocks(w)) {
        h5_put_rows(w->h, s->dataset, (hsize_t)w->n_written, w->pending,
                    s->n_dim == 2 ? s->width : 0, s->row);
    } else {
        h5_put_all(w->h, s->dataset, H5T_NATIVE_DOUBLE, s->row);
    }
}

static int flush(struct result_writer *w, struct error *e) {
    for (int i = 0; i < w->n_stream && w->pending > 0; i++) {
        if (w->stream[i].width > 0) {
            put_rows(w, &w->stream[i]);
        }
    }
    synchronise(w);
    w->n_written += (long)w->pending;
    w->pending = 0;
    return w->h->failed ? writer_failed(w, e) : STATUS_OK;
}

int writer_start(struct result_writer *w, struct error *e) {
    writer_layout(w);
    place_streams(w);
    return flush(w, e);
}

static int write_row(void *context, const struct row_view *row, struct error *e) {
    struct result_writer *w = context;
    assert(w->n_written + (long)w->pending < w->report->n_row);
    const double *const from[SOURCE_COUNT] = {
        row->displacement, row->velocity,    row->acceleration, row->drift,  row->storey_shear,
        row->force,        row->penetration, &row->time,        row->ground, row->energy,
    };
    for (int i = 0; i < w->n_stream; i++) {
        const struct stream *s = &w->stream[i];
        if (s->width > 0) {
            memcpy(s->row + w->pending * s->width, from[s->source] + s->first,
                   s->width * sizeof(double));
        }
    }
    w->pending++;
    return w->pending == w->capacity ? flush(w, e) : STATUS_OK;
}

struct observer result_observer(struct result_writer *w) {
    return (struct observer){.row = write_row, .context = w};
}

int writer_end(struct result_writer *w, const struct results *r, struct error *e) {
    assert(w->n_written + (long)w->pending == w->report->n_row);
    struct report *report = NULL;
    int status = flush(w, e);
    if (status == STATUS_OK) {
        status = report_create(w->model, r, w->path, w->report->version, &report, e);
    }
    if (status != STATUS_OK) {
        return status;
    }
    writer_results(w, report);
    report_free(report);
    h5_list_uses(w->h);
    synchronise(w);
    if (!w->place) {
        h5_put_text(w->h, w->root, "status", "complete");
    }
    synchronise(w);
    return w->h->failed ? writer_failed(w, e) : STATUS_OK;
}

void writer_close_streams(struct result_writer *w) {
    for (int i = 0; i < w->n_stream; i++) {
        h5_close(w->h, w->stream[i].dataset);
    }
    w->n_stream = 0;
}
