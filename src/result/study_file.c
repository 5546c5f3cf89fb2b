// SPDX-License-Identifier: GPL-3.0-or-later
// Writes a study file block by block: a block is a range of one sweep with all later sweeps whole,
// so that it is a box in every dataset.
#include "jostle/study_file.h"

#include <stdio.h>
#include <unistd.h>

#include "core/arena.h"
#include "result/h5_partial.h"
#include "result/seal.h"
#include "result/study_sweep.h"
#include "result/study_writer.h"
#include "result/writer.h"

static const size_t bytes_max = (size_t)16 << 20;
enum { RUNS_MAX = 4096 };  // of a block

// A block of runs in memory.
struct block {
    long capacity;
    struct study_outcome *outcome;  // (capacity)
    double *value;                  // (capacity, n_value)
    int *status;                    // (capacity)
    const char **message;           // (capacity)
};

static bool block_init(struct block *b, const struct study_content *c, struct arena *a) {
    const size_t row = c->table->n_value * sizeof *b->value;
    b->capacity = (long)(bytes_max / row);
    b->capacity = b->capacity < 1 ? 1 : b->capacity > RUNS_MAX ? RUNS_MAX : b->capacity;
    b->capacity = b->capacity > c->n_run && c->n_run > 0 ? c->n_run : b->capacity;
    const size_t n = (size_t)b->capacity;
    b->outcome = arena_alloc(a, n, sizeof *b->outcome);
    b->value = arena_alloc(a, n, row);
    b->status = arena_alloc(a, n, sizeof *b->status);
    b->message = arena_alloc(a, n, sizeof *b->message);
    return !arena_failed(a);
}

// Outcomes and values of all runs.
static int put_runs(struct study_writer *w, struct block *b, struct error *e) {
    const struct study_content *c = w->content;
    const struct study_table *t = c->table;
    const struct tree *tree = &w->tree;
    for (long first = 0; first < c->n_run && !w->h.failed;) {
        const struct h5_box box = study_sweep_box(tree->sweep, tree->n_sweep, first, b->capacity);
        int status = c->read(c->context, first, (long)box.n, b->outcome, b->value, e);
        if (status != STATUS_OK) {
            return status;
        }
        for (hsize_t i = 0; i < box.n; i++) {
            b->status[i] = b->outcome[i].status;
            b->message[i] = b->outcome[i].message;
        }
        h5_put_box(&w->h, w->status, &box, H5T_NATIVE_INT, b->status);
        h5_put_box(&w->h, w->message, &box, w->h.text, b->message);
        for (int i = 0; i < t->n_item && !w->h.failed; i++) {
            const struct study_item *item = &t->item[i];
            if (w->dataset[i] >= 0 && item->n > 0) {
                h5_put_columns(&w->h, w->dataset[i], box, tree->n_sweep, item->n, t->n_value,
                               b->value + item->first);
            }
        }
        first += (long)box.n;
    }
    return STATUS_OK;
}

// Removes the group from its parent if it has no members.
static void drop_empty(struct h5 *h, hid_t parent, const char *name, hid_t group) {
    H5G_info_t info;
    if (!h->failed && !h5_failed(h, H5Gget_info(group, &info)) && info.nlinks == 0) {
        h5_failed(h, H5Ldelete(parent, name, H5P_DEFAULT));
    }
}

// Histories in /runs: of all runs that were done, or of those that are chosen and were done or
// failed.
static int put_histories(struct study_writer *w, struct block *b, const char *path,
                         struct error *e) {
    const struct study_content *c = w->content;
    hid_t runs = h5_group(&w->h, w->h.file, "runs");
    int status = STATUS_OK;
    for (long i = 0; i < c->n_run && status == STATUS_OK && !w->h.failed; i++) {
        char name[24];
        if (c->chosen && !c->chosen[i]) {
            continue;
        }
        status = c->read(c->context, i, 1, b->outcome, b->value, e);
        const bool has_rows =
            b->outcome->status == STUDY_DONE || (c->chosen && b->outcome->status == STUDY_FAILED);
        if (status != STATUS_OK || !has_rows) {
            continue;
        }
        snprintf(name, sizeof name, "%06.0f", c->part ? c->part->run[i] : (double)i + 1.0);
        const struct result_place place = {&w->h, h5_group(&w->h, runs, name), path, w->tree.sweep,
                                           w->tree.n_sweep};
        status = w->h.failed ? STATUS_OK : c->write_run(c->context, i, &place, e);
        drop_empty(&w->h, runs, name, place.group);
        h5_close(&w->h, place.group);
    }
    h5_close(&w->h, runs);
    return status;
}

