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

// A history with a value for each owner in the group; without a scale, one value and one dimension.
static void put_history(struct result_writer *w, const struct tree_group *g, size_t width,
                        const char *name, struct quantity quantity, int source, int first) {
    const struct h5_dataset d = {
        .name = name,
        .quantity = quantity,
        .file_type = w->model->output.single ? H5T_IEEE_F32LE : H5T_IEEE_F64LE,
        .n_dim = g->scale > 0 ? 2 : 1,
        .dim = {(hsize_t)w->report->n_row, width},
        .scale = {w->tree.time, g->scale > 0 ? g->scale : 0},
        .chunk_rows = chunk_rows(w, width),
        .may_be_cut = w->model->collapse != NULL,
        .compress = w->model->output.compress,
    };
    writer_stream(w, g->group, &d,
                  (struct stream){.source = source, .first = (size_t)first, .width = width});
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
                        const struct column_table *t, const struct layout_group *of) {
    const struct result_place *p = w->place;
    for (int c = 0; c < t->n_column && !w->h->failed; c++) {
        const char *name = t->column[c].name;
        if (!p || strncmp(name, "law", 3) == 0 || study_sweep_has(p->sweep, p->n_sweep, name)) {
            h5_put_column(w->h, g->group, t, c, of->base, of->n, g->scale);
        }
    }
}

// The number of part `i` in the model, where some parts have no forces.
static int number_of_part(const struct building *model, int i) {
    int number = 0;
    for (int before = 0; before < i || forces_of_share(model, number) < 0; number++) {
        before += forces_of_share(model, number) >= 0;
    }
    return number;
}

// The histories of a group.
static void put_histories(struct result_writer *w, const struct tree_group *g,
                          const struct layout_group *of) {
    static const enum field of_slab[] = {FIELD_DISPLACEMENT, FIELD_DISPLACEMENT, FIELD_STOREY_SHEAR,
                                         FIELD_STOREY_SHEAR};
    const struct building *b = &w->model->building[of->building];
    const unsigned fields = w->report->fields;
    const bool members = fields & FIELD_MEMBERS;
    switch (of->kind) {
        case LAYOUT_BUILDING:
            for (int f = 0; f < FLOOR_FIELD_COUNT; f++) {
                if (fields >> f & 1) {
                    put_history(w, g, of->n, field_names[f], layout_field[f],
                                SOURCE_FLOOR_FIELD + f, b->first);
                }
            }
            break;
        case LAYOUT_MEMBERS:
            for (int q = 0; members && q < forces_quantities(b); q++) {
                put_history(w, g, of->n, report_force_names[q], layout_member_field[q],
                            SOURCE_MEMBER_FORCE, b->force + forces_of_members(b, 0, q));
            }
            break;
        case LAYOUT_PART:
            if (members) {
                put_history(w, g, of->n, "storey_shear", layout_share_field, SOURCE_MEMBER_FORCE,
                            b->force + forces_of_share(b, number_of_part(b, of->number)));
            }
            break;
        case LAYOUT_FOUNDATION:  // its motion with the displacements, its forces with the shears
            for (int q = 0; q < FOUNDATION_QUANTITIES; q++) {
                if (fields & of_slab[q]) {
                    put_history(w, g, 1, report_foundation_names[q], layout_foundation_field[q],
                                SOURCE_MEMBER_FORCE, b->force + forces_of_foundation(b) + q);
                }
            }
            break;
        case LAYOUT_LINKS:
            for (int f = 0; f < 2; f++) {
                if (fields >> (FLOOR_FIELD_COUNT + f) & 1) {
                    put_history(w, g, of->n, of->links->field[f], of->links->quantity[f],
                                SOURCE_FORCE + f, of->number);
                }
            }
            break;
        case LAYOUT_ENERGY:
            for (int i = 0; i < ENERGY_COUNT; i++) {
                const struct column *c = &layout_energy.column[i];
                put_history(w, g, 1, c->name, (struct quantity){c->long_name, c->dimension},
                            SOURCE_ENERGY, i);
            }
            break;
        case LAYOUT_PARTS:
        case LAYOUT_TOTALS:
            break;
    }
}

// Everything in a group that is known before the run.
static void put_group(void *context, const struct layout_group *of) {
    struct result_writer *w = context;
    if (of->kind == LAYOUT_TOTALS || w->h->failed) {
        return;
    }
    const struct tree_group g = tree_group(&w->tree, w->root, of);
    if (of->kind == LAYOUT_BUILDING && w->place) {
        h5_put_long(w->h, g.group, "yields", !w->model->building[of->building].elastic);
    }
    for (int i = 0; i < 2 && of->own[i] && of->scale; i++) {
        put_columns(w, &g, of->own[i], of);
    }
    if (of->kind == LAYOUT_BUILDING && w->report->building[of->building].axial && !w->place) {
        put_columns(w, &g, &layout_pdelta, of);
    }
    put_histories(w, &g, of);
    tree_close(&w->tree, &g);
}

// Buildings on the same ground share one dataset. A building called `time` takes the place of the
// linked scale.
static void put_ground(struct result_writer *w) {
    const struct model *m = w->model;
    static const struct quantity quantity = {"ground acceleration as applied",
                                             &dimension_acceleration};
    const struct tree_group g = {h5_group(w->h, w->root, "ground"), -1, NULL};
    int *owner = calloc((size_t)m->n_ground + 1, sizeof *owner);
    if (!owner) {
        h5_no_memory(w->h);
        h5_close(w->h, g.group);
        return;
    }
    bool time_is_taken = false;
    for (int i = 0; i < m->n_building && !w->h->failed; i++) {
        const struct building *b = &m->building[i];
        time_is_taken = time_is_taken || strcmp(b->name, "time") == 0;
        if (owner[b->ground] > 0) {
            h5_hard_link(w->h, w->stream[owner[b->ground]].dataset, g.group, b->name);
            continue;
        }
        put_history(w, &g, 1, b->name, quantity, SOURCE_GROUND, b->ground);
        owner[b->ground] = w->n_stream - 1;
    }
    if (!time_is_taken) {
        h5_hard_link(w->h, w->tree.time, g.group, "time");
    }
    free(owner);
    h5_close(w->h, g.group);
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
    h5_close(w->h, h5_group(w->h, w->root, "buildings"));
    layout_groups(r, put_group, w);
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
