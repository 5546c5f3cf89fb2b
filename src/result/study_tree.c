// SPDX-License-Identifier: GPL-3.0-or-later
// The tree of a study file. The scales of the sweeps are in /sweep and are hard-linked into each
// group with values, so that a group opened alone (as xarray does) shows its coordinates.
#include <stdio.h>
#include <string.h>

#include "result/h5_draft.h"
#include "result/study_along.h"
#include "result/study_writer.h"

enum { GROUP_MAX = 4096 };

static int check_name(const struct study_content *c, const struct sweep *s, struct error *e) {
    static const char *const taken[] = {
        "status", "message",    "sweep",      "buildings", "contacts",    "links",
        "energy", "totals",     "floor",      "contact",   "envelope",    "link",
        "name",   "left",       "left_floor", "right",     "right_floor", "runs",
        "origin", "left_below", "right_below"};
    bool bad = false;
    for (size_t i = 0; i < sizeof taken / sizeof taken[0]; i++) {
        bad = bad || strcmp(taken[i], s->name) == 0;
    }
    for (int i = 0; i < c->table->n_item; i++) {
        const struct study_item *item = &c->table->item[i];
        bad = bad || (!item->property && strcmp(item->name, s->name) == 0);
    }
    return bad && !s->fixed
               ? error_set(e, STATUS_INPUT,
                           "sweep '%s' has the name of a result; give its parameter another one",
                           s->name)
               : STATUS_OK;
}

int study_tree_check(const struct study_content *c, struct error *e) {
    int status = STATUS_OK;
    for (const struct sweep *s = c->sweeps; s && status == STATUS_OK; s = s->next) {
        for (const struct sweep *p = s; p && status == STATUS_OK; p = p->along) {
            status = check_name(c, p, e);
        }
    }
    return status;
}

bool study_tree_is_shared(const struct column *c) {
    static const char *const of_one_run[] = {"parameters", "command_line", "duration", "step"};
    bool shared = true;
    for (size_t i = 0; i < sizeof of_one_run / sizeof of_one_run[0]; i++) {
        shared = shared && strcmp(c->name, of_one_run[i]) != 0;
    }
    return shared;
}

