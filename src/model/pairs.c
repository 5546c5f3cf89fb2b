// SPDX-License-Identifier: GPL-3.0-or-later
#include "model/pairs.h"

#include <assert.h>
#include <string.h>

#include "core/arena.h"
#include "law/link_law.h"
#include "model/struck_column.h"

static bool check_order(struct builder *b, struct pairs *p, enum wall_use walls) {
    int left = p->building[0];
    int right = p->building[1];
    p->within = left == right && left != WALL && walls == GROUND_ALLOWED;
    if (left == WALL && right == WALL) {
        return deck_error(b->deck, &p->word[1], "only one side can be a wall");
    }
    if (left == WALL || right == WALL || left < right || p->within) {
        return true;
    }
    if (left == right) {
        deck_error(b->deck, &p->word[1], "a building cannot be connected with itself");
    } else {
        deck_error(b->deck, &p->word[1], "building %s is to the left of %s; write %s first",
                   builder_draft(b, right)->name, builder_draft(b, left)->name,
                   builder_draft(b, right)->name);
    }
    return false;
}

static int highest(const struct selection *s) {
    int floor = 0;
    for (int i = 0; i < s->n_floor; i++) {
        floor = s->floor[i] > floor ? s->floor[i] : floor;
    }
    return floor;
}

// A side without a selection gets the floors of the other side. If both have none, all floors that
// both buildings have are paired.
static bool match_floors(struct builder *b, struct selection side[2], const struct word *word) {
    for (int i = 0; i < 2; i++) {
        struct selection *open = &side[i];
        const struct selection *other = &side[1 - i];
        if (!open->all || other->building == WALL) {
            continue;
        }
        int levels = builder_draft(b, open->building)->n_floor;
        if (other->all) {
            int common = builder_draft(b, other->building)->n_floor;
            open->n_floor = levels < common ? levels : common;
        } else if (highest(other) > levels) {
            return deck_error(
                b->deck, &word[i], "building %s has no floor %d to face the other side",
                open->building >= 0 ? builder_draft(b, open->building)->name : "", highest(other));
        } else {
            open->n_floor = other->n_floor;
            open->floor = other->floor;
        }
    }
    return true;
}

// A side needs a selection if the other side is a level or in the same building.
static bool check_named(struct builder *b, const struct pairs *p, const struct selection side[2],
                        const double of[2]) {
    const bool level = !isnan(of[0]) || !isnan(of[1]);
    for (int i = 0; i < 2; i++) {
        if (side[i].all && (level || p->within) && side[1 - i].building != WALL) {
            return deck_error(b->deck, &p->word[i], "name the floor of building %s that %s joins",
                              builder_draft(b, side[i].building)->name, p->word[1 - i].text);
        }
    }
    return true;
}

static bool read_side(struct builder *b, struct word *w, enum wall_use walls,
                      struct selection *side, double *level) {
    const enum end_kind kind = level_kind(b, w);
    *level = NAN;
    *side = (struct selection){.building = WALL};
    return kind == END_LEVEL ? level_read(b, w, side, level)
                             : kind == END_FLOORS && builder_select(b, w, walls, side);
}

