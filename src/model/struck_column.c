// SPDX-License-Identifier: GPL-3.0-or-later
// A column of bending stiffness EI, clamped in the floors below and above it, with a node at the
// distance a from the floor below and b from the floor above, h = a + b. The node has the
// displacement w; its rotation has no inertia and is condensed. Without a force on the node, w is
//     w0 = (1 - N) u_below + N u_above,    N = 3 x^2 - 2 x^3,    x = a / h,
// and the force that moves it from there is
//     f = k (w - w0),    k = 3 EI h^3 / (a^3 b^3).
// Both follow from the two beam elements of the column (cubic shape functions) by elimination of
// the rotation.
#include "model/struck_column.h"

#include <assert.h>
#include <math.h>

#include "core/arena.h"
#include "law/bilateral.h"
#include "model/pairs.h"

// Two levels that differ by less than this share of the storey height are one.
static const double SAME_LEVEL = 1e-9;

struct struck_draft *struck_column_draft(const struct builder *b, int i) {
    assert(i >= 0 && i < b->columns.n);
    return (struct struck_draft *)b->columns.item + i;
}

int struck_column_at(const struct builder *b, int building, double level) {
    for (int i = 0; i < b->columns.n && !isnan(level); i++) {
        const struct struck_column *c = &struck_column_draft(b, i)->column;
        if (c->building == building && fabs(c->level - level) <= SAME_LEVEL * c->height) {
            return i;
        }
    }
    return -1;
}

// The first link with an end at the level of the column; NULL: none.
static const struct link *link_at_level(const struct builder *b, const struct struck_column *c) {
    const struct link_draft *d = b->links.item;
    for (int i = 0; i < b->links.n; i++) {
        for (int side = 0; side < 2; side++) {
            const struct link *l = &d[i].link;
            const int building = l->within ? l->building[0] : l->building[side];
            if (building == c->building &&
                fabs(l->level[side] - c->level) <= SAME_LEVEL * c->height) {
                return l;
            }
        }
    }
    return NULL;
}

void struck_column_add(struct builder *b, const struct struck_column *column, double damping,
                       const struct word *w) {
    struct struck_column c = *column;
    const double *height = builder_draft(b, c.building)->height;
    c.height = height[c.floor - 1];
    c.below = c.level - level_of_floor(height, c.floor - 1);
    const double x = c.below / c.height, above = c.height - c.below;
    c.weight = x * x * (3.0 - 2.0 * x);
    c.stiffness = 3.0 * c.bending * pow(c.height / (c.below * above), 3.0);
    c.dashpot = 2.0 * damping * sqrt(c.stiffness * c.mass);
    const int same = struck_column_at(b, c.building, c.level);
    const struct link *link = link_at_level(b, &c);
    if (same >= 0) {
        deck_error(b->deck, w, "column %s is at this level already; -n is their number",
                   struck_column_draft(b, same)->column.name);
    } else if (link) {
        deck_error(b->deck, w, "%s %s has named this level before; write the column first",
                   link->bilateral ? "link" : "contact", link->name);
    } else if (!isfinite(c.stiffness) || !isfinite(c.dashpot)) {
        deck_error(b->deck, w, "the stiffness of the column at this level is too large");
    } else {
        struct struck_draft *d = builder_append(b, &b->columns, sizeof *d);
        if (d) {
            *d = (struct struck_draft){.column = c, .word = *w};
        }
    }
}

// The struck point as a body: a free body of one floor, which starts at w0.
static void add_body(struct builder *b, const struct struck_draft *column) {
    const struct struck_column *c = &column->column;
    const struct building_draft host = *builder_draft(b, c->building);
    enum { MASS, STIFFNESS, DISPLACEMENT, VELOCITY, N_ARRAY };
    double *x = arena_alloc(b->arena, N_ARRAY, sizeof *x);
    struct storey *storey = arena_alloc(b->arena, 1, sizeof *storey);
    struct word *word = arena_alloc(b->arena, 2, sizeof *word);
    struct building_draft *d = builder_append(b, &b->buildings, sizeof *d);
    if (!x || !storey || !word || !d) {
        return;
    }
    const int i = c->floor - 1;
    const double *of[] = {host.displacement, host.velocity};
    for (int k = 0; k < 2; k++) {
        x[DISPLACEMENT + k] =
            c->weight * of[k][i] + (i > 0 ? (1.0 - c->weight) * of[k][i - 1] : 0.0);
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
    double *constant = arena_alloc(b->arena, BILATERAL_ROWS, sizeof *constant);
    struct link_draft *d = builder_append(b, &b->links, sizeof *d);
    if (!constant || !d) {
        return;
    }
    constant[BILATERAL_STIFFNESS] = c->stiffness;
    constant[BILATERAL_DASHPOT] = c->dashpot;
    constant[BILATERAL_EXPONENT] = 1.0;
    *d = (struct link_draft){
        .link =
            {
                .name = c->name,
                .building = {c->building, body},
                .floor = {c->floor, 1},
                .level = {c->level, NAN},
                .weight = {c->weight, NAN},
                .column = {-1, i},
                .bilateral = true,
                .law = &bilateral_law,
                .value = constant,
                .constant = constant,
                .restitution = NAN,
            },
        .word = column->word,
        .named = true,
    };
    level_rows(b, &d->link, &d->word);
    d->link.mass = level_effective_mass(b, &d->link);
}

void struck_column_finish(struct builder *b) {
    const int n_building = b->buildings.n;
    for (int i = 0; i < b->columns.n; i++) {
        add_body(b, struck_column_draft(b, i));
    }
    for (int i = 0; i < b->columns.n && !arena_failed(b->arena); i++) {
        add_spring(b, i, n_building + i);
    }
}

// One column has the bending stiffness EI and takes the force f of the struck point. With the drift
// d of the storey, and without f, its shear is 12 EI d / h^3 and the moment at both ends
// 6 EI d / h^2. The force f adds the end forces of a clamped beam with a load: shears (1 - N) f and
// -N f, moments f a b^2 / h^2 and -f a^2 b / h^2. The moment at the point follows from the shear
// below it.
void struck_column_place(struct struck_column *c, int point, int first) {
    const double h = c->height, a = c->below, b = h - a;
    const double drift = c->bending / c->n / (h * h);
    const double by_force[] = {1.0 - c->weight, -c->weight, a * b * b / (h * h), 0.0,
                               -a * a * b / (h * h)};
    const double by_drift[] = {12.0 * drift / h, 12.0 * drift / h, 6.0 * drift, 0.0, 6.0 * drift};
    const double k = c->stiffness / c->n;
    const double force[] = {k, -k * c->weight, -k * (1.0 - c->weight)};
    static const double of_drift[] = {0.0, 1.0, -1.0};
    c->dof[0] = point;
    c->dof[1] = first + c->floor - 1;
    c->dof[2] = c->floor > 1 ? first + c->floor - 2 : WALL;
    for (int i = 0; i < 3; i++) {
        for (int q = 0; q < COLUMN_FORCE_COUNT; q++) {
            c->force[q][i] = by_force[q] * force[i] + by_drift[q] * of_drift[i];
        }
        c->force[COLUMN_MOMENT_POINT][i] =
            c->force[COLUMN_SHEAR_BELOW][i] * a - c->force[COLUMN_MOMENT_BELOW][i];
    }
}
