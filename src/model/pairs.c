// SPDX-License-Identifier: GPL-3.0-or-later
#include "model/pairs.h"

#include <string.h>

#include "core/arena.h"

static bool check_order(struct builder *b, const struct pairs *p) {
    int left = p->building[0];
    int right = p->building[1];
    if (left == WALL && right == WALL) {
        deck_error(b->deck, &p->word[1], "one side at most is a wall");
        return false;
    }
    if (left == WALL || right == WALL || left < right) {
        return true;
    }
    if (left == right) {
        deck_error(b->deck, &p->word[1], "a building cannot be connected with itself");
    } else {
        deck_error(b->deck, &p->word[1], "building %s stands to the left of %s; write %s first",
                   builder_draft(b, right)->name, builder_draft(b, left)->name, p->word[1].text);
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

// A side without floors takes those of the other side, or all levels that both have.
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
            deck_error(b->deck, &word[i], "building %s has no floor %d to face the other side",
                       open->building >= 0 ? builder_draft(b, open->building)->name : "",
                       highest(other));
            return false;
        } else {
            open->n_floor = other->n_floor;
            open->floor = other->floor;
        }
    }
    return true;
}

bool pairs_read(struct builder *b, const struct statement *s, struct pairs *out) {
    struct selection side[2];
    *out = (struct pairs){.word = &s->word[1]};
    bool good = builder_select(b, &s->word[1], WALL_ALLOWED, &side[0]);
    good &= builder_select(b, &s->word[2], WALL_ALLOWED, &side[1]);
    for (int i = 0; i < 2; i++) {
        out->building[i] = side[i].building;
    }
    if (!good || !check_order(b, out) || !match_floors(b, side, out->word)) {
        return false;
    }
    bool walled = side[0].building == WALL || side[1].building == WALL;
    if (!walled && side[0].n_floor != side[1].n_floor) {
        deck_error(b->deck, &s->word[2],
                   "%d on the left, but %d on the right: floors face each other one to one",
                   side[0].n_floor, side[1].n_floor);
        return false;
    }
    out->n = side[0].building == WALL ? side[1].n_floor : side[0].n_floor;
    for (int i = 0; i < 2; i++) {
        out->floor[i] = side[i].building == WALL
                            ? arena_alloc(b->arena, (size_t)out->n, sizeof(int))
                            : side[i].floor;
    }
    return out->floor[0] && out->floor[1];
}

static const char *end_name(struct builder *b, const struct link *l, int side) {
    if (l->building[side] == WALL) {
        return "wall";
    }
    return arena_format(b->arena, "%s:%d", builder_draft(b, l->building[side])->name,
                        l->floor[side]);
}

static const char *link_name(struct builder *b, const struct pairs *p, const struct link *l,
                             const char *name) {
    if (name && p->n == 1) {
        return name;
    }
    if (name) {
        return arena_format(b->arena, "%s:%d", name, l->floor[l->building[0] == WALL]);
    }
    const char *left = end_name(b, l, 0);
    const char *right = end_name(b, l, 1);
    return left && right ? arena_format(b->arena, "%s-%s", left, right) : NULL;
}

static double effective_mass(struct builder *b, const struct link *l) {
    double inverse = 0.0;
    for (int i = 0; i < 2; i++) {
        const struct building_draft *d =
            l->building[i] == WALL ? NULL : builder_draft(b, l->building[i]);
        if (d && d->mass) {
            inverse += 1.0 / d->mass[l->floor[i] - 1];
        }
    }
    return inverse > 0.0 ? 1.0 / inverse : 1.0;
}

struct link_draft *pairs_append(struct builder *b, const struct pairs *p, int k, const char *name,
                                const struct word *name_word) {
    struct link link = {.restitution = NAN};
    for (int i = 0; i < 2; i++) {
        link.building[i] = p->building[i];
        link.floor[i] = p->floor[i][k];
        link.dof[i] = WALL;
    }
    link.name = link_name(b, p, &link, name);
    link.mass = effective_mass(b, &link);
    struct link_draft *d = link.name ? builder_append(b, &b->links, sizeof *d) : NULL;
    if (d) {
        *d = (struct link_draft){.link = link, .word = *name_word, .named = name != NULL};
    }
    return d;
}

const char *pairs_name(struct builder *b, const struct argument *a, bool *good) {
    if (!a->given || a->n == 0) {
        return NULL;
    }
    const char *name = a->text[0];
    if (!name[0] || strlen(name) > 64 || strpbrk(name, "/#")) {
        deck_error(b->deck, &a->word[0],
                   "'%.70s' cannot name a link; use up to 64 characters, no / or #", name);
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
