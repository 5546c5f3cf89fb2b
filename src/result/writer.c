// SPDX-License-Identifier: GPL-3.0-or-later
// The file of a run: made as PATH.part, rows streamed through a buffer, named PATH when complete.
// The layout and every block of rows are flushed, so that the file of a killed run can be read up
// to the last block.
#include "result/writer.h"

#include <assert.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "core/arena.h"
#include "result/part.h"

enum { ROWS_MAX = 4096 };
static const size_t bytes_max = (size_t)64 << 20;

static void writer_free(struct result_writer *w) {
    for (int i = 0; i < w->n_stream; i++) {
        h5_close(&w->h, w->stream[i].dataset);
    }
    h5_close_types(&w->h);
    if (w->h.file >= 0) {
        h5_failed(&w->h, H5Fclose(w->h.file));
    }
    report_free(w->report);
    free(w->rows);
    free(w->stream);
    free(w->path);
    free(w->part);
    free(w);
}

static int cannot_write(const struct result_writer *w, struct error *e) {
    return error_set(e, STATUS_SYSTEM, "cannot write %s: %s", w->path, w->h.cause);
}

void result_abort(struct result_writer *w) {
    if (!w) {
        return;
    }
    if (w->h.file >= 0) {
        unlink(w->part);
    }
    writer_free(w);
}

void writer_stream(struct result_writer *w, hid_t parent, const struct h5_dataset *d,
                   struct stream s) {
    assert(w->n_stream < w->stream_capacity);
    s.dataset = h5_dataset(&w->h, parent, d);
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

static int create_file(struct result_writer *w, struct error *e) {
    int status = part_claim(w->path, w->part, e);
    if (status != STATUS_OK) {
        return status;
    }
    h5_create(&w->h, w->part);
    if (w->h.failed) {
        unlink(w->part);
        return cannot_write(w, e);
    }
    return STATUS_OK;
}

static char *joined(const char *path, const char *ending) {
    const size_t n = strlen(path), n_ending = strlen(ending);
    char *text = malloc(n + n_ending + 1);
    if (text) {
        memcpy(text, path, n);
        memcpy(text + n, ending, n_ending + 1);
    }
    return text;
}

static int writer_init(struct result_writer *w, const struct result_options *o, struct error *e) {
    int status = report_create(w->model, NULL, o->path, o->version, &w->report, e);
    if (status == STATUS_OK) {
        status = part_check(w->report, o, e);
    }
    if (status != STATUS_OK) {
        return status;
    }
    w->path = joined(o->path, "");
    w->part = joined(o->path, ".part");
    if (!w->path || !w->part) {
        return error_no_memory(e);
    }
    const char *line = o->command_line ? o->command_line : "";
    w->report->command_line = arena_text(w->report->arena, line, strlen(line));
    if (!w->report->command_line || !allocate(w)) {
        return error_no_memory(e);
    }
    return create_file(w, e);
}

static int flush(struct result_writer *w, struct error *e) {
    for (int i = 0; i < w->n_stream && w->pending > 0; i++) {
        const struct stream *s = &w->stream[i];
        if (s->width > 0) {
            h5_put_rows(&w->h, s->dataset, (hsize_t)w->n_written, w->pending,
                        s->n_dim == 2 ? s->width : 0, s->row);
        }
    }
    if (!w->h.failed) {
        h5_failed(&w->h, H5Fflush(w->h.file, H5F_SCOPE_LOCAL));
    }
    w->n_written += (long)w->pending;
    w->pending = 0;
    return w->h.failed ? cannot_write(w, e) : STATUS_OK;
}

int result_create(const struct model *m, const struct result_options *options,
                  struct result_writer **out, struct error *e) {
    struct result_writer *w = calloc(1, sizeof *w);
    if (!w) {
        return error_no_memory(e);
    }
    w->h = (struct h5){.file = -1, .units = &m->deck->units};
    w->model = m;
    w->existing = options->existing;
    int status = writer_init(w, options, e);
    if (status == STATUS_OK) {
        writer_layout(w);
        place_streams(w);
        status = flush(w, e);
    }
    if (status != STATUS_OK) {
        result_abort(w);
        return status;
    }
    *out = w;
    return STATUS_OK;
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

static int write_end(struct result_writer *w, const struct results *r, struct error *e) {
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
    if (!w->h.failed) {
        h5_failed(&w->h, H5Fflush(w->h.file, H5F_SCOPE_LOCAL));
    }
    h5_list_uses(&w->h);
    h5_put_text(&w->h, w->h.file, "status", "complete");
    if (!w->h.failed) {
        h5_failed(&w->h, H5Fflush(w->h.file, H5F_SCOPE_LOCAL));
    }
    return w->h.failed ? cannot_write(w, e) : STATUS_OK;
}

// The library reports a full disk as late as here.
static int close_file(struct result_writer *w, struct error *e) {
    for (int i = 0; i < w->n_stream; i++) {
        h5_close(&w->h, w->stream[i].dataset);
    }
    w->n_stream = 0;
    h5_close_types(&w->h);
    h5_failed(&w->h, H5Fclose(w->h.file));
    w->h.file = -1;
    return w->h.failed ? cannot_write(w, e) : STATUS_OK;
}

int result_finish(struct result_writer *w, const struct results *r, struct error *e) {
    assert(w->n_written + (long)w->pending == w->report->n_row);
    int status = write_end(w, r, e);
    if (status == STATUS_OK) {
        status = close_file(w, e);
    }
    if (status == STATUS_OK) {
        status = result_publish(w->part, w->path, w->existing, e);
    } else {
        unlink(w->part);
    }
    writer_free(w);
    return status;
}
