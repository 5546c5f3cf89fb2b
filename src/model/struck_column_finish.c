// SPDX-License-Identifier: GPL-3.0-or-later
// From the drafts of struck columns to their bodies, springs and forces in the model.
#include <math.h>

#include "core/arena.h"
#include "model/frame.h"
#include "model/pairs.h"
#include "model/struck_column.h"

static int count_dofs(const struct building_draft *d) {
    return d->n_floor + (d->foundation ? 2 : 0);
}

// From drifts of storeys (n_floor) to the degrees of freedom of the building, which may stand on a
// foundation (model/foundation.c): its slab is below the first storey, and rocking is no drift.
static double *on_dofs(struct builder *b, const struct building_draft *d, const double *by_drift) {
    const int n = d->n_floor;
    double *out = arena_alloc(b->arena, (size_t)n + 2, sizeof *out);
    for (int i = 0; out && i < n; i++) {
        out[i] += by_drift[i];
        out[i > 0 ? i - 1 : n] -= by_drift[i];
        out[n + 1] -= by_drift[i] * (d->height[i] / level_of_floor(d->height, n));
    }
    return out;
}

// The displacement of the point without a force on it, by the degrees of freedom of its building.
static const double *rest_on_dofs(struct builder *b, const struct building_draft *d,
                                  const struct struck_draft *column) {
    const struct struck_column *c = &column->column;
    double *out = on_dofs(b, d, column->rest);
    if (out) {
        out[c->floor > 1 ? c->floor - 2 : d->n_floor] += 1.0;
        out[d->n_floor + 1] += c->below / level_of_floor(d->height, d->n_floor);
    }
    return out;
}

// The struck point as a body: a free body of one floor, which starts without force.
static void add_body(struct builder *b, const struct struck_draft *column) {
    const struct struck_column *c = &column->column;
    const struct building_draft host = *builder_draft(b, c->building);
    enum { MASS, STIFFNESS, DISPLACEMENT, VELOCITY, N_ARRAY };
    double *x = arena_alloc(b->arena, N_ARRAY, sizeof *x);
    struct storey *storey = arena_alloc(b->arena, 1, sizeof *storey);
    struct word *word = arena_alloc(b->arena, 2, sizeof *word);
    struct building_draft *d = builder_append(b, &b->buildings, sizeof *d);
    if (!x || !storey || !word || !c->rest || !d) {
        return;
    }
    for (int i = host.n_floor - 1; i >= 0; i--) {
        x[DISPLACEMENT] += c->rest[i] * host.displacement[i];
        x[VELOCITY] += c->rest[i] * host.velocity[i];
    }
    x[MASS] = c->mass;
    *d = (struct building_draft){
        .name = c->name,
        .word = column->word,
        .n_floor = 1,
        .mass = x + MASS,
        .stiffness = x + STIFFNESS,
        .displacement = x + DISPLACEMENT,
        .velocity = x + VELOCITY,
        .storey = storey,
        .storey_word = word,
        .initial = word + 1,
    };
}

// The spring between the floors of the building, on the left, and the struck point.
static void add_spring(struct builder *b, int i, int body) {
    const struct struck_draft *column = struck_column_draft(b, i);
    const struct struck_column *c = &column->column;
    const struct building_draft *host = builder_draft(b, c->building);
    struct link_draft *d = builder_append(b, &b->links, sizeof *d);
    const int n = count_dofs(host);
    struct link_entry *entry = arena_alloc(b->arena, (size_t)n, sizeof *entry);
    if (!d || !entry) {
        return;
    }
    *d = (struct link_draft){
        .link =
            {
                .name = c->name,
                .building = {c->building, body},
                .floor = {c->floor, 1},
                .level = {c->level, NAN},
                .weight = {c->weight, NAN},
                .row = {{.entry = entry}},
                .column = {-1, i},
                .bilateral = true,
                .law = column->law,
                .value = column->value,
                .constant = column->constant,
                .restitution = NAN,
            },
        .word = column->word,
        .named = true,
    };
    for (int k = n - 1; k >= 0; k--) {
        if (c->rest[k] != 0.0) {
            entry[d->link.row[0].n++] = (struct link_entry){k, c->rest[k]};
        }
    }
    d->link.mass = level_effective_mass(b, &d->link);
}

// The frame of the building, which has points.
static const struct plane_frame *frame_struck(const struct building_draft *d) {
    const struct plane_frame *f = NULL;
    for (int i = 0; i < d->parts.n && !f; i++) {
        f = frame_of((const struct part *)d->parts.item + i);
        f = f && f->n_point > 0 ? f : NULL;
    }
    return f;
}

