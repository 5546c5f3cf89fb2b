// SPDX-License-Identifier: GPL-3.0-or-later
// What the runs of a study have in common, read back from its file: enough to write a file like it.
#include "core/arena.h"
#include "result/reader.h"
#include "result/study_reader.h"
#include "result/study_writer.h"

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
    hid_t group = h5_get_group(h, parent, name);
    struct report_building *b = reader_building(h, group, name, v->report);
    if (b) {
        b->n_floor = (int)h5_get_length(h, group, "floor", FLOORS_MAX);
    }
    h5_close(h, group);
    return h->failed ? -1 : 0;
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
    reader_buildings(&f->h, f->h.file, r, visit_building, &(struct visitor){f, r});
    r->contact = study_reader_links(f, a, &layout_contacts, &r->n_contact);
    if (h5_has(&f->h, f->h.file, layout_links.name)) {
        r->link = study_reader_links(f, a, &layout_links, &r->n_link);
    }
    if (f->h.failed) {
        report_free(r);
        return study_reader_fail(f, e);
    }
    *out = r;
    return STATUS_OK;
}
