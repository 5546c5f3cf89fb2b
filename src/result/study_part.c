// SPDX-License-Identifier: GPL-3.0-or-later
// The group /part of the file of one part: which study it is, the sweeps of that, and the files its
// runs have read. The values of the runs have the dimension "run" in place of those of the sweeps.
#include <inttypes.h>
#include <stdlib.h>
#include <string.h>

#include "result/study_along.h"
#include "result/study_reader.h"
#include "result/study_writer.h"

enum { SOURCES_LIMIT = 1 << 26, SUM_DIGITS = 16 };

void study_part_dimension(struct study_writer *w) {
    const struct study_content *c = w->content;
    w->runs = (struct sweep){.name = "run",
                             .n = (int)c->n_run,
                             .number = c->part->run,
                             .known = true,
                             .dimension = dimension_none};
    w->scale[0] = -1;
    w->sweep[0] = &w->runs;
    w->n_sweep = 1;
}

// The sweeps of the study, from which the whole file gets its scales.
static void put_sweeps(struct study_writer *w, hid_t part) {
    hid_t group = h5_group(&w->h, part, "sweep");
    long position = 0;
    for (const struct sweep *s = w->content->sweeps; s; s = s->next) {
        if (s->fixed) {
            continue;
        }
        hid_t scale = study_tree_sweep(w, group, s);
        h5_put_long(&w->h, scale, "position", position++);
        if (s->number) {
            study_along_put_dimension(&w->h, scale, s);
        }
        h5_close(&w->h, scale);
    }
    h5_close(&w->h, group);
}

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

static void put_sources(struct study_writer *w, hid_t group) {
    const struct study_part *p = w->content->part;
    const size_t n = (size_t)p->n_source;
    char(*digits)[SUM_DIGITS + 1] = calloc(n + 1, sizeof *digits);
    const char **text = calloc(n + 1, sizeof *text);
    if (digits && text) {
        for (size_t i = 0; i < n; i++) {
            text[i] = p->source[i].path;
        }
        put_texts(w, group, "file", "file that runs have read", text, n);
        for (size_t i = 0; i < n; i++) {
            snprintf(digits[i], sizeof digits[i], "%016" PRIx64, p->source[i].sum);
            text[i] = digits[i];
        }
        put_texts(w, group, "file_sum", "checksum of the file", text, n);
    } else {
        h5_no_memory(&w->h);
    }
    free(digits);
    free(text);
}

void study_part_put(struct study_writer *w) {
    const struct study_part *p = w->content->part;
    hid_t group = h5_group(&w->h, w->h.file, "part");
    h5_put_long(&w->h, group, "number", p->shard.number);
    h5_put_long(&w->h, group, "of", p->shard.n);
    h5_put_text(&w->h, group, "study", p->study);
    h5_put_long(&w->h, group, "failed", p->n_failed);
    put_sweeps(w, group);
    put_sources(w, group);
    h5_close(&w->h, group);
}

// The sweep in the dataset `name`, to its position.
static herr_t visit_sweep(hid_t group, const char *name, const H5L_info_t *info, void *context) {
    (void)info;
    struct study_file *f = context;
    struct study_view *v = &f->view;
    hid_t scale = h5_open_object(&f->h, group, name);
    if (scale >= 0 && !h5_is_scale(scale)) {  // values along a sweep, read with it
        h5_close(&f->h, scale);
        return 0;
    }
    const long position = h5_get_long(&f->h, scale, "position");
    if (!f->h.failed && (position < 0 || position >= STUDY_SWEEPS_MAX || v->sweep[position])) {
        h5_fail(&f->h, "sweep '%s' has the position %ld", name, position);
    }
    if (!f->h.failed) {
        struct sweep *s = study_reader_sweep(f, group, scale, name);
        if (s && s->number) {
            study_along_get_dimension(&f->h, scale, s);
        }
        v->sweep[position] = s;
        v->n_sweep++;
    }
    h5_close(&f->h, scale);
    return f->h.failed ? -1 : 0;
}

static void get_sweeps(struct study_file *f, hid_t part) {
    struct study_view *v = &f->view;
    hid_t group = h5_get_group(&f->h, part, "sweep");
    if (!f->h.failed) {
        h5_failed(&f->h, H5Literate(group, H5_INDEX_NAME, H5_ITER_INC, NULL, visit_sweep, f));
    }
    h5_close(&f->h, group);
    v->n_study = 1;
    for (int i = 0; i < v->n_sweep && !f->h.failed; i++) {
        if (!v->sweep[i] || v->sweep[i]->n < 1 || v->n_study > STUDY_RUNS_MAX / v->sweep[i]->n) {
            h5_fail(&f->h, "its sweeps are not those of a study");
            return;
        }
        v->n_study *= v->sweep[i]->n;
    }
}

static void get_sources(struct study_file *f, hid_t group) {
    struct study_part *p = &f->view.part;
    const size_t n = h5_get_length(&f->h, group, "file", SOURCES_LIMIT);
    const size_t n_sum = h5_get_length(&f->h, group, "file_sum", SOURCES_LIMIT);
    struct study_source *source = h5_alloc(&f->h, f->view.arena, n, sizeof *source);
    if (n != n_sum) {
        h5_fail(&f->h, "it has %zu files, but %zu checksums", n, n_sum);
    }
    char **path = h5_get_texts(&f->h, f->view.arena, group, "file", n);
    char **sum = h5_get_texts(&f->h, f->view.arena, group, "file_sum", n);
    for (size_t i = 0; i < n && !f->h.failed; i++) {
        source[i] = (struct study_source){path[i], strtoull(sum[i], NULL, 16)};
    }
    p->n_source = (int)n;
    p->source = source;
}

// Numbers of runs rise and are those of the study.
static void get_runs(struct study_file *f) {
    struct study_view *v = &f->view;
    const struct sweep *run = f->dim[0];
    if (f->h.failed || f->n_dim != 1 || !run->number) {
        h5_fail(&f->h, "the numbers of its runs are missing");
        return;
    }
    for (int i = 0; i < run->n; i++) {
        const double x = run->number[i];
        if (!(x >= 1 && x <= (double)v->n_study) || x != (double)(long)x ||
            (i > 0 && x <= run->number[i - 1])) {
            h5_fail(&f->h, "it has a run of number %g", x);
            return;
        }
    }
    v->part.run = run->number;
}

void study_part_get(struct study_file *f) {
    struct study_view *v = &f->view;
    hid_t group = h5_get_group(&f->h, f->h.file, "part");
    v->part.shard.number = h5_get_long(&f->h, group, "number");
    v->part.shard.n = h5_get_long(&f->h, group, "of");
    v->part.study = h5_get_text(&f->h, v->arena, group, "study");
    v->part.n_failed = h5_get_long(&f->h, group, "failed");
    if (!f->h.failed && (v->part.shard.number < 1 || v->part.shard.number > v->part.shard.n)) {
        h5_fail(&f->h, "it is part %ld of %ld", v->part.shard.number, v->part.shard.n);
    }
    get_sweeps(f, group);
    get_sources(f, group);
    get_runs(f);
    h5_close(&f->h, group);
}
