// SPDX-License-Identifier: GPL-3.0-or-later
// The tree of a run: what is known before it, with its histories, and what is known after it.
#include <stdlib.h>
#include <string.h>

#include "jostle/numerics.h"
#include "model/forces.h"
#include "result/h5_partial.h"
#include "result/study_sweep.h"
#include "result/writer.h"

// Rows of a chunk of a history of `width` values a row; 0: contiguous, as all rows are written at
// once. The histories of a run that may collapse can be cut, and leave less than a chunk of CUT
// rows unused. A chunk and its index take some 300 bytes more, which compression saves in
// COMPRESSED_MIN bytes and more: it leaves out a tenth at least of the histories of buildings.
static hsize_t chunk_rows(const struct result_writer *w, size_t width) {
    enum { COMPRESSED_MIN = 3072, CUT = 256 };
    const size_t number = w->model->output.single ? sizeof(float) : sizeof(double);
    const bool compressed = w->model->output.compress > 0 &&
                            (size_t)w->report->n_row * width * number >= COMPRESSED_MIN;
    const bool in_chunks = writer_in_blocks(w) || compressed || w->model->collapse;
    const size_t rows = w->model->collapse && w->capacity > CUT ? CUT : w->capacity;
    return in_chunks ? rows : 0;
}

// A history of `width` values a row; width_scale 0: one value, one dimension.
static void put_history(struct result_writer *w, hid_t parent, const char *name,
                        struct quantity quantity, struct stream s, hid_t width_scale) {
    const struct h5_dataset d = {
        .name = name,
        .quantity = quantity,
        .file_type = w->model->output.single ? H5T_IEEE_F32LE : H5T_IEEE_F64LE,
        .n_dim = width_scale > 0 ? 2 : 1,
        .dim = {(hsize_t)w->report->n_row, s.width},
        .scale = {w->tree.time, width_scale},
        .chunk_rows = chunk_rows(w, s.width),
        .may_be_cut = w->model->collapse != NULL,
        .compress = w->model->output.compress,
    };
    writer_stream(w, parent, &d, s);
}

static void put_time(struct result_writer *w) {
    enum { USERS_FEW = 1000 };
    const struct h5_dataset d = {
        .name = "time",
        .quantity = {"time", &dimension_time},
        .file_type = H5T_IEEE_F64LE,
        .n_dim = 1,
        .dim = {(hsize_t)w->report->n_row},
        .chunk_rows = chunk_rows(w, 1),
        .may_be_cut = w->model->collapse != NULL,
        .many_users = w->stream_capacity > USERS_FEW,
    };
    writer_stream(w, w->root, &d, (struct stream){.source = SOURCE_TIME, .width = 1});
    w->tree.time = w->n_stream > 0 ? w->stream[0].dataset : -1;
}

// Properties of a run of a study are in the tree of the study, unless a sweep has their name.
static void put_columns(struct result_writer *w, const struct tree_group *g,
                        const struct column_table *t, const void *base, size_t n) {
    const struct result_place *p = w->place;
    for (int c = 0; c < t->n_column && !w->h->failed; c++) {
        const char *name = t->column[c].name;
        if (!p || strncmp(name, "law", 3) == 0 || study_sweep_has(p->sweep, p->n_sweep, name)) {
            h5_put_column(w->h, g->group, t, c, base, n, g->scale);
        }
    }
}

// The members of frames and walls: their names, and the histories of their forces.
static void put_members(struct result_writer *w, hid_t building, const struct report_building *b,
                        const struct building *model) {
    const size_t n = (size_t)b->n_member;
    const struct tree_group g = tree_group(&w->tree, building, "members", "member", n);
    put_columns(w, &g, &layout_member, b->member, n);
    const int n_quantity = forces_quantities(model);
    for (int q = 0; q < n_quantity && w->report->fields & FIELD_MEMBERS; q++) {
        const size_t first = (size_t)model->force + (size_t)forces_of_members(model, 0, q);
        const struct stream s = {.source = SOURCE_MEMBER_FORCE, .first = first, .width = n};
        put_history(w, g.group, report_force_names[q], layout_member_field[q], s, g.scale);
    }
    tree_close(&w->tree, &g);
}

// The shares of what resists, a group each.
static void put_shares(struct result_writer *w, hid_t building, const struct report_building *b,
                       const struct building *model) {
    const size_t n = (size_t)b->n_floor;
    const struct tree_group all =
        tree_group(&w->tree, building, "parts", "part", (size_t)b->n_share);
    put_columns(w, &all, &layout_share, b->share, (size_t)b->n_share);
    for (int i = 0, number = 0; i < b->n_share; i++, number++) {
        while (forces_of_share(model, number) < 0) {
            number++;
        }
        const struct tree_group g = tree_group(&w->tree, all.group, b->share[i].name, "floor", n);
        if (w->report->fields & FIELD_MEMBERS) {
            const struct stream s = {.source = SOURCE_MEMBER_FORCE,
                                     .first =
                                         (size_t)(model->force + forces_of_share(model, number)),
                                     .width = n};
            put_history(w, g.group, "storey_shear", layout_share_field, s, g.scale);
        }
        tree_close(&w->tree, &g);
    }
    tree_close(&w->tree, &all);
}

