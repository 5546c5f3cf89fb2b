// SPDX-License-Identifier: GPL-3.0-or-later
// What the runs of a study have in common, read back from its file: enough to write a file like it.
#include <string.h>

#include "core/arena.h"
#include "result/study_reader.h"
#include "result/study_writer.h"

enum { BUILDINGS_LIMIT = 1 << 20, LINKS_LIMIT = 1 << 20 };

static void get_attributes(struct study_file *f, struct report *r) {
    h5_get_units(&f->h, r->arena, &r->units);
    for (int c = 0; c < layout_root.n_column; c++) {
        if (study_tree_is_shared(&layout_root.column[c])) {
            h5_get_member(&f->h, r->arena, f->h.file, &layout_root, c, r);
        }
    }
}

// What visit_building needs.
struct visitor {
    struct study_file *file;
    struct report *report;
};

static herr_t visit_building(hid_t parent, const char *name, const H5L_info_t *info,
                             void *context) {
    (void)info;
    const struct visitor *v = context;
    struct h5 *h = &v->file->h;
    struct report *r = v->report;
    hid_t group = h5_get_group(h, parent, name);
    const long position = h5_get_long(h, group, "position");
    const size_t n_floor = h5_get_length(h, group, "floor", FLOORS_MAX);
    char *copy = arena_text(r->arena, name, strlen(name));
    if (!copy) {
        h5_no_memory(h);
    }
    if (!h->failed && (position < 0 || position >= r->n_building || r->building[position].name)) {
        h5_fail(h, "building '%s' has the position %ld", name, position);
    }
    if (!h->failed) {
        r->building[position].name = copy;
        r->building[position].n_floor = (int)n_floor;
    }
    h5_close(h, group);
    return h->failed ? -1 : 0;
}

static void get_buildings(struct study_file *f, struct report *r) {
    struct h5 *h = &f->h;
    hid_t group = h5_get_group(h, h->file, "buildings");
    H5G_info_t info = {.nlinks = 0};
    if (!h->failed && !h5_failed(h, H5Gget_info(group, &info)) &&
        (info.nlinks < 1 || info.nlinks > BUILDINGS_LIMIT)) {
        h5_fail(h, "it has %llu buildings; 1 to %d are allowed", (unsigned long long)info.nlinks,
                BUILDINGS_LIMIT);
    }
    r->building = h->failed ? NULL : arena_alloc(r->arena, info.nlinks, sizeof *r->building);
    if (r->building) {
        struct visitor v = {f, r};
        r->n_building = (int)info.nlinks;
        h5_failed(h, H5Literate(group, H5_INDEX_NAME, H5_ITER_INC, NULL, visit_building, &v));
    } else {
        h5_no_memory(h);
    }
    h5_close(h, group);
}

static struct report_link *get_links(struct study_file *f, struct report *r, const char *name,
                                     const char *scale, int *n_link) {
    hid_t group = h5_get_group(&f->h, f->h.file, name);
    const size_t n = h5_get_length(&f->h, group, scale, LINKS_LIMIT);
    struct report_link *link = arena_alloc(r->arena, n, sizeof *link);
    if (!link) {
        h5_no_memory(&f->h);
    }
    for (int c = 0; c < layout_link.n_column && !f->h.failed; c++) {
        if (study_tree_is_fixed(&layout_link.column[c])) {
            h5_get_column(&f->h, r->arena, group, &layout_link, c, link, n);
        }
    }
    h5_close(&f->h, group);
    *n_link = (int)n;
    return link;
}

int study_file_report(struct study_file *f, struct report **out, struct error *e) {
    struct arena *a = arena_create();
    struct report *r = a ? arena_alloc(a, 1, sizeof *r) : NULL;
    if (!r) {
        arena_free(a);
        return error_no_memory(e);
    }
    r->arena = a;
    get_attributes(f, r);
    get_buildings(f, r);
    r->contact = get_links(f, r, "contacts", "contact", &r->n_contact);
    if (h5_has(&f->h, f->h.file, "links")) {
        r->link = get_links(f, r, "links", "link", &r->n_link);
    }
    if (f->h.failed) {
        report_free(r);
        return study_reader_fail(f, e);
    }
    *out = r;
    return STATUS_OK;
}
