// SPDX-License-Identifier: GPL-3.0-or-later
// Where a run is written: a file made as PATH.part and named PATH when complete, or a place in the
// file of a study.
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "result/h5_draft.h"
#include "result/seal.h"
#include "result/writer.h"

static bool has_file(const struct result_writer *w) {
    return !w->place;
}

static void writer_free(struct result_writer *w) {
    writer_close_streams(w);
    if (has_file(w)) {
        h5_close_types(w->h);
        h5_close_file(w->h);
        h5_unlock(w->h);
    }
    report_free(w->report);
    free(w->rows);
    free(w->stream);
    free(w->path);
    free(w->draft);
    free(w);
}

void result_abort(struct result_writer *w) {
    if (!w) {
        return;
    }
    if (w->own.file >= 0) {
        unlink(w->draft);
    }
    h5_spend_reserve(&w->own);
    writer_free(w);
}

static int create_file(struct result_writer *w, struct error *e) {
    const int status = h5_draft_create(&w->own, w->path, w->draft, e);
    w->root = w->own.file;
    return status;
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

static int open_file(struct result_writer *w, const struct result_options *o, struct error *e) {
    int status = h5_draft_check(w->report, o, e);
    if (status != STATUS_OK) {
        return status;
    }
    w->draft = joined(o->path, ".part");
    return w->draft ? create_file(w, e) : error_no_memory(e);
}

// Writes what is known before the run; *out is `w`, which is freed where that fails. `w` NULL:
// there is no memory.
static int begin(struct result_writer *w, const struct result_options *o,
                 struct result_writer **out, struct error *e) {
    if (!w) {
        return error_no_memory(e);
    }
    w->path = joined(o->path, "");
    int status = w->path ? writer_alloc(w, o, e) : error_no_memory(e);
    if (status == STATUS_OK && has_file(w)) {
        status = open_file(w, o, e);
    }
    if (status == STATUS_OK) {
        status = writer_start(w, e);
    }
    if (status != STATUS_OK) {
        result_abort(w);
        return status;
    }
    *out = w;
    return STATUS_OK;
}

static struct result_writer *new_writer(const struct model *m) {
    struct result_writer *w = calloc(1, sizeof *w);
    if (w) {
        w->model = m;
        w->own = (struct h5){.file = -1, .lock = -1, .units = &m->deck->units};
    }
    return w;
}

int result_create(const struct model *m, const struct result_options *options,
                  struct result_writer **out, struct error *e) {
    struct result_writer *w = new_writer(m);
    if (w) {
        w->h = &w->own;
        w->existing = options->existing;
    }
    return begin(w, options, out, e);
}

int result_create_in(const struct result_place *place, const struct model *m, const char *version,
                     struct result_writer **out, struct error *e) {
    const struct result_options options = {.path = place->path, .version = version};
    struct result_writer *w = new_writer(m);
    if (w) {
        w->place = place;
        w->h = place->h;
        w->root = place->group;
    }
    return begin(w, &options, out, e);
}

// The library reports a full disk as late as here.
static int close_file(struct result_writer *w, struct error *e) {
    writer_close_streams(w);
    seal_put(w->h);
    h5_close_types(w->h);
    h5_close_file(w->h);
    return w->h->failed ? writer_failed(w, e) : STATUS_OK;
}

static int finish_file(struct result_writer *w, int status, struct error *e) {
    if (status == STATUS_OK) {
        status = close_file(w, e);
    }
    if (status == STATUS_OK) {
        return result_publish(w->h->lock, w->draft, w->path, w->existing, e);
    }
    unlink(w->draft);
    return status;
}

int result_finish(struct result_writer *w, const struct results *r, struct error *e) {
    int status = writer_end(w, r, e);
    if (has_file(w)) {
        status = finish_file(w, status, e);
    }
    writer_free(w);
    return status;
}