static int write_all(struct study_writer *w, struct block *b, const char *path, struct error *e) {
    study_tree(w);
    int status = put_runs(w, b, e);
    h5_list_uses(&w->h);
    if (status == STATUS_OK && w->content->write_run) {
        status = put_histories(w, b, path, e);
    }
    if (status == STATUS_OK) {
        h5_put_text(&w->h, w->h.file, "status", "complete");
        seal_put(&w->h);
    }
    return status;
}

static void close_all(struct study_writer *w) {
    h5_spend_reserve(&w->h);
    for (int i = 0; i < w->content->table->n_item; i++) {
        h5_close(&w->h, w->dataset[i]);
    }
    for (int i = 0; i < w->tree.n_sweep; i++) {
        h5_close(&w->h, w->tree.scale[i]);
    }
    h5_close(&w->h, w->status);
    h5_close(&w->h, w->message);
    h5_close_types(&w->h);
    h5_close_file(&w->h);
}

// Makes the file, and gives it its name when it is complete.
static int make_file(struct study_writer *w, const struct result_options *o, struct arena *a,
                     struct error *e) {
    struct block b;
    const char *partial = arena_format(a, "%s.part", o->path);
    int status = block_init(&b, w->content, a) && partial
                     ? h5_partial_create(&w->h, o->path, partial, e)
                     : error_no_memory(e);
    if (status == STATUS_OK) {
        status = write_all(w, &b, o->path, e);
    }
    close_all(w);
    if (status == STATUS_OK && w->h.failed) {
        status = error_set(e, STATUS_SYSTEM, "cannot write %s: %s", o->path, w->h.cause);
    }
    if (status == STATUS_OK) {
        status = result_publish(w->h.lock, partial, o->path, o->existing, e);
    } else if (partial && w->h.lock >= 0) {
        unlink(partial);
    }
    h5_unlock(&w->h);
    return status;
}

bool study_file_is_study(const char *path) {
    struct h5 h = {.file = -1};
    struct error e;
    if (h5_check_file(path, &e) != STATUS_OK || !h5_start(&h) || H5Fis_hdf5(path) <= 0) {
        return false;
    }
    hid_t file = H5Fopen(path, H5F_ACC_RDONLY, H5P_DEFAULT);
    if (file < 0) {
        return false;
    }
    const bool is = H5Lexists(file, "sweep", H5P_DEFAULT) > 0;
    H5Fclose(file);
    return is;
}

int study_file_check(const struct study_content *c, const struct result_options *o,
                     struct error *e) {
    int status = h5_partial_check(c->first, o, e);
    return status == STATUS_OK ? study_tree_check(c, e) : status;
}

int study_file_write(const struct study_content *c, const struct result_options *o,
                     struct error *e) {
    int status = study_file_check(c, o, e);
    if (status != STATUS_OK) {
        return status;
    }
    struct study_writer w = {.h = {.file = -1, .lock = -1, .units = &c->first->units},
                             .content = c,
                             .command_line = o->command_line,
                             .tree = {.h = &w.h},
                             .status = -1,
                             .message = -1};
    if (c->part) {
        // The values have the dimension "run" in place of those of the sweeps.
        w.runs = (struct sweep){.name = "run",
                                .n = (int)c->n_run,
                                .number = c->part->run,
                                .known = true,
                                .dimension = dimension_none};
        w.tree.sweep[w.tree.n_sweep++] = &w.runs;
    }
    for (const struct sweep *s = c->sweeps; s && !c->part; s = s->next) {
        if (!s->fixed) {
            w.tree.sweep[w.tree.n_sweep++] = s;
        }
    }
    for (int i = 0; i < w.tree.n_sweep; i++) {
        w.tree.scale[i] = -1;
    }
    struct arena *a = arena_create();
    const size_t n = (size_t)c->table->n_item;
    w.dataset = a ? arena_alloc(a, n, sizeof *w.dataset) : NULL;
    if (!w.dataset) {
        arena_free(a);
        return error_no_memory(e);
    }
    for (size_t i = 0; i < n; i++) {
        w.dataset[i] = -1;
    }
    status = make_file(&w, o, a, e);
    arena_free(a);
    return status;
}