// What the foundation does: its motion with the displacements, its forces with the shears.
static void put_foundation(struct result_writer *w, hid_t building, const struct building *model) {
    static const enum field field[] = {FIELD_DISPLACEMENT, FIELD_DISPLACEMENT, FIELD_STOREY_SHEAR,
                                       FIELD_STOREY_SHEAR};
    const struct tree_group g = tree_group(&w->tree, building, "foundation", "slab", 1);
    for (int q = 0; q < FOUNDATION_QUANTITIES; q++) {
        const struct stream s = {.source = SOURCE_MEMBER_FORCE,
                                 .first = (size_t)(model->force + forces_of_foundation(model) + q),
                                 .width = 1};
        if (w->report->fields & field[q]) {
            put_history(w, g.group, report_foundation_names[q], layout_foundation_field[q], s,
                        g.scale);
        }
    }
    tree_close(&w->tree, &g);
}

static void put_building(struct result_writer *w, hid_t parent, int position) {
    const struct report_building *b = &w->report->building[position];
    const struct building *model = &w->model->building[position];
    const size_t n = (size_t)b->n_floor;
    const struct tree_group g = tree_building(&w->tree, parent, b, position);
    if (w->place) {
        h5_put_long(w->h, g.group, "yields", !model->elastic);
    }
    put_columns(w, &g, &layout_building, b, n);
    if (b->axial && !w->place) {
        put_columns(w, &g, &layout_pdelta, b, n);
    }
    for (int f = 0; f < FLOOR_FIELD_COUNT; f++) {
        if (w->report->fields >> f & 1) {
            const struct stream s = {
                .source = SOURCE_FLOOR_FIELD + f, .first = (size_t)model->first, .width = n};
            put_history(w, g.group, field_names[f], layout_field[f], s, g.scale);
        }
    }
    if (b->n_member > 0) {
        put_members(w, g.group, b, model);
    }
    if (b->n_share > 0) {
        put_shares(w, g.group, b, model);
    }
    if (b->foundation) {
        put_foundation(w, g.group, model);
    }
    tree_close(&w->tree, &g);
}

// /contacts or /links: the table of the links and the histories of their force and penetration.
static void put_links(struct result_writer *w, const struct link_group *group,
                      const struct report_link *link, size_t first, size_t n) {
    const struct tree_group g = tree_group(&w->tree, w->root, group->name, group->scale, n);
    put_columns(w, &g, &layout_link, link, n);
    if (layout_has_levels(link, (int)n)) {
        put_columns(w, &g, &layout_level, link, n);
    }
    for (int f = 0; f < 2; f++) {
        if (w->report->fields >> (FLOOR_FIELD_COUNT + f) & 1) {
            const struct stream s = {.source = SOURCE_FORCE + f, .first = first, .width = n};
            put_history(w, g.group, group->field[f], group->quantity[f], s, g.scale);
        }
    }
    tree_close(&w->tree, &g);
}

// Buildings on the same ground share one dataset. A building called `time` takes the place of the
// linked scale.
static void put_ground(struct result_writer *w) {
    const struct model *m = w->model;
    static const struct quantity quantity = {"ground acceleration as applied",
                                             &dimension_acceleration};
    hid_t group = h5_group(w->h, w->root, "ground");
    int *owner = calloc((size_t)m->n_ground + 1, sizeof *owner);
    if (!owner) {
        h5_no_memory(w->h);
        h5_close(w->h, group);
        return;
    }
    bool time_is_taken = false;
    for (int i = 0; i < m->n_building && !w->h->failed; i++) {
        const struct building *b = &m->building[i];
        time_is_taken = time_is_taken || strcmp(b->name, "time") == 0;
        if (owner[b->ground] > 0) {
            h5_hard_link(w->h, w->stream[owner[b->ground]].dataset, group, b->name);
            continue;
        }
        const struct stream s = {.source = SOURCE_GROUND, .first = (size_t)b->ground, .width = 1};
        put_history(w, group, b->name, quantity, s, 0);
        owner[b->ground] = w->n_stream - 1;
    }
    if (!time_is_taken) {
        h5_hard_link(w->h, w->tree.time, group, "time");
    }
    free(owner);
    h5_close(w->h, group);
}

