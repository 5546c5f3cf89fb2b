// SPDX-License-Identifier: GPL-3.0-or-later
// A column of bending stiffness EI, clamped in the floors below and above it, with a node at the
// distance a from the floor below and b from the floor above, h = a + b. The node has the
// displacement w; its rotation has no inertia and is condensed. Without a force on the node, w is
//     w0 = (1 - N) u_below + N u_above,    N = 3 x^2 - 2 x^3,    x = a / h,
// and the force that moves it from there is
//     f = k (w - w0),    k = 3 EI h^3 / (a^3 b^3).
// Both follow from the two beam elements of the column (cubic shape functions) by elimination of
// the rotation. With a law, f follows from w - w0 by it, with the initial stiffness k, and the
// floors keep their shares of f.
#include "model/struck_column.h"

#include <assert.h>
#include <math.h>
#include <string.h>

#include "core/arena.h"
#include "law/bilateral.h"
#include "law/link_law.h"
#include "model/pairs.h"
#include "model/storey_choice.h"

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

static bool set_elastic(struct builder *b, struct struck_draft *d) {
    double *value = arena_alloc(b->arena, BILATERAL_ROWS, sizeof *value);
    double *constant = arena_alloc(b->arena, (size_t)bilateral_law.n_constant, sizeof *constant);
    if (!value || !constant) {
        return false;
    }
    for (int r = 0; r < BILATERAL_ROWS; r++) {
        value[r] = bilateral_rows[r].fallback;
    }
    value[BILATERAL_STIFFNESS] = d->column.stiffness;
    value[BILATERAL_DASHPOT] = d->column.dashpot;
    bilateral_law.prepare(value, 0.0, constant, NULL);
    d->law = &bilateral_law;
    d->value = value;
    d->constant = constant;
    return true;
}

// All columns together have n times the force of one at its deformation. False after a report.
static bool set_law(struct builder *b, struct struck_draft *d, const struct storey_choice *c) {
    const struct storey_law *law = c->law;
    struct link_law from = link_law_at(0);
    for (int i = 1; i < n_link_law && from.storey != law; i++) {
        from = link_law_at(i);
        from.storey = strcmp(from.name, law->name) == 0 ? law : NULL;
    }
    assert(from.storey == law);
    const size_t n_row = LINK_ROWS + (size_t)law->n_row;
    struct contact_law *made = arena_alloc(b->arena, 1, sizeof *made);
    struct row *row = arena_alloc(b->arena, n_row, sizeof *row);
    double *value = arena_alloc(b->arena, n_row, sizeof *value);
    if (!made || !row || !value) {
        return false;
    }
    *made = link_law_make(&from);
    double *constant = arena_alloc(b->arena, (size_t)made->n_constant, sizeof *constant);
    if (!constant) {
        return false;
    }
    memcpy(row, link_law_rows, sizeof link_law_rows);
    for (int r = 0; r < LINK_ROWS; r++) {
        value[r] = r == LINK_ROW_STIFFNESS ? d->column.stiffness : (double)NAN;
    }
    for (int r = 0; r < law->n_row; r++) {
        row[LINK_ROWS + r] = law->row[r];
        value[LINK_ROWS + r] = c->value[r] * pow(d->column.n, law->row[r].dimension.force);
    }
    made->row = row;
    made->n_row = (int)n_row;
    struct error e;
    if (link_law_prepare(&from, value, constant, &e) != STATUS_OK) {
        deck_error(b->deck, &d->word, "%s", e.message);
        return false;
    }
    d->column.yields = true;
    d->law = made;
    d->value = value;
    d->constant = constant;
    return true;
}

void struck_column_add(struct builder *b, const struct struck_column *column, double damping,
                       const struct storey_choice *choice, const struct word *w) {
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
        struct struck_draft draft = {.column = c, .word = *w};
        struct struck_draft *d = NULL;
        if (choice ? set_law(b, &draft, choice) : set_elastic(b, &draft)) {
            d = builder_append(b, &b->columns, sizeof *d);
        }
        if (d) {
            *d = draft;
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
    struct link_draft *d = builder_append(b, &b->links, sizeof *d);
    if (!d) {
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
    // With a law f is the opposite of the force of the spring, which is positive in compression.
    const double k = c->yields ? 0.0 : c->stiffness / c->n;
    const double spring = c->yields ? -1.0 / c->n : 0.0;
    const double force[] = {k, -k * c->weight, -k * (1.0 - c->weight)};
    static const double of_drift[] = {0.0, 1.0, -1.0};
    c->dof[0] = point;
    c->dof[1] = first + c->floor - 1;
    c->dof[2] = c->floor > 1 ? first + c->floor - 2 : WALL;
    for (int q = 0; q < COLUMN_FORCE_COUNT; q++) {
        c->by_spring[q] = by_force[q] * spring;
    }
    c->by_spring[COLUMN_MOMENT_POINT] =
        c->by_spring[COLUMN_SHEAR_BELOW] * a - c->by_spring[COLUMN_MOMENT_BELOW];
    for (int i = 0; i < 3; i++) {
        for (int q = 0; q < COLUMN_FORCE_COUNT; q++) {
            c->force[q][i] = by_force[q] * force[i] + by_drift[q] * of_drift[i];
        }
        c->force[COLUMN_MOMENT_POINT][i] =
            c->force[COLUMN_SHEAR_BELOW][i] * a - c->force[COLUMN_MOMENT_BELOW][i];
    }
}
