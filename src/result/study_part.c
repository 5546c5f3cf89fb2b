// SPDX-License-Identifier: GPL-3.0-or-later
// The group /part of the file of one part: which part it is, and the sweeps of the study. The
// values of the runs have the dimension "run" in place of those of the sweeps.
#include <string.h>

#include "result/study_along.h"
#include "result/study_reader.h"
#include "result/study_writer.h"

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

void study_part_put(struct study_writer *w) {
    const struct study_part *p = w->content->part;
    hid_t group = h5_group(&w->h, w->h.file, "part");
    h5_put_long(&w->h, group, "number", p->shard.number);
    h5_put_long(&w->h, group, "of", p->shard.n);
    h5_put_long(&w->h, group, "failed", p->n_failed);
    put_sweeps(w, group);
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
    v->part.n_failed = h5_get_long(&f->h, group, "failed");
    if (!f->h.failed && (v->part.shard.number < 1 || v->part.shard.number > v->part.shard.n)) {
        h5_fail(&f->h, "it is part %ld of %ld", v->part.shard.number, v->part.shard.n);
    }
    get_sweeps(f, group);
    get_runs(f);
    h5_close(&f->h, group);
}