// A contact strikes the line of the frame that is on its side of the building.
static void check_sides(struct builder *b) {
    const struct link_draft *d = b->links.item;
    for (int i = 0; i < b->links.n; i++) {
        for (int side = 0; side < 2; side++) {
            const int at = d[i].link.column[side];
            const struct struck_column *c = at >= 0 ? &struck_column_draft(b, at)->column : NULL;
            if (c && c->line > 0 && !d[i].link.bilateral && (c->line == 1) != (side == 1)) {
                deck_error(b->deck, &d[i].word,
                           "contact %s strikes building %s on its %s, but column %s is on line %d",
                           d[i].link.name, builder_draft(b, c->building)->name,
                           side == 1 ? "left" : "right", c->name, c->line);
            }
        }
    }
}

// Warns about columns that no contact strikes.
static void check_struck(struct builder *b) {
    const struct struck_storeys *s = b->column_storeys.item;
    for (int i = 0; i < b->column_storeys.n; i++) {
        if (!s[i].struck) {
            deck_warning(b->deck, &s[i].draft.word,
                         "no contact below this statement strikes columns %s between two floors",
                         s[i].draft.column.name);
        }
    }
}

// Warns about the first frame of which more than one column is struck.
static void check_frames(struct builder *b) {
    for (int i = 0; i < b->columns.n; i++) {
        const struct struck_draft *d = struck_column_draft(b, i);
        if (d->column.line > 0 && struck_column_points(b, d->column.building) > 1) {
            deck_warning(b->deck, &d->word,
                         "more than one column of the frame of building %s is struck: the bending "
                         "of one by the force on another is left out",
                         builder_draft(b, d->column.building)->name);
            return;
        }
    }
}

void struck_column_finish(struct builder *b) {
    const int n_building = b->buildings.n;
    check_sides(b);
    check_struck(b);
    check_frames(b);
    for (int i = 0; i < b->columns.n; i++) {
        struct struck_draft *d = struck_column_draft(b, i);
        const struct building_draft *host = builder_draft(b, d->column.building);
        if (d->column.line > 0 && !struck_column_settle(b, d, frame_struck(host))) {
            return;
        }
        d->column.rest = rest_on_dofs(b, host, d);
        add_body(b, d);
    }
    for (int i = 0; i < b->columns.n && !arena_failed(b->arena); i++) {
        add_spring(b, i, n_building + i);
    }
}

// One column takes the force f = k (w - rest) on the struck point, besides that of the drifts. The
// moment at the point follows from the shear below it. With a law f is the opposite of the force of
// the spring, which is positive in compression.
struct struck_column struck_column_place(struct builder *b, int i, int point, int first) {
    const struct struck_draft *draft = struck_column_draft(b, i);
    const struct building_draft *host = builder_draft(b, draft->column.building);
    struct struck_column c = draft->column;
    const double *below = on_dofs(b, host, draft->below);
    const double *above = on_dofs(b, host, draft->above);
    const int n = count_dofs(host);
    int *dof = arena_alloc(b->arena, (size_t)n + 1, sizeof *dof);
    double *force = arena_alloc(b->arena, COLUMN_FORCE_COUNT * ((size_t)n + 1), sizeof *force);
    if (!below || !above || !dof || !force) {
        return c;
    }
    dof[c.n_dof++] = point;
    for (int k = n - 1; k >= 0; k--) {
        if (c.rest[k] != 0.0 || below[k] != 0.0 || above[k] != 0.0) {
            dof[c.n_dof++] = first + k;
        }
    }
    const double stiffness = c.yields ? 0.0 : c.stiffness / c.n;
    for (int j = 0; j < c.n_dof; j++) {
        const int k = dof[j] - first;
        const double own = j == 0 ? stiffness : -stiffness * c.rest[k];
        const double low = j == 0 ? 0.0 : below[k], high = j == 0 ? 0.0 : above[k];
        const double shear = (low + high) / c.height;
        const double by_dof[] = {shear, shear, low, 0.0, high};
        for (int q = 0; q < COLUMN_FORCE_COUNT; q++) {
            force[q * c.n_dof + j] = draft->by_force[q] * own + by_dof[q];
        }
        force[COLUMN_MOMENT_POINT * c.n_dof + j] =
            force[COLUMN_SHEAR_BELOW * c.n_dof + j] * c.below -
            force[COLUMN_MOMENT_BELOW * c.n_dof + j];
    }
    const double spring = c.yields ? -1.0 / c.n : 0.0;
    for (int q = 0; q < COLUMN_FORCE_COUNT; q++) {
        c.by_spring[q] = draft->by_force[q] * spring;
    }
    c.by_spring[COLUMN_MOMENT_POINT] =
        c.by_spring[COLUMN_SHEAR_BELOW] * c.below - c.by_spring[COLUMN_MOMENT_BELOW];
    c.dof = dof;
    c.force = force;
    return c;
}
