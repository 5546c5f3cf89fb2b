// SPDX-License-Identifier: GPL-3.0-or-later
// The result of a run: a file made as PATH.part and named PATH when complete, or a place in the
// file of a study. Its rows are streamed through a buffer.
#include "result/writer.h"

#include <assert.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "core/arena.h"
#include "result/h5_partial.h"
#include "result/seal.h"

enum { ROWS_MAX = 4096 };
static const size_t bytes_max = (size_t)64 << 20;

static int cannot_write(const struct result_writer *w, struct error *e) {
    return error_set(e, STATUS_SYSTEM, "cannot write %s: %s", w->report->file, w->h->cause);
}

void writer_stream(struct result_writer *w, hid_t parent, const struct h5_dataset *d,
                   struct stream s) {
    assert(w->n_stream < w->stream_capacity);
    s.dataset = h5_dataset(w->h, parent, d);
    if (s.dataset >= 0) {
        w->stream[w->n_stream++] = s;
    }
}

static void close_streams(struct result_writer *w) {
    for (int i = 0; i < w->n_stream; i++) {
        h5_close(w->h, w->stream[i].dataset);
    }
    w->n_stream = 0;
}

static void writer_free(struct result_writer *w) {
    close_streams(w);
    if (!w->place) {
        h5_close_types(w->h);
        h5_close_file(w->h);
        h5_unlock(w->h);
    }
    report_free(w->report);
    free(w->rows);
    free(w->stream);
    free(w);
}

void result_abort(struct result_writer *w) {
    if (!w) {
        return;
    }
    if (w->own.file >= 0) {
        unlink(w->partial);
    }
    h5_spend_reserve(&w->own);
    writer_free(w);
}

bool writer_in_blocks(const struct result_writer *w) {
    return (size_t)w->report->n_row > w->capacity;
}

// A file of its own that comes in blocks can be read if the run is killed.
static void synchronise(struct result_writer *w) {
    if (!w->h->failed && !w->place && writer_in_blocks(w)) {
        h5_failed(w->h, H5Fflush(w->h->file, H5F_SCOPE_LOCAL));
    }
}

static int flush(struct result_writer *w, struct error *e) {
    for (int i = 0; i < w->n_stream && w->pending > 0; i++) {
        const struct stream *s = &w->stream[i];
        const struct h5_box box = {.start = {(hsize_t)w->n_written},
                                   .count = {w->pending, s->width}};
        if (s->width > 0) {
            const bool all = w->pending == (size_t)w->report->n_row;
            h5_put_box(w->h, s->dataset, all ? NULL : &box, H5T_NATIVE_DOUBLE, s->row);
        }
    }
    synchronise(w);
    w->n_written += (long)w->pending;
    w->pending = 0;
    return w->h->failed ? cannot_write(w, e) : STATUS_OK;
}

