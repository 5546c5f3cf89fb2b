// SPDX-License-Identifier: GPL-3.0-or-later
// The walk over the places of the tree, and the values there.
#include "result/layout.h"

#include "core/arena.h"

const char layout_isolated_name[] = "isolated";

static void visit_links(const struct link_group *g, const struct report_link *link, int n,
                        layout_visit *visit, void *context) {
    struct layout_place p = {
        .parent = g->name, .scale = g->scale, .table = &layout_link, .base = link, .n = (size_t)n};
    visit(context, &p);
    if (layout_has_levels(link, n)) {
        p.table = &layout_level;
        visit(context, &p);
    }
    p.table = g->peaks;
    p.leaf = "envelope";
    visit(context, &p);
}

static void visit_forces(const struct report_building *b, layout_visit *visit, void *context) {
    if (b->n_member > 0) {
        visit(context, &(struct layout_place){b->path, "members", "envelope", "member",
                                              &layout_member_peak[b->hinged], b->member,
                                              (size_t)b->n_member});
    }
    for (int i = 0; i < b->n_share; i++) {
        visit(context,
              &(struct layout_place){b->parts, b->share[i].name, "envelope", "floor",
                                     &layout_share_peak, &b->share[i], (size_t)b->n_floor});
    }
}

static void visit_foundation(const struct report_building *b, layout_visit *visit, void *context) {
    if (b->foundation) {
        visit(context, &(struct layout_place){b->path, "foundation", "envelope", "slab",
                                              &layout_foundation, b->foundation, 1});
    }
}

void layout_each(const struct report *r, layout_visit *visit, void *context) {
    for (int i = 0; i < r->n_building; i++) {
        const struct report_building *b = &r->building[i];
        struct layout_place p = {.parent = "buildings",
                                 .owner = b->name,
                                 .scale = "floor",
                                 .table = &layout_building,
                                 .base = b,
                                 .n = (size_t)b->n_floor};
        visit(context, &p);
        p.table = &layout_peak;
        p.leaf = "envelope";
        visit(context, &p);
        visit_forces(b, visit, context);
        visit_foundation(b, visit, context);
    }
    visit_links(&layout_contacts, r->contact, r->n_contact, visit, context);
    if (r->n_link > 0) {
        visit_links(&layout_links, r->link, r->n_link, visit, context);
    }
    if (r->n_column > 0) {
        visit_links(&layout_columns, r->column, r->n_column, visit, context);
    }
    visit(context, &(struct layout_place){"energy", NULL, NULL, NULL, &layout_energy, r, 1});
    visit(context, &(struct layout_place){"totals", NULL, NULL, NULL, &layout_totals, r, 1});
    visit(context, &(struct layout_place){"totals", NULL, NULL, NULL, &layout_collapse, r, 1});
}

void layout_paths(struct report_building *b, struct arena *a) {
    b->path = arena_format(a, "buildings/%s", b->name);
    b->parts = arena_format(a, "buildings/%s/parts", b->name);
}

const void *layout_at(const struct column_table *t, int c, const void *base, size_t i) {
    const struct column *column = &t->column[c];
    const char *member = (const char *)base + column->offset;
    if (column->kind == COLUMN_ARRAY) {
        const double *array = *(const double *const *)member;
        return array ? array + i : NULL;
    }
    return member + i * t->size;
}

long layout_whole(const struct column *c, const void *at) {
    switch (c->kind) {
        case COLUMN_LONG:
            return *(const long *)at + c->base;
        case COLUMN_INT:
            return *(const int *)at + (long)c->base;
        case COLUMN_FLAG:
            return *(const bool *)at ? 1 : 0;
        default:
            return 0;
    }
}

double layout_number(const struct column *c, const void *at) {
    return c->kind == COLUMN_DOUBLE || c->kind == COLUMN_ARRAY ? *(const double *)at
                                                               : (double)layout_whole(c, at);
}
