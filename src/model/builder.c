// SPDX-License-Identifier: GPL-3.0-or-later
// Growing lists and the checks that several statements share.
#include "model/builder.h"

#include <assert.h>
#include <string.h>

#include "deck/reader.h"

static const char wall[] = "wall";

void *builder_append(struct builder *b, struct list *list, size_t size) {
    assert(list->n <= list->capacity && size > 0);
    if (list->n == list->capacity) {
        int capacity = list->capacity ? 2 * list->capacity : 8;
        void *item = arena_alloc(b->arena, (size_t)capacity, size);
        if (!item) {
            return NULL;
        }
        if (list->n > 0) {
            memcpy(item, list->item, (size_t)list->n * size);
        }
        list->item = item;
        list->capacity = capacity;
    }
    return (char *)list->item + (size_t)list->n++ * size;
}

double *builder_spread(struct builder *b, const struct argument *a, int n, const char *owner) {
    assert(a->n > 0 && n > 0);
    if (a->n != 1 && n == 1) {
        deck_error(b->deck, &a->key, "%d values where one is needed", a->n);
        return NULL;
    }
    if (a->n != 1 && a->n != n) {
        deck_error(b->deck, &a->key, "%d values for %d %s; give one for all, or %d", a->n, n, owner,
                   n);
        return NULL;
    }
    double *value = arena_alloc(b->arena, (size_t)n, sizeof *value);
    for (int i = 0; value && i < n; i++) {
        value[i] = a->number[a->n == 1 ? 0 : i];
    }
    return value;
}

bool builder_plain(struct builder *b, const struct statement *s, int least, int most,
                   const char *usage) {
    assert(least <= most);
    if (s->n_plain - 1 < least) {
        return deck_error(b->deck, &s->word[0], "too few words; usage: %s %s", s->word[0].text,
                          usage);
    }
    if (s->n_plain - 1 > most) {
        return deck_error(b->deck, &s->word[most + 1], "unexpected word '%s'; usage: %s %s",
                          s->word[most + 1].text, s->word[0].text, usage);
    }
    return true;
}

bool builder_once(struct builder *b, struct word *mark, const struct statement *s) {
    if (mark->text) {
        return deck_error(b->deck, &s->word[0], "a second '%s'; the first is in %s",
                          s->word[0].text,
                          source_mention(b->deck, &mark->place, &s->word[0].place));
    }
    *mark = s->word[0];
    return true;
}

int builder_variant(struct builder *b, const struct word *w, const char *what,
                    const struct statement_kind *kind) {
    enum { VARIANTS_MAX = 4 };
    const char *known[VARIANTS_MAX];
    assert(kind->n_variant <= VARIANTS_MAX);
    for (int i = 0; i < kind->n_variant; i++) {
        known[i] = kind->variant[i].name;
    }
    return deck_keyword(b->deck, w, what, known, kind->n_variant);
}

struct building_draft *builder_draft(struct builder *b, int i) {
    assert(i >= 0 && i < b->buildings.n);
    return (struct building_draft *)b->buildings.item + i;
}

int builder_find_building(const struct builder *b, const char *name, size_t length) {
    assert(name);
    return name_index_find(&b->building_index, name, length);
}

struct building_draft *builder_add_building(struct builder *b, const char *name) {
    struct building_draft *d = builder_append(b, &b->buildings, sizeof *d);
    bool added = d && name_index_add(&b->building_index, b->arena, name, b->buildings.n - 1);
    return added ? d : NULL;
}

double builder_gravity(struct builder *b) {
    return deck_gravity(b->deck) / unit_size(&b->deck->units, dimension_acceleration);
}

bool builder_has_heights(struct builder *b, const struct building_draft *d, const struct word *w,
                         const char *what) {
    if (!d->height && !d->any_height) {
        deck_error(b->deck, w, "%s needs the heights of the storeys; building %s has no -height",
                   what, d->name);
    }
    return d->height != NULL;
}

void builder_add_part(struct builder *b, struct building_draft *d, const struct part *part) {
    assert(part->kind);
    int number = 1;
    for (int i = 0; i < d->parts.n; i++) {
        number += ((const struct part *)d->parts.item)[i].kind == part->kind;
    }
    struct part *p = builder_append(b, &d->parts, sizeof *p);
    if (p) {
        *p = *part;
        p->name = number > 1 ? arena_format(b->arena, "%s-%d", part->kind->name, number)
                             : part->kind->name;
    }
}

// The index of the building; -1: not found. If lines of the deck could not be read (torn), they may
// define the building, so there is no report.
static int find_or_report(struct builder *b, const struct word *w, const char *name, size_t length,
                          enum wall_use walls) {
    int i = builder_find_building(b, name, length);
    if (i < 0 && !b->deck->torn) {
        size_t n = (size_t)b->buildings.n;
        const char **known = arena_alloc(b->arena, n + 1, sizeof *known);
        for (size_t k = 0; known && k < n; k++) {
            known[k] = builder_draft(b, (int)k)->name;
        }
        if (known && walls != WALL_REFUSED) {
            known[n++] = wall;
        }
        const char *text = arena_text(b->arena, name, length);
        if (known && text) {
            deck_unknown(b->deck, w, text, "building", known, (int)n);
        }
    }
    return i;
}

