// SPDX-License-Identifier: GPL-3.0-or-later
// The groups of the file. A scale is hard-linked into each group that uses it, so that a group
// opened alone (as xarray does) shows its coordinates.
#include <stdlib.h>
#include <string.h>

#include "jostle/numerics.h"
#include "result/h5_draft.h"
#include "result/study_along.h"
#include "result/study_writer.h"
#include "result/writer.h"

// Rows of a chunk of a history of `width` values a row; 0: contiguous, as all rows are written at
// once. A chunk and its index take some 300 bytes more, which compression saves in COMPRESSED_MIN
// bytes and more: it leaves out a tenth at least of the histories of buildings.
static hsize_t chunk_rows(const struct result_writer *w, size_t width) {
    enum { COMPRESSED_MIN = 3072 };
    const size_t number = w->model->output.single ? sizeof(float) : sizeof(double);
    const bool compressed = w->model->output.compress > 0 &&
                            (size_t)w->report->n_row * width * number >= COMPRESSED_MIN;
    return writer_in_blocks(w) || compressed ? w->capacity : 0;
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
        .scale = {w->time, width_scale},
        .chunk_rows = chunk_rows(w, s.width),
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
        .many_users = w->stream_capacity > USERS_FEW,
    };
    writer_stream(w, w->root, &d, (struct stream){.source = SOURCE_TIME, .width = 1});
    w->time = w->n_stream > 0 ? w->stream[0].dataset : -1;
}

// Properties of a run of a study are in the tree of the study, unless a sweep has their name.
static bool is_elsewhere(const struct result_writer *w, const char *property) {
    return w->place && !study_along_has(w->place->sweep, w->place->n_sweep, property);
}

static void put_building(struct result_writer *w, hid_t parent, int position) {
    const struct report_building *b = &w->report->building[position];
    const size_t n = (size_t)b->n_floor;
    hid_t group = h5_group(w->h, parent, b->name);
    h5_put_long(w->h, group, "position", position);
    hid_t floor = h5_put_scale(w->h, group, "floor", "floor", n);
    h5_hard_link(w->h, w->time, group, "time");
    if (w->place) {
        h5_put_long(w->h, group, "yields", !w->model->building[position].elastic);
    }
    for (int c = 0; c < layout_building.n_column && !w->h->failed; c++) {
        if (is_elsewhere(w, layout_building.column[c].name)) {
            continue;
        }
        const double *const *value = layout_at(&layout_building, c, b, 0);
        const struct h5_dataset d = {
            .name = layout_building.column[c].name,
            .quantity = {layout_building.column[c].long_name, layout_building.column[c].dimension},
            .memory_type = H5T_NATIVE_DOUBLE,
            .file_type = H5T_IEEE_F64LE,
            .n_dim = 1,
            .dim = {n},
            .scale = {floor},
        };
        h5_put(w->h, group, &d, *value);
    }
    for (int f = 0; f < FLOOR_FIELD_COUNT; f++) {
        if (w->report->fields >> f & 1) {
            const struct stream s = {.source = SOURCE_FLOOR_FIELD + f,
                                     .first = (size_t)w->model->building[position].first,
                                     .width = n};
            put_history(w, group, field_names[f], layout_field[f], s, floor);
        }
    }
    h5_close(w->h, floor);
    h5_close(w->h, group);
}

// /contacts or /links: the table of the links and the histories of their force and penetration.
static void put_links(struct result_writer *w, const struct link_group *g,
                      const struct report_link *link, size_t first, size_t n) {
    hid_t group = h5_group(w->h, w->root, g->name);
    hid_t scale = h5_put_scale(w->h, group, g->scale, g->scale, n);
    h5_hard_link(w->h, w->time, group, "time");
    for (int c = 0; c < layout_link.n_column; c++) {
        const struct column *column = &layout_link.column[c];
        if (strncmp(column->name, "law", 3) == 0 || !is_elsewhere(w, column->name)) {
            h5_put_column(w->h, group, &layout_link, c, link, n, scale);
        }
    }
    for (int c = 0; c < layout_level.n_column && layout_has_levels(link, (int)n); c++) {
        if (!is_elsewhere(w, layout_level.column[c].name)) {
            h5_put_column(w->h, group, &layout_level, c, link, n, scale);
        }
    }
    for (int f = 0; f < 2; f++) {
        if (w->report->fields >> (FLOOR_FIELD_COUNT + f) & 1) {
            const struct stream s = {.source = SOURCE_FORCE + f, .first = first, .width = n};
            put_history(w, group, g->field[f], g->quantity[f], s, scale);
        }
    }
    h5_close(w->h, scale);
    h5_close(w->h, group);
}

static void put_energy(struct result_writer *w) {
    hid_t group = h5_group(w->h, w->root, "energy");
    h5_hard_link(w->h, w->time, group, "time");
    for (size_t i = 0; i < ENERGY_COUNT; i++) {
        const struct stream s = {.source = SOURCE_ENERGY, .first = i, .width = 1};
        put_history(w, group, energy_names[i], layout_energy[i], s, 0);
    }
    h5_close(w->h, group);
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
        h5_hard_link(w->h, w->time, group, "time");
    }
    free(owner);
    h5_close(w->h, group);
}

static void put_attributes(struct result_writer *w) {
    if (!w->place) {
        h5_draft_attributes(w->h, w->root, w->report, NUMERICS_VERSION);
    }
    for (int c = 0; c < layout_root.n_column; c++) {
        if (!w->place || !study_tree_is_shared(&layout_root.column[c])) {
            h5_put_member(w->h, w->root, &layout_root, c, w->report);
        }
    }
}

void writer_layout(struct result_writer *w) {
    const struct report *r = w->report;
    put_attributes(w);
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
    put_energy(w);
    put_ground(w);
}