bool pairs_read(struct builder *b, const struct statement *s, enum wall_use walls,
                struct pairs *out) {
    struct selection side[2];
    double of[2];
    *out = (struct pairs){.word = &s->word[1]};
    bool good = true;
    for (int i = 0; i < 2; i++) {
        struct word w = s->word[1 + i];
        good &= read_side(b, &w, walls, &side[i], &of[i]);
        out->building[i] = side[i].building;
    }
    if (!(good && check_order(b, out, walls) && check_named(b, out, side, of) &&
          match_floors(b, side, out->word))) {
        return false;
    }
    // Floor 0, the ground, is allowed in a link within one building only; other links have `wall`.
    for (int i = 0; i < 2; i++) {
        for (int k = 0; k < side[i].n_floor && !out->within; k++) {
            if (side[i].floor[k] == 0) {
                return deck_error(
                    b->deck, &out->word[i],
                    "floor 0, the ground, joins floors of the same building only; write "
                    "wall for a rigid wall");
            }
        }
    }
    bool walled = side[0].building == WALL || side[1].building == WALL;
    if (!walled && side[0].n_floor != side[1].n_floor) {
        return deck_error(b->deck, &s->word[2],
                          "%d on the left, but %d on the right: floors face each other one to one",
                          side[0].n_floor, side[1].n_floor);
    }
    out->named = side[0].named && side[1].named;
    out->n = side[0].building == WALL ? side[1].n_floor : side[0].n_floor;
    for (int i = 0; i < 2; i++) {
        double *level = arena_alloc(b->arena, (size_t)out->n, sizeof *level);
        for (int k = 0; level && k < out->n; k++) {
            level[k] = of[i];
        }
        out->level[i] = level;
        out->floor[i] = side[i].building == WALL
                            ? arena_alloc(b->arena, (size_t)out->n, sizeof(int))
                            : side[i].floor;
    }
    return out->floor[0] && out->floor[1] && out->level[0] && out->level[1];
}

// The levels of the floors of both buildings, from 0 for the ground; false after a report.
static bool find_levels(struct builder *b, const struct pairs *p, double *level[2]) {
    for (int i = 0; i < 2; i++) {
        const struct building_draft *d = builder_draft(b, p->building[i]);
        if (!builder_has_heights(b, d, &p->word[i], "-by-level")) {
            return false;
        }
        level[i] = arena_alloc(b->arena, (size_t)d->n_floor + 1, sizeof *level[i]);
        for (int k = 1; level[i] && k <= d->n_floor; k++) {
            level[i][k] = level_of_floor(d->height, k);
        }
    }
    return level[0] && level[1];
}

// Adds the pair of floors, or of floor `at[side]` and the level of the other building there.
static void add_pair(struct pairs *p, int *floor[2], double *level[2], const int at[2],
                     double *const of[2], int only) {
    for (int i = 0; i < 2; i++) {
        floor[i][p->n] = at[i];
        level[i][p->n] = only >= 0 && only != i ? of[only][at[only]] : (double)NAN;
    }
    p->n++;
}

bool pairs_by_level(struct builder *b, const struct statement *s, double depth, struct pairs *out) {
    *out = (struct pairs){.word = &s->word[1], .named = true, .by_level = true};
    int n[2];
    for (int i = 0; i < 2; i++) {
        const struct word *w = &s->word[1 + i];
        if (strpbrk(w->text, ":@") || strcmp(w->text, "wall") == 0) {
            return deck_error(b->deck, w, "-by-level needs two buildings, without floors");
        }
        out->building[i] = builder_building(b, w);
        if (out->building[i] < 0) {
            return false;
        }
        n[i] = builder_draft(b, out->building[i])->n_floor;
    }
    double *of[2];
    if (!check_order(b, out, WALL_ALLOWED) || n[0] == 0 || n[1] == 0 || !find_levels(b, out, of)) {
        return false;
    }
    const size_t most = (size_t)n[0] + (size_t)n[1];
    int *floor[2], at[2] = {1, 1};
    double *level[2];
    for (int i = 0; i < 2; i++) {
        out->floor[i] = floor[i] = arena_alloc(b->arena, most, sizeof *floor[i]);
        out->level[i] = level[i] = arena_alloc(b->arena, most, sizeof *level[i]);
    }
    if (arena_failed(b->arena)) {
        return false;
    }
    while (at[0] <= n[0] && at[1] <= n[1]) {
        const double apart = of[0][at[0]] - of[1][at[1]];
        const bool meet = fabs(apart) < depth;
        add_pair(out, floor, level, at, of, meet ? -1 : apart > 0.0);
        at[0] += meet || apart <= 0.0;
        at[1] += meet || apart > 0.0;
    }
    return true;
}

static const char *end_name(struct builder *b, const struct link *l, int side) {
    if (l->building[side] == WALL) {
        return "wall";
    }
    const char *name = builder_draft(b, l->building[side])->name;
    return isnan(l->level[side]) ? arena_format(b->arena, "%s:%d", name, l->floor[side])
                                 : arena_format(b->arena, "%s@%.6g%s", name, l->level[side],
                                                b->deck->units.length_name);
}