static void put_attributes(struct study_writer *w) {
    const struct report *r = w->content->first;
    h5_draft_attributes(&w->h, w->h.file, r, w->content->origin->numerics);
    for (int c = 0; c < layout_root.n_column; c++) {
        if (study_tree_is_shared(&layout_root.column[c])) {
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

// The values of a sweep, open: a scale, or, with the `scale` of their dimension, values along it. A
// number without a unit may be of any dimension: only its use says which.
static hid_t put_values(struct study_writer *w, hid_t group, const struct sweep *s, hid_t scale) {
    struct h5_dataset d = {
        .name = s->name,
        .quantity = {"swept parameter", s->number && s->known ? &s->dimension : NULL},
        .memory_type = s->number ? H5T_NATIVE_DOUBLE : w->h.text,
        .file_type = s->number ? H5T_IEEE_F64LE : w->h.text,
        .n_dim = 1,
        .dim = {(hsize_t)s->n},
        .scale = {scale},
        .many_users = true,
    };
    hid_t dataset = h5_dataset(&w->h, group, &d);
    if (s->number && !s->known) {
        h5_put_text(&w->h, dataset, "units", "unknown");
    }
    const struct h5_block all = {.count = {d.dim[0]}, .n = d.dim[0], .stride = 1, .width = 1};
    if (s->number) {
        h5_put_block(&w->h, dataset, &all, s->number);
    } else {
        h5_put_texts(&w->h, dataset, &all, s->label);
    }
    return dataset;
}

hid_t study_tree_sweep(struct study_writer *w, hid_t group, const struct sweep *s) {
    hid_t scale = put_values(w, group, s, 0);
    for (const struct sweep *p = s->along; p; p = p->along) {
        hid_t values = put_values(w, group, p, scale);
        study_along_put_dimension(&w->h, values, p);
        h5_close(&w->h, values);
    }
    study_along_put_names(&w->h, scale, s);
    return scale;
}

static void link_scales(struct study_writer *w, hid_t group) {
    for (int i = 0; i < w->n_sweep; i++) {
        h5_hard_link(&w->h, w->scale[i], group, w->sweep[i]->name);
        study_along_link(w, group, w->sweep[i]);
    }
    study_along_put_coordinates(&w->h, group, w->sweep, w->n_sweep);
}

// A group with the scale of its values, if it has one, and a group "envelope" with the same.
static void put_envelope(struct study_writer *w, hid_t group, const char *name, hid_t scale) {
    hid_t envelope = h5_group(&w->h, group, "envelope");
    h5_hard_link(&w->h, scale, envelope, name);
    link_scales(w, envelope);
    h5_close(&w->h, envelope);
}

static void put_building(struct study_writer *w, hid_t parent, int position) {
    const struct report_building *b = &w->content->first->building[position];
    hid_t group = h5_group(&w->h, parent, b->name);
    h5_put_long(&w->h, group, "position", position);
    hid_t floor = h5_put_scale(&w->h, group, "floor", "floor", (size_t)b->n_floor);
    link_scales(w, group);
    put_envelope(w, group, "floor", floor);
    h5_close(&w->h, floor);
    h5_close(&w->h, group);
}

// What is the same for the links of all runs. The law may be swept: the deck says which it is.
bool study_tree_is_fixed(const struct column *c) {
    return c->kind == COLUMN_INT || (c->kind == COLUMN_TEXT && strncmp(c->name, "law", 3) != 0);
}

static void put_links(struct study_writer *w, const struct link_group *g,
                      const struct report_link *link, int n) {
    hid_t group = h5_group(&w->h, w->h.file, g->name);
    hid_t scale = h5_put_scale(&w->h, group, g->scale, g->scale, (size_t)n);
    for (int c = 0; c < layout_link.n_column; c++) {
        if (study_tree_is_fixed(&layout_link.column[c])) {
            h5_put_column(&w->h, group, &layout_link, c, link, (size_t)n, scale);
        }
    }
    for (int c = 0; c < layout_level.n_column && layout_has_levels(link, n); c++) {
        if (study_tree_is_fixed(&layout_level.column[c])) {
            h5_put_column(&w->h, group, &layout_level, c, link, (size_t)n, scale);
        }
    }
    link_scales(w, group);
    put_envelope(w, group, g->scale, scale);
    h5_close(&w->h, scale);
    h5_close(&w->h, group);
}

static void put_group(struct study_writer *w, const char *name) {
    hid_t group = h5_group(&w->h, w->h.file, name);
    link_scales(w, group);
    h5_close(&w->h, group);
}

// A dataset of the sweep dimensions; that of its own values comes last.
static struct h5_dataset over_sweeps(const struct study_writer *w, const char *name) {
    struct h5_dataset d = {.name = name, .n_dim = w->n_sweep};
    for (int i = 0; i < w->n_sweep; i++) {
        d.dim[i] = (hsize_t)w->sweep[i]->n;
        d.scale[i] = w->scale[i];
    }
    return d;
}

static hid_t put_item(struct study_writer *w, const struct study_item *item) {
    char path[GROUP_MAX];
    if (study_along_has(w->sweep, w->n_sweep, item->name)) {
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

static void put_outcome(struct study_writer *w) {
    struct h5_dataset d = over_sweeps(w, "status");
    d.quantity.long_name = "0: done, 1: failed, 2: missing";
    d.file_type = H5T_STD_I32LE;
    w->status = h5_dataset(&w->h, w->h.file, &d);
    d.name = "message";
    d.quantity.long_name = "why the run failed";
    d.file_type = w->h.text;
    w->message = h5_dataset(&w->h, w->h.file, &d);
}

void study_tree(struct study_writer *w) {
    const struct report *r = w->content->first;
    put_attributes(w);
    hid_t sweep = h5_group(&w->h, w->h.file, "sweep");
    for (int i = 0; i < w->n_sweep; i++) {
        w->scale[i] = study_tree_sweep(w, sweep, w->sweep[i]);
    }
    h5_close(&w->h, sweep);
    link_scales(w, w->h.file);
    study_origin_put(w);
    if (w->content->part) {
        study_part_put(w);
    }
    hid_t buildings = h5_group(&w->h, w->h.file, "buildings");
    for (int i = 0; i < r->n_building && !w->h.failed; i++) {
        put_building(w, buildings, i);
    }
    h5_close(&w->h, buildings);
    put_links(w, &layout_contacts, r->contact, r->n_contact);
    if (r->n_link > 0) {
        put_links(w, &layout_links, r->link, r->n_link);
    }
    put_group(w, "energy");
    put_group(w, "totals");
    put_outcome(w);
    for (int i = 0; i < w->content->table->n_item && !w->h.failed; i++) {
        w->dataset[i] = put_item(w, &w->content->table->item[i]);
    }
}
