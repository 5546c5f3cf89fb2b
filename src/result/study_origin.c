// SPDX-License-Identifier: GPL-3.0-or-later
// Two groups of a study file: /origin says what its runs come from; /part, in the file of one part,
// says which part it is and which sweeps the study has.
#include <stdio.h>
#include <stdlib.h>

#include "result/study_reader.h"
#include "result/study_sweep.h"
#include "result/study_writer.h"

enum { SOURCES_LIMIT = 1 << 26 };
static const char group_name[] = "origin", key_name[] = "key";

static void put_texts(struct study_writer *w, hid_t group, const char *name, const char *long_name,
                      const char *const *text, hsize_t n) {
    const struct h5_dataset d = {.name = name,
                                 .quantity = {long_name, NULL},
                                 .memory_type = w->h.text,
                                 .file_type = w->h.text,
                                 .n_dim = 1,
                                 .dim = {n}};
    h5_put(&w->h, group, &d, text);
}

// The keys are a line of bytes for each run, in the order of the runs.
static void put_keys(struct study_writer *w, hid_t group) {
    const struct study_key *key = w->content->origin->key;
    const struct h5_dataset d = {
        .name = key_name,
        .quantity = {"SHA-256 of what each run depends on", NULL},
        .memory_type = H5T_NATIVE_UCHAR,
        .file_type = H5T_STD_U8LE,
        .n_dim = 2,
        .dim = {(hsize_t)w->content->n_run, sizeof key->byte},
    };
    if (key) {
        h5_put(&w->h, group, &d, key);
    }
}

void study_origin_put(struct study_writer *w) {
    const struct study_origin *o = w->content->origin;
    const size_t n = (size_t)o->n_source;
    const char **path = calloc(n + 1, sizeof *path), **sum = calloc(n + 1, sizeof *sum);
    hid_t group = h5_group(&w->h, w->h.file, group_name);
    h5_put_text(&w->h, group, "study", o->study);
    h5_put_text(&w->h, group, "define", o->define);
    h5_put_text(&w->h, group, "program_sha256", o->programs);
    for (size_t i = 0; path && sum && i < n; i++) {
        path[i] = o->source[i].path;
        sum[i] = o->source[i].sum.digits;
    }
    if (path && sum) {
        put_texts(w, group, "file", "file that runs have read", path, n);
        put_texts(w, group, "file_sha256", "SHA-256 of the file", sum, n);
    } else {
        h5_no_memory(&w->h);
    }
    free(path);
    free(sum);
    put_keys(w, group);
    h5_close(&w->h, group);
}

int study_file_keys(struct study_file *f, struct study_key **out, struct error *e) {
    struct h5 *h = &f->file.h;
    const size_t n = (size_t)f->view.n_run;
    hsize_t dim[H5S_MAX_RANK] = {0};
    *out = NULL;
    if (!h5_has(h, h->file, group_name)) {
        return STATUS_OK;
    }
    hid_t group = h5_get_group(h, h->file, group_name);
    hid_t dataset = h5_has(h, group, key_name) ? h5_open_object(h, group, key_name) : -1;
    struct study_key *key = dataset >= 0 ? malloc((n + 1) * sizeof *key) : NULL;
    hid_t space = key ? H5Dget_space(dataset) : -1;
    if (dataset >= 0 && !key) {
        h5_no_memory(h);
    }
    if (space >= 0) {
        const int n_dim = H5Sget_simple_extent_dims(space, dim, NULL);
        H5Sclose(space);
        if (n_dim != 2 || dim[0] != n || dim[1] != sizeof key->byte || !h5_is_stored(dataset)) {
            h5_fail(h, "it does not have a key for each run");
        }
        h5_get_box(h, dataset, NULL, H5T_NATIVE_UCHAR, key);
    }
    h5_close(h, dataset);
    h5_close(h, group);
    if (h->failed) {
        free(key);
        return h5_damaged(h, f->view.path, e);
    }
    *out = key;
    return STATUS_OK;
}

static void get_sources(struct study_file *f, hid_t group) {
    struct study_origin *o = &f->view.origin;
    const size_t n = h5_get_length(&f->file.h, group, "file", SOURCES_LIMIT);
    const size_t n_sum = h5_get_length(&f->file.h, group, "file_sha256", SOURCES_LIMIT);
    struct study_source *source = h5_alloc(&f->file.h, f->view.arena, n, sizeof *source);
    if (n != n_sum) {
        h5_fail(&f->file.h, "it has %zu files, but %zu checksums", n, n_sum);
    }
    char **path = h5_get_texts(&f->file.h, f->view.arena, group, "file", n);
    char **sum = h5_get_texts(&f->file.h, f->view.arena, group, "file_sha256", n);
    for (size_t i = 0; i < n && !f->file.h.failed; i++) {
        source[i].path = path[i];
        snprintf(source[i].sum.digits, sizeof source[i].sum.digits, "%s", sum[i]);
    }
    o->n_source = (int)n;
    o->source = source;
}