static const char *link_name(struct builder *b, const struct pairs *p, const struct link *l, int k,
                             const char *name) {
    if (name && p->n == 1) {
        return name;
    }
    if (name) {
        const int number = p->by_level ? k + 1 : l->floor[l->building[0] == WALL];
        return arena_format(b->arena, "%s:%d", name, number);
    }
    const char *left = end_name(b, l, 0);
    const char *right = end_name(b, l, 1);
    return left && right ? arena_format(b->arena, "%s-%s", left, right) : NULL;
}

struct link_draft *pairs_append(struct builder *b, const struct pairs *p, int k, const char *name,
                                const struct word *name_word) {
    assert(k >= 0 && k < p->n);
    struct link link = {.restitution = NAN, .within = p->within};
    for (int i = 0; i < 2; i++) {
        link.building[i] = p->building[i];
        link.floor[i] = p->floor[i][k];
        link.level[i] = p->level[i][k];
        link.column[i] = struck_column_at(b, p->building[i], link.level[i]);
        link.dof[i] = WALL;
    }
    if (p->within && (link.column[0] >= 0 || link.column[1] >= 0)) {
        const int end = link.column[0] < 0;
        deck_error(b->deck, &p->word[end],
                   "column %s is at this level; a link within a building cannot end there",
                   struck_column_draft(b, link.column[end])->column.name);
        return NULL;
    }
    link.weight[0] = level_weight(b, &link, 0);
    link.weight[1] = level_weight(b, &link, 1);
    link.name = link_name(b, p, &link, k, name);
    if (!link.name || !level_rows(b, &link, &p->word[1])) {
        return NULL;
    }
    link.mass = level_effective_mass(b, &link);
    struct link_draft *d = builder_append(b, &b->links, sizeof *d);
    if (d) {
        *d = (struct link_draft){
            .link = link, .word = *name_word, .named = name != NULL, .floors = p->named};
    }
    return d;
}

const char *pairs_name(struct builder *b, const struct argument *a, bool *good) {
    if (!a->given || a->n == 0) {
        return NULL;
    }
    const char *name = a->text[0];
    if (!name[0] || strlen(name) > 64 || strpbrk(name, "/#")) {
        struct deck_quote quote;
        deck_error(b->deck, &a->word[0],
                   "%s cannot name a link; use up to 64 characters, no / or #",
                   deck_quote(&quote, &a->word[0], name));
        *good = false;
    }
    return name;
}

bool pairs_set_law(struct builder *b, struct link *link, const struct law_choice *choice) {
    link->law = choice->law;
    link->restitution = choice->restitution;
    link->calibrated = choice->calibrated;
    return law_choice_prepare(b->deck, choice, link->mass, &link->value, &link->constant);
}

const struct contact_law *pairs_storey_law(struct builder *b, const struct link_law *from) {
    const size_t n_row = LINK_ROWS + (size_t)from->n_row;
    struct contact_law *law = arena_alloc(b->arena, 1, sizeof *law);
    struct row *row = arena_alloc(b->arena, n_row, sizeof *row);
    if (!law || !row) {
        return NULL;
    }
    memcpy(row, link_law_rows, sizeof link_law_rows);
    if (from->n_row > 0) {
        memcpy(row + LINK_ROWS, from->row, (size_t)from->n_row * sizeof *row);
    }
    *law = link_law_make(from);
    law->row = row;
    law->n_row = (int)n_row;
    return law;
}

const double *pairs_storey_constants(struct builder *b, const struct link_law *from,
                                     const struct contact_law *law, const double *value,
                                     const struct word *w) {
    double *constant = arena_alloc(b->arena, (size_t)law->n_constant, sizeof *constant);
    struct error e;
    if (constant && link_law_prepare(from, value, constant, &e) != STATUS_OK) {
        deck_error(b->deck, w, "%s", e.message);
        return NULL;
    }
    return constant;
}
