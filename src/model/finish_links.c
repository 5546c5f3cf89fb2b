// SPDX-License-Identifier: GPL-3.0-or-later
// Contacts, bilateral links and loads of the model.
#include <assert.h>
#include <stdlib.h>
#include <string.h>

#include "core/arena.h"
#include "core/text.h"
#include "model/finish.h"
#include "model/foundation.h"
#include "model/link_end.h"

// True if the law uses -vmin as v0 for a contact that is closed at rest, and the force at the
// separation depends on it.
static bool parts_by_vmin(const struct link *l, double delta) {
    const int row = contact_law_row(l->law, "vmin");
    if (row < 0) {
        return false;
    }
    const double v = l->value[row];
    double least[CONTACT_HISTORY_MAX], faster[CONTACT_HISTORY_MAX];
    l->law->close(l->constant, 0.0, least);
    l->law->close(l->constant, 2.0 * v, faster);
    return l->law->force(l->constant, least, delta, -v).force !=
           l->law->force(l->constant, faster, delta, -v).force;
}

static void check_overlap(struct builder *b, const struct model *m, const struct link_draft *d) {
    const struct link *l = &d->link;
    double delta = link_across(l, m->displacement) - l->gap;
    if (l->bilateral || delta <= 0.0) {
        return;
    }
    if (l->law->rebound) {
        deck_error(b->deck, &d->word,
                   "contact %s is closed by %.6g %s at t = 0, but its law, %s, has no force that "
                   "would part the bodies",
                   l->name, delta, b->deck->units.length_name, l->law->name);
    } else if (!d->overlap) {
        deck_error(b->deck, &d->word,
                   "contact %s is closed by %.6g %s at t = 0; give -allow-overlap if that is meant",
                   l->name, delta, b->deck->units.length_name);
    } else if (link_across(l, m->velocity) <= 0.0 && parts_by_vmin(l, delta)) {
        deck_warning(b->deck, &d->word,
                     "contact %s is closed at t = 0 and does not approach: %s takes -vmin for v0 "
                     "and %s",
                     l->name, l->law->name,
                     l->law->traits & CONTACT_MAY_PULL ? "may hold the bodies together"
                                                       : "hardly pushes the bodies apart");
    }
}

// Sorts contacts before bilateral links, then by name, then in the order of the deck.
static int compare_names(const void *a, const void *b) {
    const struct link_draft *const *x = a;
    const struct link_draft *const *y = b;
    if ((*x)->link.bilateral != (*y)->link.bilateral) {
        return (*x)->link.bilateral ? 1 : -1;
    }
    int order = strcmp((*x)->link.name, (*y)->link.name);
    return order != 0 ? order : (*x > *y) - (*x < *y);
}

static bool same_name(const struct link_draft *a, const struct link_draft *b) {
    return a->link.bilateral == b->link.bilateral && strcmp(a->link.name, b->link.name) == 0;
}

// Two contacts with one name: an error if the user gave the name. A contact that was named after
// its floors gets the name NAME#2, NAME#3 and so on.
static void rename_twin(struct builder *b, const struct link_draft *first, struct link_draft *twin,
                        int number) {
    if (first->named || twin->named) {
        deck_error(b->deck, &twin->word, "a second contact or link '%s'; give it another -name",
                   twin->link.name);
        return;
    }
    const char *name = arena_format(b->arena, "%s#%d", twin->link.name, number);
    twin->link.name = name ? name : twin->link.name;
}

// True if both contacts have the same force at the same penetration.
static bool same_contact(const struct link *a, const struct link *b) {
    const int n = contact_law_n_value(a->law, a->value);
    return !a->bilateral && a->law == b->law && a->gap == b->gap && a->mass == b->mass &&
           contact_law_n_value(b->law, b->value) == n &&
           memcmp(a->value, b->value, (size_t)n * sizeof *a->value) == 0;
}

// Contacts that repeat another contact between the same floors: the first in the deck, and their
// number.
struct repeated {
    const struct link_draft *draft;
    int n;
};

static void take_repeated(struct repeated *r, const struct link_draft *twin) {
    r->n++;
    r->draft = r->draft && r->draft < twin ? r->draft : twin;
}

