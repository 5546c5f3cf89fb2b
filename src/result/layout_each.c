// SPDX-License-Identifier: GPL-3.0-or-later
// The walk over the places of the tree, and the values there.
#include "result/layout.h"

#include "core/arena.h"

const char layout_isolated_name[] = "isolated";

static void visit_building(const struct report *r, int k, layout_visit_group *visit,
                           void *context) {
    const struct report_building *b = &r->building[k];
    const size_t n = (size_t)b->n_floor;
    visit(context, &(struct layout_group){.kind = LAYOUT_BUILDING,
                                          .parent = "buildings",
                                          .name = b->name,
                                          .scale = "floor",
                                          .n = n,
                                          .base = b,
                                          .own = {&layout_building},
                                          .envelope = &layout_peak,
                                          .building = k});
    if (b->n_member > 0) {
        visit(context, &(struct layout_group){.kind = LAYOUT_MEMBERS,
                                              .parent = b->path,
                                              .name = "members",
                                              .scale = "member",
                                              .n = (size_t)b->n_member,
                                              .base = b->member,
                                              .own = {&layout_member},
                                              .envelope = &layout_member_peak[b->hinged],
                                              .building = k});
    }
    if (b->n_share > 0) {
        visit(context, &(struct layout_group){.kind = LAYOUT_PARTS,
                                              .parent = b->path,
                                              .name = "parts",
                                              .scale = "part",
                                              .n = (size_t)b->n_share,
                                              .base = b->share,
                                              .own = {&layout_share},
                                              .building = k});
    }
    for (int i = 0; i < b->n_share; i++) {
        visit(context, &(struct layout_group){.kind = LAYOUT_PART,
                                              .parent = b->parts,
                                              .name = b->share[i].name,
                                              .scale = "floor",
                                              .n = n,
                                              .base = &b->share[i],
                                              .envelope = &layout_share_peak,
                                              .building = k,
                                              .number = i});
    }
    if (b->foundation) {
        visit(context, &(struct layout_group){.kind = LAYOUT_FOUNDATION,
                                              .parent = b->path,
                                              .name = "foundation",
                                              .scale = "slab",
                                              .n = 1,
                                              .base = b->foundation,
                                              .envelope = &layout_foundation,
                                              .building = k});
    }
}

static void visit_links(const struct link_group *l, const struct report_link *link, int first,
                        int n, layout_visit_group *visit, void *context) {
    if (n > 0 || l == &layout_contacts) {
        visit(context, &(struct layout_group){
                           .kind = LAYOUT_LINKS,
                           .name = l->name,
                           .scale = l->scale,
                           .n = (size_t)n,
                           .base = link,
                           .own = {&layout_link, layout_has_levels(link, n) ? &layout_level : NULL},
                           .envelope = l->peaks,
                           .number = first,
                           .links = l});
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
    visit(context,
          &(struct layout_group){
              .kind = LAYOUT_ENERGY, .name = "energy", .n = 1, .base = r, .own = {&layout_energy}});
    visit(context, &(struct layout_group){.kind = LAYOUT_TOTALS,
                                          .name = "totals",
                                          .n = 1,
                                          .base = r,
                                          .own = {&layout_totals, &layout_collapse}});
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