void writer_layout(struct result_writer *w) {
    const struct report *r = w->report;
    if (!w->place) {
        h5_partial_attributes(w->h, w->root, r, NUMERICS_VERSION);
    }
    for (int c = 0; c < layout_root.n_column; c++) {
        if (!w->place || !layout_is_shared(&layout_root.column[c])) {
            h5_put_member(w->h, w->root, &layout_root, c, r);
        }
    }
    put_time(w);
    hid_t buildings = h5_group(w->h, w->root, "buildings");
    for (int i = 0; i < r->n_building && !w->h->failed; i++) {
        put_building(w, buildings, i);
    }
    h5_close(w->h, buildings);
    put_links(w, &layout_contacts, r->contact, 0, (size_t)r->n_contact);
    if (r->n_link > 0) {
        put_links(w, &layout_links, r->link, (size_t)r->n_contact, (size_t)r->n_link);
    }
    if (r->n_column > 0) {
        put_links(w, &layout_columns, r->column, (size_t)r->n_contact + (size_t)r->n_link,
                  (size_t)r->n_column);
    }
    const struct tree_group g = tree_group(&w->tree, w->root, "energy", NULL, 0);
    for (size_t i = 0; i < ENERGY_COUNT; i++) {
        const struct column *c = &layout_energy.column[i];
        const struct stream s = {.source = SOURCE_ENERGY, .first = i, .width = 1};
        put_history(w, g.group, c->name, (struct quantity){c->long_name, c->dimension}, s, 0);
    }
    tree_close(&w->tree, &g);
    put_ground(w);
}

// The envelope at a place: those of a run of a study are in the tree of the study.
static void put_envelope(void *context, const struct layout_place *p) {
    struct result_writer *w = context;
    if (!p->leaf || w->place) {
        return;
    }
    hid_t parent = h5_open_object(w->h, w->root, p->parent);
    const hid_t owner = h5_open_object(w->h, parent, p->owner ? p->owner : ".");
    const struct tree_group g = {owner, h5_open_object(w->h, owner, p->scale), p->scale};
    hid_t envelope = tree_envelope(&w->tree, &g);
    for (int c = 0; c < p->table->n_column && !w->h->failed; c++) {
        if (p->n == 0 || layout_at(p->table, c, p->base, 0)) {  // else no storey can yield
            h5_put_column(w->h, envelope, p->table, c, p->base, p->n, g.scale);
        }
    }
    h5_close(w->h, envelope);
    tree_close(&w->tree, &g);
    h5_close(w->h, parent);
}

// The signed extremes of members, beside their sizes.
static void put_extremes(struct result_writer *w, const struct report_building *b) {
    const struct column_table *t = &layout_member_extreme[b->hinged];
    hid_t building = h5_open_object(w->h, w->root, b->path);
    hid_t members = h5_open_object(w->h, building, "members");
    hid_t scale = h5_open_object(w->h, members, "member");
    hid_t envelope = h5_open_object(w->h, members, "envelope");
    for (int c = 0; c < t->n_column && !w->h->failed; c++) {
        h5_put_column(w->h, envelope, t, c, b->member, (size_t)b->n_member, scale);
    }
    h5_close(w->h, envelope);
    h5_close(w->h, scale);
    h5_close(w->h, members);
    h5_close(w->h, building);
}

void writer_results(struct result_writer *w, const struct report *r) {
    struct h5 *h = w->h;
    layout_each(r, put_envelope, w);
    for (int i = 0; !w->place && i < r->n_building; i++) {
        if (r->building[i].n_member > 0) {
            put_extremes(w, &r->building[i]);
        }
    }
    hid_t impacts = h5_group(h, w->root, "impacts");
    hid_t scale = h5_put_scale(h, impacts, "impact", "impact", (size_t)r->n_impact);
    for (int c = 0; c < layout_impact.n_column; c++) {
        h5_put_column(h, impacts, &layout_impact, c, r->impact, (size_t)r->n_impact, scale);
    }
    h5_close(h, scale);
    h5_close(h, impacts);
    // The account at the end as attributes: histories may be of single precision.
    for (int i = 0; i < w->n_stream; i++) {
        const struct stream *s = &w->stream[i];
        if (s->source == SOURCE_ENERGY) {
            h5_put_double(h, s->dataset, "final", r->energy[s->first]);
        }
    }
    hid_t energy = h5_open_object(h, w->root, "energy");
    for (int c = ENERGY_COUNT; c < layout_energy.n_column; c++) {
        h5_put_member(h, energy, &layout_energy, c, r);
    }
    h5_close(h, energy);
    for (int c = 0; c < layout_totals.n_column; c++) {
        h5_put_member(h, w->root, &layout_totals, c, r);
    }
    for (int c = 0; c < layout_collapse.n_column; c++) {
        h5_put_member(h, w->root, &layout_collapse, c, r);
    }
}