static void check_names(struct builder *b) {
    size_t n = (size_t)b->links.n;
    struct link_draft *draft = b->links.item;
    struct link_draft **sorted = arena_alloc(b->arena, n, sizeof(struct link_draft *));
    if (!sorted || n == 0) {
        return;
    }
    for (size_t i = 0; i < n; i++) {
        sorted[i] = &draft[i];
    }
    qsort(sorted, n, sizeof(struct link_draft *), compare_names);
    struct repeated repeated = {0};
    for (size_t first = 0, i = 1; i < n; i++) {
        if (!same_name(sorted[first], sorted[i])) {
            first = i;
            continue;
        }
        if (!sorted[i]->named && same_contact(&sorted[first]->link, &sorted[i]->link)) {
            take_repeated(&repeated, sorted[i]);
        }
        rename_twin(b, sorted[first], sorted[i], (int)(i - first) + 1);
    }
    if (repeated.n > 0) {
        struct text_more more;
        deck_warning(b->deck, &repeated.draft->word,
                     "contact %s%s repeats one of the same floors, gap and law, and adds to its "
                     "force; give it a -name if that is meant",
                     repeated.draft->link.name, text_more(&more, repeated.n));
    }
}

// Rows count floors of their building from 0 until here. False: no memory.
static bool place_row(struct arena *a, struct link *l, int side, int first) {
    const int n = l->row[side].n;
    struct link_entry *entry = arena_alloc(a, (size_t)n, sizeof *entry);
    for (int i = 0; entry && i < n; i++) {
        entry[i] =
            (struct link_entry){first + l->row[side].entry[i].dof, l->row[side].entry[i].weight};
    }
    l->row[side] = (struct link_row){entry ? n : 0, entry};
    l->dof[side] = n > 0 && entry ? entry[0].dof : WALL;
    return entry != NULL;
}

static void finish_ends(struct arena *a, const struct model *m, struct link *l) {
    int ground[2] = {WALL, WALL};
    for (int i = 0; i < 2; i++) {
        if (l->building[i] != WALL) {
            l->building[i] = l->column[i] < 0 ? l->building[i] : m->n_building + l->column[i];
            const struct building *g = &m->building[l->building[i]];
            const int floor = l->column[i] < 0 ? l->floor[i] : 1;
            if (l->row[i].n == 0) {
                l->dof[i] = g->first + floor - 1;
            } else if (!place_row(a, l, i, g->first)) {
                return;
            }
            ground[i] = g->ground;
        }
    }
    assert(l->dof[0] < m->n_dof && l->dof[1] < m->n_dof);
    l->moving_ground = ground[0] != WALL && ground[1] != WALL && ground[0] != ground[1];
}

void finish_links(struct builder *b, struct model *m) {
    struct link_draft *draft = b->links.item;
    struct link *link = arena_alloc(b->arena, (size_t)b->links.n, sizeof *link);
    check_names(b);
    for (int bilateral = 0; link && bilateral < 2; bilateral++) {
        for (int i = 0; i < b->links.n; i++) {
            if (draft[i].link.bilateral == bilateral) {
                finish_ends(b->arena, m, &draft[i].link);
                draft[i].link.word = &draft[i].word;
                check_overlap(b, m, &draft[i]);
                draft[i].link.history = m->n_link_history;
                m->n_link_history += draft[i].link.law->n_history;
                link[m->n_link++] = draft[i].link;
            }
        }
        if (!bilateral) {
            m->n_contact = m->n_link;
        }
    }
    assert(!link || (m->n_link == b->links.n && m->n_contact <= m->n_link));
    m->link = link;
}

void finish_loads(struct builder *b, struct model *m) {
    const struct load_draft *draft = b->loads.item;
    const size_t n = (size_t)b->loads.n + (size_t)foundation_n_load(m);
    struct load *load = arena_alloc(b->arena, n, sizeof *load);
    for (int i = 0; load && i < b->loads.n; i++) {
        load[i].dof = m->building[draft[i].building].first + draft[i].floor - 1;
        assert(load[i].dof >= 0 && load[i].dof < m->n_dof);
        load[i].signal = draft[i].signal;
    }
    m->n_load = load ? b->loads.n + foundation_loads(b, m, load + b->loads.n) : 0;
    m->load = load;
}
