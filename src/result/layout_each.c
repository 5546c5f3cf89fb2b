// SPDX-License-Identifier: GPL-3.0-or-later
// The walk over the places of the tree, and the values there.
#include "result/layout.h"

#include "core/arena.h"

const char layout_isolated_name[] = "isolated";

static void visit_building(const struct report *r, int k, layout_visit_group *visit,
                           void *context) {
    const struct report_building *b = &r->building[k];
    const size_t n = (size_t)b->n_floor, n_member = (size_t)b->n_member,
                 n_part = (size_t)b->n_share;
    struct layout_group g = {LAYOUT_BUILDING,    "buildings",  b->name, "floor", n,   b,
                             {&layout_building}, &layout_peak, k,       0,       NULL};
    visit(context, &g);
    if (n_member > 0) {
        g = (struct layout_group){LAYOUT_MEMBERS,
                                  b->path,
                                  "members",
                                  "member",
                                  n_member,
                                  b->member,
                                  {&layout_member},
                                  &layout_member_peak[b->hinged],
                                  k,
                                  0,
                                  NULL};
        visit(context, &g);
    }
    if (n_part > 0) {
        g = (struct layout_group){LAYOUT_PARTS,    b->path, "parts", "part", n_part, b->share,
                                  {&layout_share}, NULL,    k,       0,      NULL};
        visit(context, &g);
    }
    for (int i = 0; i < b->n_share; i++) {
        const struct report_share *s = &b->share[i];
        g = (struct layout_group){LAYOUT_PART, b->parts,           s->name, "floor", n,   s,
                                  {NULL},      &layout_share_peak, k,       i,       NULL};
        visit(context, &g);
    }
    if (b->foundation) {
        g = (struct layout_group){LAYOUT_FOUNDATION,
                                  b->path,
                                  "foundation",
                                  "slab",
                                  1,
                                  b->foundation,
                                  {NULL},
                                  &layout_foundation,
                                  k,
                                  0,
                                  NULL};
        visit(context, &g);
    }
}

static void visit_links(const struct link_group *l, const struct report_link *link, int first,
                        int n, layout_visit_group *visit, void *context) {
    const struct column_table *level = layout_has_levels(link, n) ? &layout_level : NULL;
    if (n > 0 || l == &layout_contacts) {
        visit(context, &(struct layout_group){LAYOUT_LINKS,
                                              NULL,
                                              l->name,
                                              l->scale,
                                              (size_t)n,
                                              link,
                                              {&layout_link, level},
                                              l->peaks,
                                              0,
                                              first,
                                              l});
    }
}

void layout_groups(const struct report *r, layout_visit_group *visit, void *context) {
    for (int i = 0; i < r->n_building; i++) {
        visit_building(r, i, visit, context);
    }
    const int n = r->n_contact, m = r->n_link;
    visit_links(&layout_contacts, r->contact, 0, n, visit, context);
    visit_links(&layout_links, r->link, n, m, visit, context);
    visit_links(&layout_columns, r->column, n + m, r->n_column, visit, context);
    struct layout_group g = {LAYOUT_ENERGY,    NULL, "energy", NULL, 1,   r,
                             {&layout_energy}, NULL, 0,        0,    NULL};
    visit(context, &g);
    g = (struct layout_group){
        LAYOUT_TOTALS, NULL, "totals", NULL, 1, r, {&layout_totals, &layout_collapse},
        NULL,          0,    0,        NULL};
    visit(context, &g);
}

struct each {
    layout_visit *visit;
    void *context;
};

static void visit_places(void *context, const struct layout_group *g) {
    const struct each *e = context;
    struct layout_place p = {.parent = g->parent ? g->parent : g->name,
                             .owner = g->parent ? g->name : NULL,
                             .scale = g->scale,
                             .base = g->base,
                             .n = g->n};
    for (int i = 0; i < 2 && g->own[i]; i++) {
        p.table = g->own[i];
        e->visit(e->context, &p);
    }
    if (g->envelope) {
        p.table = g->envelope;
        p.leaf = "envelope";
        e->visit(e->context, &p);
    }
}

void layout_each(const struct report *r, layout_visit *visit, void *context) {
    layout_groups(r, visit_places, &(struct each){visit, context});
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
