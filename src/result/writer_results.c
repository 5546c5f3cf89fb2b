// SPDX-License-Identifier: GPL-3.0-or-later
// What is known only after the run: envelopes, impacts, totals.
#include <stdio.h>

#include "result/writer.h"

// The envelope of a building, being written.
struct envelope {
    hid_t group, floor;
    hsize_t n_floor;
};

static void put_values(struct h5 *h, const struct envelope *to, const char *name,
                       struct quantity quantity, const double *value) {
    const struct h5_dataset d = {
        .name = name,
        .quantity = quantity,
        .memory_type = H5T_NATIVE_DOUBLE,
        .file_type = H5T_IEEE_F64LE,
        .n_dim = 1,
        .dim = {to->n_floor},
        .scale = {to->floor},
    };
    h5_put(h, to->group, &d, value);
}

static void put_peak(struct h5 *h, const struct envelope *to, const struct report_building *b,
                     int p) {
    char name[64], long_name[128];
    put_values(h, to, peak_names[p], layout_peak[p], b->peak[p]);
    snprintf(name, sizeof name, "%s_time", peak_names[p]);
    snprintf(long_name, sizeof long_name, "time of the %s", layout_peak[p].long_name);
    put_values(h, to, name, (struct quantity){long_name, &dimension_time}, b->peak_time[p]);
}

static void put_envelope(struct h5 *h, hid_t buildings, const struct report_building *b) {
    hid_t building = h5_open_object(h, buildings, b->name);
    const struct envelope to = {.group = h5_group(h, building, "envelope"),
                                .floor = h5_open_object(h, building, "floor"),
                                .n_floor = (hsize_t)b->n_floor};
    h5_hard_link(h, to.floor, to.group, "floor");
    for (int p = 0; p < PEAK_COUNT && !h->failed; p++) {
        put_peak(h, &to, b, p);
    }
    if (b->residual_drift) {
        put_values(h, &to, layout_residual_drift_name, layout_residual_drift, b->residual_drift);
    }
    h5_close(h, to.group);
    h5_close(h, to.floor);
    h5_close(h, building);
}

static void put_link_envelope(struct h5 *h, hid_t root, const struct link_group *g,
                              const struct report_link *link, size_t n) {
    hid_t group = h5_open_object(h, root, g->name);
    hid_t scale = h5_open_object(h, group, g->scale);
    hid_t envelope = h5_group(h, group, "envelope");
    h5_hard_link(h, scale, envelope, g->scale);
    for (int c = 0; c < g->peaks->n_column; c++) {
        h5_put_column(h, envelope, g->peaks, c, link, n, scale);
    }
    h5_close(h, envelope);
    h5_close(h, scale);
    h5_close(h, group);
}

static void put_impacts(struct h5 *h, hid_t root, const struct report *r) {
    const size_t n = (size_t)r->n_impact;
    hid_t group = h5_group(h, root, "impacts");
    hid_t scale = h5_put_scale(h, group, "impact", "impact", n);
    for (int c = 0; c < layout_impact.n_column; c++) {
        h5_put_column(h, group, &layout_impact, c, r->impact, n, scale);
    }
    h5_close(h, scale);
    h5_close(h, group);
}

// The account at the end as attributes: histories may be of single precision.
static void put_energy_end(struct result_writer *w, const struct report *r) {
    struct h5 *h = w->h;
    for (int i = 0; i < w->n_stream; i++) {
        const struct stream *s = &w->stream[i];
        if (s->source == SOURCE_ENERGY) {
            h5_put_double(h, s->dataset, "final", r->energy[s->first]);
        }
    }
    hid_t group = h5_open_object(h, w->root, "energy");
    h5_put_double(h, group, "initial", r->initial_energy);
    h5_put_double(h, group, "residual_peak", r->residual_peak);
    h5_close(h, group);
}

// Those of a run of a study are in the tree of the study.
static void put_envelopes(struct h5 *h, hid_t root, const struct report *r) {
    hid_t buildings = h5_open_object(h, root, "buildings");
    for (int i = 0; i < r->n_building && !h->failed; i++) {
        put_envelope(h, buildings, &r->building[i]);
    }
    h5_close(h, buildings);
    put_link_envelope(h, root, &layout_contacts, r->contact, (size_t)r->n_contact);
    if (r->n_link > 0) {
        put_link_envelope(h, root, &layout_links, r->link, (size_t)r->n_link);
    }
}

void writer_results(struct result_writer *w, const struct report *r) {
    struct h5 *h = w->h;
    if (!w->place) {
        put_envelopes(h, w->root, r);
    }
    put_impacts(h, w->root, r);
    put_energy_end(w, r);
    for (int c = 0; c < layout_totals.n_column; c++) {
        h5_put_member(h, w->root, &layout_totals, c, &r->totals);
    }
}
