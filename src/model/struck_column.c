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

#include "core/arena.h"
#include "law/bilateral.h"
#include "law/link_law.h"
#include "model/frame.h"
#include "model/pairs.h"
#include "model/storey_choice.h"

// Two levels that differ by less than this share of the storey height are one.
static const double SAME_LEVEL = 1e-9;

struct struck_draft *struck_column_draft(const struct builder *b, int i) {
    assert(i >= 0 && i < b->columns.n);
    return (struct struck_draft *)b->columns.item + i;
}

// Is the column of this building at this level? Not at NAN.
static bool is_at(const struct struck_column *c, int building, double level) {
    return c->building == building && fabs(c->level - level) <= SAME_LEVEL * c->height;
}

int struck_column_at(const struct builder *b, int building, double level) {
    for (int i = 0; i < b->columns.n; i++) {
        if (is_at(&struck_column_draft(b, i)->column, building, level)) {
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
            if (is_at(c, l->within ? l->building[0] : l->building[side], l->level[side])) {
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
    const struct link_law from = link_law_of_storey(law);
    const struct contact_law *made = pairs_storey_law(b, &from);
    double *value = made ? arena_alloc(b->arena, (size_t)made->n_row, sizeof *value) : NULL;
    if (!value) {
        return false;
    }
    for (int r = 0; r < LINK_ROWS; r++) {
        value[r] = r == LINK_ROW_STIFFNESS ? d->column.stiffness : (double)NAN;
    }
    for (int r = 0; r < law->n_row; r++) {
        value[LINK_ROWS + r] = c->value[r] * pow(d->column.n, law->row[r].dimension.force);
    }
    d->column.yields = true;
    d->law = made;
    d->value = value;
    d->constant = pairs_storey_constants(b, &from, made, value, &d->word);
    return d->constant != NULL;
}

// The moment at both ends by a unit drift is 6 EI / h^2. A force on the point adds the end forces
// of a clamped beam with a load: shears 1 - N and -N, moments a b^2 / h^2 and -a^2 b / h^2.
static bool set_clamped(struct builder *b, struct struck_draft *d) {
    struct struck_column *c = &d->column;
    const size_t n_floor = (size_t)builder_draft(b, c->building)->n_floor;
    double *rest = arena_alloc(b->arena, n_floor, sizeof *rest);
    double *moment = arena_alloc(b->arena, n_floor, sizeof *moment);
    const double h = c->height, low = c->below, high = h - low;
    if (!rest || !moment) {
        return false;
    }
    rest[c->floor - 1] = c->weight;
    moment[c->floor - 1] = 6.0 * (c->bending / c->n / (h * h));
    d->rest = rest;
    d->below = d->above = moment;
    d->by_force[COLUMN_SHEAR_BELOW] = 1.0 - c->weight;
    d->by_force[COLUMN_SHEAR_ABOVE] = -c->weight;
    d->by_force[COLUMN_MOMENT_BELOW] = low * high * high / (h * h);
    d->by_force[COLUMN_MOMENT_ABOVE] = -low * low * high / (h * h);
    c->stiffness = 3.0 * c->bending * pow(h / (low * high), 3.0);
    return true;
}

// The same of a column of the frame, whose joints turn.
static bool set_framed(struct builder *b, struct struck_draft *d, const struct plane_frame *f) {
    struct struck_column *c = &d->column;
    enum { REST, BELOW, ABOVE, N_ROW };
    double *row[N_ROW];
    const int member = f->point[c->point].member, n_load = frame_n_load(f);
    const double *at_i = f->force + (ptrdiff_t)(member * FRAME_FORCES + FRAME_MOMENT_I) * n_load;
    const double *at_j = f->force + (ptrdiff_t)(member * FRAME_FORCES + FRAME_MOMENT_J) * n_load;
    for (int r = 0; r < N_ROW; r++) {
        row[r] = arena_alloc(b->arena, (size_t)f->n_floor, sizeof *row[r]);
    }
    if (arena_failed(b->arena)) {
        return false;
    }
    for (int i = 0; i < f->n_floor; i++) {
        row[REST][i] = frame_point_by_drift(f, c->point, i);
        row[BELOW][i] = at_i[i] / c->n;
        row[ABOVE][i] = at_j[i] / c->n;
    }
    d->rest = row[REST];
    d->below = row[BELOW];
    d->above = row[ABOVE];
    const double moment[] = {at_i[f->n_action + c->point], at_j[f->n_action + c->point]};
    const double hinged = (c->height - c->below) / c->height;
    d->by_force[COLUMN_SHEAR_BELOW] = (moment[0] + moment[1]) / c->height + hinged;
    d->by_force[COLUMN_SHEAR_ABOVE] = d->by_force[COLUMN_SHEAR_BELOW] - 1.0;
    d->by_force[COLUMN_MOMENT_BELOW] = moment[0];
    d->by_force[COLUMN_MOMENT_ABOVE] = moment[1];
    c->bending = f->member[member].bend * f->member[member].length;
    c->stiffness = 1.0 / frame_point_by_force(f, c->point);
    return true;
}

bool struck_column_settle(struct builder *b, struct struck_draft *d, const struct plane_frame *f) {
    struct struck_column *c = &d->column;
    if (!(f ? set_framed(b, d, f) : set_clamped(b, d))) {
        return false;
    }
    c->dashpot = 2.0 * d->damping * sqrt(c->stiffness * c->mass);
    if (!isfinite(c->stiffness) || !isfinite(c->dashpot)) {
        return deck_error(b->deck, &d->word,
                          "the stiffness of the column at this level is too large");
    }
    return d->choice ? set_law(b, d, d->choice) : set_elastic(b, d);
}

void struck_column_add(struct builder *b, const struct struck_draft *given, int floor,
                       double level) {
    struct struck_draft draft = *given;
    struct struck_column *c = &draft.column;
    const double *height = builder_draft(b, c->building)->height;
    c->floor = floor;
    c->level = level;
    c->height = height[floor - 1];
    c->below = level - level_of_floor(height, floor - 1);
    const double x = c->below / c->height;
    c->weight = x * x * (3.0 - 2.0 * x);
    const int same = struck_column_at(b, c->building, level);
    const struct link *link = link_at_level(b, c);
    if (same >= 0) {
        deck_error(b->deck, &draft.word, "column %s is at this level already; -n is their number",
                   struck_column_draft(b, same)->column.name);
    } else if (link) {
        deck_error(b->deck, &draft.word,
                   "%s %s has named this level before; write the column first",
                   link->bilateral ? "link" : "contact", link->name);
    } else if (c->line > 0 || struck_column_settle(b, &draft, NULL)) {
        struct struck_draft *d = builder_append(b, &b->columns, sizeof *d);
        if (d) {
            *d = draft;
        }
    }
}

// The columns of the storey below a floor; NULL: it has none.
static struct struck_storeys *find_storeys(struct builder *b, int building, int floor) {
    struct struck_storeys *s = b->column_storeys.item;
    for (int i = 0; i < b->column_storeys.n; i++) {
        for (int k = 0; s[i].storeys.building == building && k < s[i].storeys.n_floor; k++) {
            if (s[i].storeys.floor[k] == floor) {
                return &s[i];
            }
        }
    }
    return NULL;
}

void struck_column_add_storeys(struct builder *b, const struct struck_storeys *storeys) {
    const struct selection *q = &storeys->storeys;
    for (int k = 0; k < q->n_floor; k++) {
        const struct struck_storeys *same = find_storeys(b, q->building, q->floor[k]);
        if (same) {
            deck_error(b->deck, &storeys->draft.word,
                       "columns %s are in storey %d of building %s already",
                       same->draft.column.name, q->floor[k], builder_draft(b, q->building)->name);
            return;
        }
    }
    struct struck_storeys *own = builder_append(b, &b->column_storeys, sizeof *own);
    if (own) {
        *own = *storeys;
    }
}

void struck_column_strike(struct builder *b, int building, int floor, double level) {
    struct struck_storeys *s = find_storeys(b, building, floor);
    if (!s || isnan(level)) {
        return;
    }
    s->struck = true;
    if (struck_column_at(b, building, level) < 0) {
        struct struck_draft draft = s->draft;
        const int n = b->columns.n;
        draft.column.name = arena_format(b->arena, "%s@%.6g%s", draft.column.name, level,
                                         b->deck->units.length_name);
        struck_column_add(b, &draft, floor, level);
        s->storeys.n_floor = b->columns.n > n ? s->storeys.n_floor : 0;  // one report is enough
    }
}

int struck_column_points(const struct builder *b, int building) {
    int n = 0;
    for (int i = 0; i < b->columns.n; i++) {
        const struct struck_column *c = &struck_column_draft(b, i)->column;
        n += c->building == building && c->line > 0;
    }
    return n;
}
