// SPDX-License-Identifier: GPL-3.0-or-later
// The values of a run in one row: properties and envelopes of buildings, contacts and links,
// energies at the end, totals. One walk over a report counts them, describes them or reads them.
#include "jostle/study_file.h"

#include <string.h>

#include "core/arena.h"
#include "result/layout.h"

// `item` NULL: nothing is described; `value` NULL: nothing is read.
struct walk {
    struct arena *arena;
    struct study_item *item;
    double *value;
    int n_item;
    size_t n_value;
};

// The next item; its place among the values is filled in. The values, or NULL.
static double *add(struct walk *w, struct study_item item) {
    item.first = w->n_value;
    if (w->item) {
        w->item[w->n_item] = item;
    }
    w->n_item++;
    w->n_value += item.n;
    return w->value ? w->value + item.first : NULL;
}

// Of zeros where `from` is NULL.
static void add_array(struct walk *w, struct study_item item, const double *from) {
    double *to = add(w, item);
    for (size_t i = 0; to && i < item.n; i++) {
        to[i] = from ? from[i] : 0.0;
    }
}

// Column `c` of the `item.n` structs at `base`.
static void add_column(struct walk *w, struct study_item item, const struct column_table *t, int c,
                       const void *base) {
    const struct column *column = &t->column[c];
    item.name = column->name;
    item.long_name = column->long_name ? column->long_name : column->name;
    item.dimension = column->dimension;
    double *to = add(w, item);
    for (size_t i = 0; to && i < item.n; i++) {
        const void *at = layout_at(t, c, base, i);
        if (column->kind == COLUMN_DOUBLE) {
            memcpy(&to[i], at, sizeof to[i]);
        } else {
            to[i] = (double)layout_whole(column, at);
        }
    }
}

static const char *joined(struct walk *w, const char *before, const char *text,
                          const char *behind) {
    return w->item ? arena_format(w->arena, "%s%s%s", before, text, behind) : "";
}

static void add_building(struct walk *w, const struct report_building *b) {
    struct study_item item = {.parent = "buildings",
                              .owner = b->name,
                              .scale = "floor",
                              .property = true,
                              .n = (size_t)b->n_floor};
    for (int c = 0; c < layout_building.n_column; c++) {
        item.name = layout_building.column[c].name;
        item.long_name = layout_building.column[c].long_name;
        item.dimension = layout_building.column[c].dimension;
        add_array(w, item, *(const double *const *)layout_at(&layout_building, c, b, 0));
    }
    item.leaf = "envelope";
    item.property = false;
    for (int p = 0; p < PEAK_COUNT; p++) {
        item.name = peak_names[p];
        item.long_name = layout_peak[p].long_name;
        item.dimension = layout_peak[p].dimension;
        add_array(w, item, b->peak[p]);
        item.name = joined(w, "", peak_names[p], "_time");
        item.long_name = joined(w, "time of the ", layout_peak[p].long_name, "");
        item.dimension = &dimension_time;
        add_array(w, item, b->peak_time[p]);
    }
    item.name = layout_residual_drift_name;
    item.long_name = layout_residual_drift.long_name;
    item.dimension = layout_residual_drift.dimension;
    add_array(w, item, b->residual_drift);
}

// Which floors a link connects is the same for all runs; texts are no values.
static bool is_link_value(const struct column *c) {
    return c->kind != COLUMN_TEXT && c->kind != COLUMN_INT;
}

static void add_links(struct walk *w, const struct link_group *g, const struct report_link *link,
                      int n) {
    struct study_item item = {
        .parent = g->name, .scale = g->scale, .property = true, .n = (size_t)n};
    for (int c = 0; c < layout_link.n_column; c++) {
        if (is_link_value(&layout_link.column[c])) {
            add_column(w, item, &layout_link, c, link);
        }
    }
    for (int c = 0; c < layout_level.n_column && layout_has_levels(link, n); c++) {
        if (is_link_value(&layout_level.column[c])) {
            add_column(w, item, &layout_level, c, link);
        }
    }
    item.leaf = "envelope";
    item.property = false;
    for (int c = 0; c < g->peaks->n_column; c++) {
        add_column(w, item, g->peaks, c, link);
    }
}

static void add_energy(struct walk *w, const struct report *r) {
    struct study_item item = {.parent = "energy", .dimension = &dimension_energy, .n = 1};
    for (int i = 0; i < ENERGY_COUNT; i++) {
        item.name = energy_names[i];
        item.long_name = joined(w, layout_energy[i].long_name, ", at the end", "");
        add_array(w, item, &r->energy[i]);
    }
    item.name = "initial";
    item.long_name = "kinetic and strain energy at t = 0";
    add_array(w, item, &r->initial_energy);
    item.name = "residual_peak";
    item.long_name = "largest absolute residual";
    add_array(w, item, &r->residual_peak);
}

// The wall time is no result: it differs from run to run.
static void add_totals(struct walk *w, const struct report *r) {
    struct study_item item = {.parent = "totals", .property = true, .n = 1};
    item.name = "duration";
    item.long_name = "length of the analysis";
    item.dimension = &dimension_time;
    add_array(w, item, &r->duration);
    item.name = "step";
    item.long_name = "time step";
    add_array(w, item, &r->dt);
    item.property = false;
    for (int c = 0; c < layout_totals.n_column; c++) {
        if (layout_totals.column[c].kind == COLUMN_LONG) {
            add_column(w, item, &layout_totals, c, &r->totals);
        }
    }
}

static void walk(struct walk *w, const struct report *r) {
    for (int i = 0; i < r->n_building; i++) {
        add_building(w, &r->building[i]);
    }
    add_links(w, &layout_contacts, r->contact, r->n_contact);
    if (r->n_link > 0) {
        add_links(w, &layout_links, r->link, r->n_link);
    }
    add_energy(w, r);
    add_totals(w, r);
}

int study_table_create(const struct report *r, struct study_table **out, struct error *e) {
    struct walk count = {0};
    walk(&count, r);
    struct arena *a = arena_create();
    struct study_table *t = a ? arena_alloc(a, 1, sizeof *t) : NULL;
    struct walk w = {.arena = a};
    w.item = t ? arena_alloc(a, (size_t)count.n_item, sizeof *w.item) : NULL;
    if (w.item) {
        walk(&w, r);
    }
    if (!w.item || arena_failed(a)) {
        arena_free(a);
        return error_no_memory(e);
    }
    *t = (struct study_table){.arena = a, .n_item = w.n_item, .item = w.item, .n_value = w.n_value};
    *out = t;
    return STATUS_OK;
}

void study_table_free(struct study_table *t) {
    if (t) {
        arena_free(t->arena);
    }
}

void study_table_read(const struct report *r, double *value) {
    walk(&(struct walk){.value = value}, r);
}

static bool same_text(const char *a, const char *b) {
    return a && b ? strcmp(a, b) == 0 : a == b;
}

int study_table_find(const struct study_table *t, const struct study_item *wanted) {
    for (int i = 0; i < t->n_item; i++) {
        const struct study_item *item = &t->item[i];
        if (item->n == wanted->n && strcmp(item->name, wanted->name) == 0 &&
            strcmp(item->parent, wanted->parent) == 0 && same_text(item->owner, wanted->owner) &&
            same_text(item->leaf, wanted->leaf)) {
            return i;
        }
    }
    return -1;
}