static int write_row(void *context, const struct row_view *row, struct error *e) {
    struct result_writer *w = context;
    assert(w->n_written + (long)w->pending < w->report->n_row);
    const double *const from[SOURCE_COUNT] = {
        row->displacement, row->velocity, row->acceleration, row->drift,
        row->storey_shear, row->force,    row->penetration,  &row->time,
        row->ground,       row->energy,   row->member_force,
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

// Report and room for the rows of the model.
static int allocate(struct result_writer *w, const struct result_options *o, struct error *e) {
    const struct model *m = w->model;
    int status = report_create(m, NULL, o->path, o->version, &w->report, e);
    if (status != STATUS_OK) {
        return status;
    }
    // Values of all streams in one row, and how many streams there are at most.
    const size_t width = (size_t)m->n_dof * FLOOR_FIELD_COUNT + 2 * (size_t)m->n_link +
                         (size_t)m->n_ground + ENERGY_COUNT + 1 + (size_t)m->n_force;
    w->stream_capacity = m->n_building * FLOOR_FIELD_COUNT + 4 + m->n_ground + ENERGY_COUNT + 1;
    for (int i = 0; i < m->n_building; i++) {
        const struct building *b = &m->building[i], *own = b->fixed ? b->fixed : b;
        w->stream_capacity +=
            1 + own->n_part * (1 + MEMBER_QUANTITIES) + (b->fixed ? FOUNDATION_QUANTITIES : 0);
    }
    w->capacity = bytes_max / (width * sizeof(double));
    w->capacity = w->capacity < 1 ? 1 : w->capacity > ROWS_MAX ? ROWS_MAX : w->capacity;
    assert(w->report->n_row > 0);
    if ((size_t)w->report->n_row < w->capacity) {
        w->capacity = (size_t)w->report->n_row;
    }
    struct arena *a = w->report->arena;
    const char *line = o->command_line ? o->command_line : "";
    w->report->command_line = arena_text(a, line, strlen(line));
    w->partial = arena_format(a, "%s.part", o->path);
    w->rows = malloc(w->capacity * width * sizeof *w->rows);
    w->stream = calloc((size_t)w->stream_capacity, sizeof *w->stream);
    return w->report->command_line && w->partial && w->rows && w->stream ? STATUS_OK
                                                                         : error_no_memory(e);
}

// Makes the file, if it is one of its own, and writes what is known before the run.
static int begin(struct result_writer *w, const struct result_options *o, struct error *e) {
    int status = allocate(w, o, e);
    if (status == STATUS_OK && !w->place) {
        status = h5_partial_check(w->report, o, e);
        status = status == STATUS_OK ? h5_partial_create(w->h, o->path, w->partial, e) : status;
        w->root = w->h->file;
    }
    if (status != STATUS_OK) {
        return status;
    }
    writer_layout(w);
    double *row = w->rows;
    for (int i = 0; i < w->n_stream; i++) {
        w->stream[i].row = row;
        row += w->capacity * w->stream[i].width;
    }
    return flush(w, e);
}

static int create(const struct model *m, const struct result_place *place,
                  const struct result_options *o, struct result_writer **out, struct error *e) {
    struct result_writer *w = calloc(1, sizeof *w);
    if (!w) {
        return error_no_memory(e);
    }
    w->model = m;
    w->place = place;
    w->own = (struct h5){.file = -1, .lock = -1, .units = &m->deck->units};
    w->h = place ? place->h : &w->own;
    w->root = place ? place->group : -1;
    w->tree.h = w->h;
    w->existing = o->existing;
    const int status = begin(w, o, e);
    if (status != STATUS_OK) {
        result_abort(w);
        return status;
    }
    *out = w;
    return STATUS_OK;
}

int result_create(const struct model *m, const struct result_options *options,
                  struct result_writer **out, struct error *e) {
    return create(m, NULL, options, out, e);
}

int result_create_in(const struct result_place *place, const struct model *m, const char *version,
                     struct result_writer **out, struct error *e) {
    return create(m, place, &(struct result_options){.path = place->path, .version = version}, out,
                  e);
}

// Writes the rows left and everything that is known after the run, and marks it complete.
static int end(struct result_writer *w, const struct results *r, struct error *e) {
    assert(w->n_written + (long)w->pending == w->report->n_row || r->collapse.happened);
    struct report *report = NULL;
    int status = flush(w, e);
    if (status == STATUS_OK) {
        status = report_create(w->model, r, w->report->file, w->report->version, &report, e);
    }
    if (status != STATUS_OK) {
        return status;
    }
    // The histories of a run that has collapsed end with its last row.
    for (int i = 0; i < w->n_stream && w->n_written < w->report->n_row; i++) {
        h5_cut(w->h, w->stream[i].dataset, (size_t)w->n_written);
    }
    writer_results(w, report);
    report_free(report);
    h5_list_uses(w->h);
    synchronise(w);
    if (!w->place) {
        h5_put_text(w->h, w->root, "status", "complete");
    }
    synchronise(w);
    return w->h->failed ? cannot_write(w, e) : STATUS_OK;
}

int result_finish(struct result_writer *w, const struct results *r, struct error *e) {
    int status = end(w, r, e);
    if (!w->place && status == STATUS_OK) {
        close_streams(w);
        seal_put(w->h);
        h5_close_types(w->h);
        h5_close_file(w->h);  // the library reports a full disk as late as here
        status = w->h->failed ? cannot_write(w, e) : STATUS_OK;
    }
    if (!w->place && status == STATUS_OK) {
        status = result_publish(w->h->lock, w->partial, w->report->file, w->existing, e);
    } else if (!w->place) {
        unlink(w->partial);
    }
    writer_free(w);
    return status;
}

// Asks the observer of result_analyse whether the analysis goes on.
static int poll(void *context, double time, struct error *e) {
    const struct result_writer *w = context;
    return w->watch->poll(w->watch->context, time, e);
}

int result_analyse(struct result_writer *w, const struct observer *watch, struct results **out,
                   struct error *e) {
    struct observer observer = result_observer(w);
    w->watch = watch;
    observer.poll = watch && watch->poll ? poll : NULL;
    int status = analysis_run(w->model, &observer, out, e);
    if (status != STATUS_OK) {
        result_abort(w);
        return status;
    }
    status = result_finish(w, *out, e);
    if (status != STATUS_OK) {
        results_free(*out);
    }
    return status;
}
