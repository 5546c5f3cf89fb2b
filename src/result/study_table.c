// SPDX-License-Identifier: GPL-3.0-or-later
// The values of a run in one row: properties and envelopes of buildings, contacts and links,
// energies at the end, totals. One walk over a report counts them, describes them or reads them.
#include "jostle/study_file.h"

#include <string.h>

#include "core/arena.h"
#include "core/text.h"
#include "result/layout.h"

// `item` NULL: nothing is described; `value` NULL: nothing is read.
struct walk {
    struct arena *arena;
    const struct unit_system *units;
    struct study_item *item;
    double *value;
    int n_item;
    size_t n_value;
};

// Column `c` at a place as the next item; no array there is one of zeros.
static void add(struct walk *w, const struct layout_place *p, int c, bool property) {
    const struct column *column = &p->table->column[c];
    if (w->item) {
        char units[64] = "1";
        if (column->dimension) {
            unit_text(w->units, *column->dimension, units, sizeof units);
        }
        // Of a history the value at its end.
        const bool at_end = p->table == &layout_energy && c < ENERGY_COUNT;
        w->item[w->n_item] = (struct study_item){
            .parent = p->parent,
            .owner = p->owner,
            .leaf = p->leaf,
            .name = column->name,
            .long_name = at_end ? arena_format(w->arena, "%s, at the end", column->long_name)
                                : column->long_name,
            .dimension = column->dimension,
            .units = arena_text(w->arena, units, strlen(units)),
            .scale = p->scale,
            .property = property,
            .first = w->n_value,
            .n = p->n};
    }
    for (size_t i = 0; w->value && i < p->n; i++) {
        const void *at = layout_at(p->table, c, p->base, i);
        w->value[w->n_value + i] = at ? layout_number(column, at) : 0.0;
    }
    w->n_item++;
    w->n_value += p->n;
}

// Which floors a link connects is the same for all runs, and texts are no values. The wall time is
// no result: it differs from run to run.
static void add_place(void *context, const struct layout_place *p) {
    const bool totals = p->table == &layout_totals, energy = p->table == &layout_energy;
    for (int c = 0; totals && c < layout_root.n_column; c++) {
        struct layout_place root = *p;
        root.table = &layout_root;
        if (layout_root.column[c].long_name) {  // duration and step
            add(context, &root, c, true);
        }
    }
    for (int c = 0; c < p->table->n_column; c++) {
        const struct column *column = &p->table->column[c];
        if (totals ? column->kind == COLUMN_LONG : layout_is_value(column)) {
            add(context, p, c, !p->leaf && !totals && !energy && p->table != &layout_collapse);
        }
    }
}

int study_table_create(const struct report *r, struct study_table **out, struct error *e) {
    struct walk count = {0};
    layout_each(r, add_place, &count);
    struct arena *a = arena_create();
    struct study_table *t = a ? arena_alloc(a, 1, sizeof *t) : NULL;
    struct walk w = {.arena = a, .units = &r->units};
    w.item = t ? arena_alloc(a, (size_t)count.n_item, sizeof *w.item) : NULL;
    if (w.item) {
        layout_each(r, add_place, &w);
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
    layout_each(r, add_place, &(struct walk){.value = value});
}

bool study_view_counts(const struct study_view *v, const struct study_item *item, size_t i) {
    const bool of_floors = item->owner && item->leaf && strcmp(item->parent, "buildings") == 0 &&
                           strcmp(item->name, peak_names[PEAK_SHEAR]) != 0;
    for (int k = 0; of_floors && k < v->n_building; k++) {
        const struct report_building *b = &v->building[k];
        if (strcmp(item->owner, b->name) == 0) {
            return floor_is_summarised(b->isolated, b->n_floor, (int)i);
        }
    }
    return true;
}

const struct report_building *
study_view_building(const struct study_view *v, const struct study_item *item, const char *owner) {
    for (int i = 0; item->owner && strcmp(item->owner, owner) == 0 && i < v->n_building; i++) {
        if (strcmp(item->parent, v->building[i].path) == 0) {
            return &v->building[i];
        }
    }
    return NULL;
}

int study_table_find(const struct study_table *t, const struct study_item *wanted) {
    for (int i = 0; i < t->n_item; i++) {
        const struct study_item *item = &t->item[i];
        if (item->n == wanted->n && strcmp(item->name, wanted->name) == 0 &&
            strcmp(item->parent, wanted->parent) == 0 && text_same(item->owner, wanted->owner) &&
            text_same(item->leaf, wanted->leaf)) {
            return i;
        }
    }
    return -1;
}

long study_table_collapsed(const struct study_table *t) {
    for (int i = 0; i < t->n_item; i++) {
        if (strcmp(t->item[i].parent, "totals") == 0 && strcmp(t->item[i].name, "collapsed") == 0) {
            return (long)t->item[i].first;
        }
    }
    return -1;
}