int builder_building(struct builder *b, const struct word *w) {
    const char *name = deck_text(b->deck, w);
    return name ? find_or_report(b, w, name, strlen(name), WALL_REFUSED) : -1;
}

static void report_selection(struct builder *b, const struct word *w) {
    struct deck_quote quote;
    const char *value = deck_text(b->deck, w);
    if (value) {
        deck_error(b->deck, w, "%s is not a selection of floors; write 3, 1:5, 1,3,5 or all",
                   deck_quote(&quote, w, value));
    }
}

// Reads one floor number of a selection, at least `lowest`; -1 after a report.
static int parse_floor(struct builder *b, const struct word *w, const char **text,
                       const struct building_draft *d, int lowest) {
    int floor = 0;
    const char *p = *text;
    while (*p >= '0' && *p <= '9' && floor <= FLOORS_MAX) {
        floor = 10 * floor + (*p++ - '0');
    }
    if (p == *text) {
        report_selection(b, w);
        return -1;
    }
    if (floor < lowest || floor > d->n_floor) {
        deck_error(b->deck, w, "floor %.*s is not one of 1 to %d of building %s",
                   (int)strspn(*text, "0123456789"), *text, d->n_floor, d->name);
        return -1;
    }
    *text = p;
    return floor;
}

// Appends floors first to last to the selection; false after a report.
static bool take_floors(struct builder *b, const struct word *w, int first, int last, int *floor,
                        struct selection *out) {
    if (last < first) {
        return deck_error(b->deck, w, "floors %d:%d run backwards; write %d:%d", first, last, last,
                          first);
    }
    for (int i = first; i <= last; i++) {
        for (int k = 0; k < out->n_floor; k++) {
            if (floor[k] == i) {
                return deck_error(b->deck, w, "floor %d is selected twice", i);
            }
        }
        floor[out->n_floor++] = i;
    }
    return true;
}

// Reads `1:5`, `3` or `1,3,5:7` in the order written; false after a report.
static bool parse_floors(struct builder *b, const struct word *w, const char *text, int *floor,
                         struct selection *out) {
    const struct building_draft *d = builder_draft(b, out->building);
    for (;;) {
        int first = parse_floor(b, w, &text, d, out->lowest);
        int last = first;
        if (first >= 0 && *text == ':') {
            text++;
            last = parse_floor(b, w, &text, d, out->lowest);
        }
        if (first < 0 || last < 0 || !take_floors(b, w, first, last, floor, out)) {
            return false;
        }
        if (*text == 0) {
            return true;
        }
        if (*text++ != ',') {
            report_selection(b, w);
            return false;
        }
    }
}

// Reads the floors that `text` names, NULL: all, of the building that `out` has.
static bool select_floors(struct builder *b, const struct word *w, const char *text,
                          struct selection *out) {
    const int n = builder_draft(b, out->building)->n_floor;
    int *floor = n > 0 ? arena_alloc(b->arena, (size_t)n + 1, sizeof *floor) : NULL;
    if (!floor) {
        return false;
    }
    out->all = text == NULL;
    out->named = text && strcmp(text, "all") != 0;
    out->floor = floor;
    return out->named ? parse_floors(b, w, text, floor, out) : take_floors(b, w, 1, n, floor, out);
}

bool builder_floors(struct builder *b, const struct word *w, int i, struct selection *out) {
    const char *text = deck_text(b->deck, w);
    *out = (struct selection){.building = i, .lowest = 1};
    return text && select_floors(b, w, text, out);
}

bool builder_select(struct builder *b, const struct word *w, enum wall_use walls,
                    struct selection *out) {
    *out = (struct selection){.building = WALL, .lowest = walls == GROUND_ALLOWED ? 0 : 1};
    const char *text = deck_text(b->deck, w);
    if (!text) {
        return false;
    }
    if (strcmp(text, wall) == 0) {
        if (walls == WALL_REFUSED) {
            deck_error(b->deck, w, "a building is needed here, not a wall");
        }
        return walls != WALL_REFUSED;
    }
    const char *colon = strchr(text, ':');
    size_t length = colon ? (size_t)(colon - text) : strlen(text);
    if (walls != WALL_REFUSED && length == strlen(wall) && strncmp(text, wall, length) == 0) {
        return deck_error(b->deck, w, "a wall has no floors; it faces those of the other side");
    }
    out->building = find_or_report(b, w, text, length, walls);
    if (out->building < 0) {
        return false;
    }
    return select_floors(b, w, colon ? colon + 1 : NULL, out);
}
