// SPDX-License-Identifier: GPL-3.0-or-later
// The group /origin of a study file: what its runs come from.
#include <stdio.h>
#include <stdlib.h>

#include "result/study_reader.h"
#include "result/study_writer.h"

enum { SOURCES_LIMIT = 1 << 26 };
static const char group_name[] = "origin";

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
    const struct study_origin *o = w->content->origin;
    const size_t n = (size_t)o->n_source;
    const char **text = calloc(n + 1, sizeof *text);
    if (!text) {
        h5_no_memory(&w->h);
        return;
    }
    for (size_t i = 0; i < n; i++) {
        text[i] = o->source[i].path;
    }
    put_texts(w, group, "file", "file that runs have read", text, n);
    for (size_t i = 0; i < n; i++) {
        text[i] = o->source[i].sum.digits;
    }
    put_texts(w, group, "file_sha256", "SHA-256 of the file", text, n);
    free(text);
}

void study_origin_put(struct study_writer *w) {
    const struct study_origin *o = w->content->origin;
    hid_t group = h5_group(&w->h, w->h.file, group_name);
    h5_put_text(&w->h, group, "study", o->study);
    h5_put_text(&w->h, group, "define", o->define);
    h5_put_text(&w->h, group, "program_sha256", o->programs);
    h5_put_text(&w->h, group, "accepted", o->accepted);
    put_sources(w, group);
    h5_close(&w->h, group);
}

static void get_sources(struct study_file *f, hid_t group) {
    struct study_origin *o = &f->view.origin;
    const size_t n = h5_get_length(&f->h, group, "file", SOURCES_LIMIT);
    const size_t n_sum = h5_get_length(&f->h, group, "file_sha256", SOURCES_LIMIT);
    struct study_source *source = h5_alloc(&f->h, f->view.arena, n, sizeof *source);
    if (n != n_sum) {
        h5_fail(&f->h, "it has %zu files, but %zu checksums", n, n_sum);
    }
    char **path = h5_get_texts(&f->h, f->view.arena, group, "file", n);
    char **sum = h5_get_texts(&f->h, f->view.arena, group, "file_sha256", n);
    for (size_t i = 0; i < n && !f->h.failed; i++) {
        source[i].path = path[i];
        snprintf(source[i].sum.digits, sizeof source[i].sum.digits, "%s", sum[i]);
    }
    o->n_source = (int)n;
    o->source = source;
}

void study_origin_get(struct study_file *f) {
    struct study_origin *o = &f->view.origin;
    struct arena *a = f->view.arena;
    if (!h5_has(&f->h, f->h.file, group_name)) {
        return;
    }
    hid_t group = h5_get_group(&f->h, f->h.file, group_name);
    o->numerics = (int)h5_get_long(&f->h, f->h.file, "numerics_version");
    o->study = h5_get_text(&f->h, a, group, "study");
    o->define = h5_get_text(&f->h, a, group, "define");
    o->programs = h5_get_text(&f->h, a, group, "program_sha256");
    o->accepted = h5_get_text(&f->h, a, group, "accepted");
    get_sources(f, group);
    h5_close(&f->h, group);
}
