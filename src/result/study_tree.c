// SPDX-License-Identifier: GPL-3.0-or-later
// The tree of a study file. The scales of the sweeps are in /sweep and are hard-linked into each
// group with values.
#include <stdio.h>
#include <string.h>

#include "result/h5_partial.h"
#include "result/study_sweep.h"
#include "result/study_writer.h"

enum { GROUP_MAX = 4096 };

// Has the sweep, or a parameter along it, the name of something else in the file?
static bool is_taken(const struct study_content *c, const char *name) {
    static const char *const taken[] = {
        "status", "message",    "sweep",      "buildings", "contacts",    "links",
        "energy", "totals",     "floor",      "contact",   "envelope",    "link",
        "name",   "left",       "left_floor", "right",     "right_floor", "runs",
        "origin", "left_below", "right_below"};
    bool bad = false;
    for (size_t i = 0; i < sizeof taken / sizeof taken[0]; i++) {
        bad = bad || strcmp(taken[i], name) == 0;
    }
    for (int i = 0; i < c->table->n_item; i++) {
        const struct study_item *item = &c->table->item[i];
        bad = bad || (!item->property && strcmp(item->name, name) == 0);
    }
    return bad;
}

int study_tree_check(const struct study_content *c, struct error *e) {
    for (const struct sweep *s = c->sweeps; s; s = s->next) {
        for (const struct sweep *p = s; p; p = p->along) {
            if (!p->fixed && is_taken(c, p->name)) {
                return error_set(e, STATUS_INPUT,
                                 "sweep '%s' has the name of a result; give its parameter another "
                                 "one",
                                 p->name);
            }
        }
    }
    return STATUS_OK;
}

static void put_attributes(struct study_writer *w) {
    const struct report *r = w->content->first;
    h5_partial_attributes(&w->h, w->h.file, r, w->content->origin->numerics);
    for (int c = 0; c < layout_root.n_column; c++) {
        if (layout_is_shared(&layout_root.column[c])) {
            h5_put_member(&w->h, w->h.file, &layout_root, c, r);
        }
    }
    h5_put_text(&w->h, w->h.file, "command_line", w->command_line ? w->command_line : "");
    h5_put_long(&w->h, w->h.file, "runs", w->content->n_run);
    h5_put_long(&w->h, w->h.file, "runs_kept", w->content->n_kept);
    h5_put_long(&w->h, w->h.file, "threads", w->content->n_thread);
    h5_put_double(&w->h, w->h.file, "wall_seconds", w->content->seconds);
    h5_put_long(&w->h, w->h.file, "parts", w->content->n_part);
}

// A group with what is the same for all runs.
static void put_group(void *context, const struct layout_group *of) {
    struct study_writer *w = context;
    if (w->h.failed) {
        return;
    }
    const struct tree_group g = tree_group(&w->tree, w->h.file, of);
    for (int i = 0; i < 2 && of->own[i] && of->scale; i++) {
        for (int c = 0; c < of->own[i]->n_column; c++) {
            if (layout_is_fixed(&of->own[i]->column[c])) {
                h5_put_column(&w->h, g.group, of->own[i], c, of->base, of->n, g.scale);
            }
        }
    }
    if (of->envelope) {
        h5_close(&w->h, tree_envelope(&w->tree, &g));
    }
    tree_close(&w->tree, &g);
}

// A dataset of the sweep dimensions; that of its own values comes last.
static struct h5_dataset over_sweeps(const struct study_writer *w, const char *name) {
    struct h5_dataset d = {.name = name, .n_dim = w->tree.n_sweep};
    for (int i = 0; i < w->tree.n_sweep; i++) {
        d.dim[i] = (hsize_t)w->tree.sweep[i]->n;
        d.scale[i] = w->tree.scale[i];
    }
    return d;
}

static hid_t put_item(struct study_writer *w, const struct study_item *item) {
    char path[GROUP_MAX];
    if (study_sweep_has(w->tree.sweep, w->tree.n_sweep, item->name)) {
        return -1;
    }
    snprintf(path, sizeof path, "/%s%s%s", item->parent, item->owner ? "/" : "",
             item->owner ? item->owner : "");
    hid_t owner = h5_open_object(&w->h, w->h.file, path);
    hid_t group = h5_open_object(&w->h, owner, item->leaf ? item->leaf : ".");
    struct h5_dataset d = over_sweeps(w, item->name);
    d.quantity = (struct quantity){item->long_name, item->dimension};
    d.file_type = H5T_IEEE_F64LE;
    hid_t scale = -1;
    if (item->scale) {
        scale = h5_open_object(&w->h, owner, item->scale);
        d.dim[d.n_dim] = item->n;
        d.scale[d.n_dim++] = scale;
    }
    hid_t dataset = h5_dataset(&w->h, group, &d);
    h5_close(&w->h, scale);
    h5_close(&w->h, group);
    h5_close(&w->h, owner);
    return dataset;
}

void study_tree(struct study_writer *w) {
    struct tree *t = &w->tree;
    put_attributes(w);
    hid_t sweep = h5_group(&w->h, w->h.file, "sweep");
    for (int i = 0; i < t->n_sweep; i++) {
        t->scale[i] = study_sweep_put(&w->h, sweep, t->sweep[i]);
    }
    h5_close(&w->h, sweep);
    study_sweep_link(&w->h, w->h.file, t->sweep, t->scale, t->n_sweep);
    study_origin_put(w);
    if (w->content->part) {
        study_part_put(w);
    }
    h5_close(&w->h, h5_group(&w->h, w->h.file, "buildings"));
    layout_groups(w->content->first, put_group, w);
    struct h5_dataset outcome = over_sweeps(w, "status");
    outcome.quantity.long_name = "0: done, 1: failed, 2: missing";
    outcome.file_type = H5T_STD_I32LE;
    w->status = h5_dataset(&w->h, w->h.file, &outcome);
    outcome.name = "message";
    outcome.quantity.long_name = "why the run failed";
    outcome.file_type = w->h.text;
    w->message = h5_dataset(&w->h, w->h.file, &outcome);
    for (int i = 0; i < w->content->table->n_item && !w->h.failed; i++) {
        w->dataset[i] = put_item(w, &w->content->table->item[i]);
    }
}
