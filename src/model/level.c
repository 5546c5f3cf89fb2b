// SPDX-License-Identifier: GPL-3.0-or-later
// Ends of links at levels between two floors. The displacement of a level is linear between the two
// floors: at the share x of the storey height, its row has the weight x at the floor above and
// 1 - x at the floor below. In the lowest storey the ground replaces the floor below, and has no
// displacement relative to itself. The stiffness of the level is that of the storeys. The bending
// of a single column is not in the model.
//
// The row of a link within one building is the difference of the rows of its ends.
#include "model/pairs.h"

#include <assert.h>
#include <string.h>

#include "core/arena.h"
#include "core/text.h"
#include "model/link_end.h"
#include "model/struck_column.h"

// A level nearer to a floor than this share of the height of the roof is that floor.
static const double SAME_LEVEL = 1e-9;

// Largest number of entries of a row: two for each end.
enum { ENTRIES_MAX = 4 };

static const struct row level_row = {
    "level", ROW_NUMBER, 0, OF_LENGTH, NULL, NAN, "height above the ground of the building"};

enum end_kind level_kind(struct builder *b, struct word *w) {
    const char *text = strchr(w->text, '@') ? w->text : deck_text(b->deck, w);
    if (!text) {
        return END_WRONG;
    }
    const bool level = strchr(text, '@') != NULL;
    w->text = level ? text : w->text;
    return level ? END_LEVEL : END_FLOORS;
}

// The text after the @ of `w`, as a word.
static struct word level_word(const struct word *w, const char *at) {
    struct word part = *w;
    part.text = at + 1;
    part.place.column += (w->quoted ? 1 : 0) + text_columns(w->text, (size_t)(part.text - w->text));
    part.place.width = text_columns(part.text, strlen(part.text));
    part.place.width = part.place.width > 0 ? part.place.width : 1;
    return part;
}

// Finds the storey with the level z: the floor above it, and the level.
static bool place_level(struct builder *b, const struct word *w, double z, struct selection *out,
                        double *level) {
    const struct building_draft *d = builder_draft(b, out->building);
    const char *unit = b->deck->units.length_name;
    const double top = level_of_floor(d->height, d->n_floor);
    const double rounding = SAME_LEVEL * top;
    if (z <= rounding) {
        return deck_error(b->deck, w, "level %.6g %s is not above the ground of building %s", z,
                          unit, d->name);
    }
    if (z > top + rounding) {
        return deck_error(b->deck, w, "level %.6g %s is above the roof of building %s, at %.6g %s",
                          z, unit, d->name, top, unit);
    }
    int *floor = arena_alloc(b->arena, 1, sizeof *floor);
    double above = d->height[0];
    for (int i = 1; i < d->n_floor && z > above + rounding; i++) {
        above += d->height[i];
        out->n_floor = i;
    }
    if (!floor) {
        return false;
    }
    *floor = out->n_floor + 1;
    *level = z >= above - rounding ? NAN : z;
    out->floor = floor;
    out->n_floor = 1;
    return true;
}

bool level_read(struct builder *b, const struct word *w, struct selection *out, double *level) {
    assert(strchr(w->text, '@'));
    const char *at = strchr(w->text, '@');
    const size_t length = (size_t)(at - w->text);
    const char *text = arena_text(b->arena, w->text, length);
    struct word name = *w, place = level_word(w, at);
    struct argument value;
    *out = (struct selection){.building = WALL, .named = true};
    if (!text) {
        return false;
    }
    name.text = text;
    name.place.width = text_columns(text, length);
    out->building = builder_building(b, &name);
    const bool good = deck_values(b->deck, &level_row, 0.0, &place, 1, &value);
    if (out->building < 0 || !good) {
        return false;
    }
    const struct building_draft *d = builder_draft(b, out->building);
    if (!builder_has_heights(b, d, &place, "a level")) {
        return false;
    }
    return place_level(b, &place, value.number[0], out, level);
}

double level_of_floor(const double *height, int floor) {
    double level = 0.0;
    for (int i = 0; i < floor; i++) {
        level += height[i];
    }
    return level;
}