void study_origin_get(struct study_file *f) {
    struct study_origin *o = &f->view.origin;
    struct arena *a = f->view.arena;
    if (!h5_has(&f->file.h, f->file.h.file, group_name)) {
        return;
    }
    hid_t group = h5_get_group(&f->file.h, f->file.h.file, group_name);
    o->numerics = (int)h5_get_long(&f->file.h, f->file.h.file, "numerics_version");
    o->study = h5_get_text(&f->file.h, a, group, "study");
    o->define = h5_get_text(&f->file.h, a, group, "define");
    o->programs = h5_get_text(&f->file.h, a, group, "program_sha256");
    get_sources(f, group);
    h5_close(&f->file.h, group);
}

// The whole file gets its scales from the sweeps of the study.
void study_part_put(struct study_writer *w) {
    const struct study_part *p = w->content->part;
    hid_t part = h5_group(&w->h, w->h.file, "part");
    h5_put_long(&w->h, part, "number", p->shard.number);
    h5_put_long(&w->h, part, "of", p->shard.n);
    h5_put_long(&w->h, part, "failed", p->n_failed);
    hid_t group = h5_group(&w->h, part, "sweep");
    long position = 0;
    for (const struct sweep *s = w->content->sweeps; s; s = s->next) {
        if (s->fixed) {
            continue;
        }
        hid_t scale = study_sweep_put(&w->h, group, s);
        h5_put_long(&w->h, scale, "position", position++);
        if (s->number) {
            study_sweep_put_dimension(&w->h, scale, s);
        }
        h5_close(&w->h, scale);
    }
    h5_close(&w->h, group);
    h5_close(&w->h, part);
}

// The sweep in the dataset `name`, to its position.
static herr_t visit_sweep(hid_t group, const char *name, const H5L_info_t *info, void *context) {
    (void)info;
    struct study_file *f = context;
    struct study_view *v = &f->view;
    hid_t scale = h5_open_object(&f->file.h, group, name);
    if (scale >= 0 && !h5_is_scale(scale)) {  // values along a sweep, read with it
        h5_close(&f->file.h, scale);
        return 0;
    }
    const long position = h5_get_long(&f->file.h, scale, "position");
    if (!f->file.h.failed && (position < 0 || position >= STUDY_SWEEPS_MAX || v->sweep[position])) {
        h5_fail(&f->file.h, "sweep '%s' has the position %ld", name, position);
    }
    if (!f->file.h.failed) {
        struct sweep *s = study_sweep_get(&f->file.h, v->arena, group, scale, name);
        if (s && s->number) {
            study_sweep_get_dimension(&f->file.h, scale, s);
        }
        v->sweep[position] = s;
        v->n_sweep++;
    }
    h5_close(&f->file.h, scale);
    return f->file.h.failed ? -1 : 0;
}

static void get_sweeps(struct study_file *f, hid_t part) {
    struct study_view *v = &f->view;
    hid_t group = h5_get_group(&f->file.h, part, "sweep");
    if (!f->file.h.failed) {
        h5_failed(&f->file.h, H5Literate(group, H5_INDEX_NAME, H5_ITER_INC, NULL, visit_sweep, f));
    }
    h5_close(&f->file.h, group);
    v->n_study = 1;
    for (int i = 0; i < v->n_sweep && !f->file.h.failed; i++) {
        if (!v->sweep[i] || v->sweep[i]->n < 1 || v->n_study > STUDY_RUNS_MAX / v->sweep[i]->n) {
            h5_fail(&f->file.h, "its sweeps are not those of a study");
            return;
        }
        v->n_study *= v->sweep[i]->n;
    }
}

// Numbers of runs rise and are those of the study.
static void get_runs(struct study_file *f) {
    struct study_view *v = &f->view;
    const struct sweep *run = f->dim[0];
    if (f->file.h.failed || f->n_dim != 1 || !run->number) {
        h5_fail(&f->file.h, "the numbers of its runs are missing");
        return;
    }
    for (int i = 0; i < run->n; i++) {
        const double x = run->number[i];
        if (!(x >= 1 && x <= (double)v->n_study) || x != (double)(long)x ||
            (i > 0 && x <= run->number[i - 1])) {
            h5_fail(&f->file.h, "it has a run of number %g", x);
            return;
        }
    }
    v->part.run = run->number;
}

void study_part_get(struct study_file *f) {
    struct study_view *v = &f->view;
    hid_t group = h5_get_group(&f->file.h, f->file.h.file, "part");
    v->part.shard.number = h5_get_long(&f->file.h, group, "number");
    v->part.shard.n = h5_get_long(&f->file.h, group, "of");
    v->part.n_failed = h5_get_long(&f->file.h, group, "failed");
    if (!f->file.h.failed && (v->part.shard.number < 1 || v->part.shard.number > v->part.shard.n)) {
        h5_fail(&f->file.h, "it is part %ld of %ld", v->part.shard.number, v->part.shard.n);
    }
    get_sweeps(f, group);
    get_runs(f);
    h5_close(&f->file.h, group);
}