double level_weight(struct builder *b, const struct link *l, int side) {
    if (isnan(l->level[side])) {
        return NAN;
    }
    if (l->column[side] >= 0) {
        return struck_column_draft(b, l->column[side])->column.weight;
    }
    const double *height = builder_draft(b, l->building[side])->height;
    const int below = l->floor[side] - 1;
    return (l->level[side] - level_of_floor(height, below)) / height[below];
}

// Adds sign times the row of one end to the n entries. Entries of one floor are added up. Returns
// the number of entries. A level in the lowest storey of a building on a foundation moves with the
// slab, which is behind the floors.
static int add_end(struct builder *b, const struct link *l, int side, double sign,
                   struct link_entry *entry, int n) {
    const int floor = l->floor[side];
    const struct building_draft *d = builder_draft(b, l->building[side]);
    const double share = isnan(l->level[side]) ? 1.0 : l->weight[side];
    const int below = floor == 1 && d->foundation ? d->n_floor : floor - 2;
    const struct link_entry own[] = {{floor - 1, sign * share}, {below, sign * (1.0 - share)}};
    for (int i = 0; i < 2; i++) {
        int at = 0;
        while (at < n && entry[at].dof != own[i].dof) {
            at++;
        }
        if (own[i].dof < 0 || own[i].weight == 0.0) {
            continue;
        }
        entry[at] =
            (struct link_entry){own[i].dof, own[i].weight + (at < n ? entry[at].weight : 0)};
        n += at == n;
    }
    return n;
}

static bool is_nothing(const struct link_entry *entry, int n) {
    bool nothing = true;
    for (int i = 0; i < n; i++) {
        nothing = nothing && entry[i].weight == 0.0;
    }
    return nothing;
}

static void set_row(struct builder *b, struct link *l, int side, const struct link_entry *entry,
                    int n) {
    assert(n > 0 && n <= ENTRIES_MAX);
    struct link_entry *own = arena_alloc(b->arena, (size_t)n, sizeof *own);
    if (own) {
        memcpy(own, entry, (size_t)n * sizeof *own);
        l->row[side] = (struct link_row){n, own};
        l->dof[side] = own[0].dof;
    }
}

bool level_rows(struct builder *b, struct link *l, const struct word *w) {
    struct link_entry entry[ENTRIES_MAX];
    for (int i = 0; i < 2 && !l->within; i++) {
        if (!isnan(l->level[i]) && l->column[i] < 0) {
            set_row(b, l, i, entry, add_end(b, l, i, 1.0, entry, 0));
        }
    }
    if (l->within) {
        l->building[1] = l->building[0];
        const int n = add_end(b, l, 1, -1.0, entry, add_end(b, l, 0, 1.0, entry, 0));
        if (is_nothing(entry, n)) {
            return deck_error(b->deck, w, "both ends of the link are the same");
        }
        set_row(b, l, 0, entry, n);
        l->building[1] = WALL;
    }
    return true;
}

// The mass of a degree of freedom of a building, which may stand on a foundation.
static double mass_of(const struct building_draft *d, int dof) {
    if (dof < d->n_floor) {
        return d->mass[dof];
    }
    const double height = level_of_floor(d->height, d->n_floor);
    return dof == d->n_floor ? d->foundation->mass : d->foundation->inertia / (height * height);
}

double level_effective_mass(struct builder *b, const struct link *l) {
    assert(l->building[0] != WALL || l->building[1] != WALL);
    double inverse = 0.0;
    for (int i = 0; i < 2; i++) {
        const struct building_draft *d =
            l->building[i] == WALL ? NULL : builder_draft(b, l->building[i]);
        if (l->column[i] >= 0) {
            inverse += 1.0 / struck_column_draft(b, l->column[i])->column.mass;
            continue;
        }
        for (int k = 0; d && d->mass && k < l->row[i].n; k++) {
            const struct link_entry *e = &l->row[i].entry[k];
            inverse += e->weight * e->weight / mass_of(d, e->dof);
        }
        if (d && d->mass && l->row[i].n == 0) {
            inverse += 1.0 / d->mass[l->floor[i] - 1];
        }
    }
    return inverse > 0.0 ? 1.0 / inverse : 1.0;
}

double link_end_row(const struct link_row *row, const double *x) {
    double sum = 0.0;
    for (int i = 0; i < row->n; i++) {
        sum += row->entry[i].weight * x[row->entry[i].dof];
    }
    return sum;
}
