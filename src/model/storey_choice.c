// SPDX-License-Identifier: GPL-3.0-or-later
#include "model/storey_choice.h"

#include <math.h>
#include <string.h>

#include "deck/reader.h"
#include "law/yield.h"

const struct storey_law *storey_choice_find(struct deck *d, const struct word *name) {
    const char *text = deck_text(d, name);
    const struct storey_law *law = text ? storey_law_find(text) : NULL;
    const char **known = text && !law ? deck_array(d, (size_t)n_storey_law, sizeof *known) : NULL;
    for (int i = 0; known && i < n_storey_law; i++) {
        known[i] = storey_laws[i]->name;
    }
    if (known) {
        deck_unknown(d, name, text, "storey law", known, n_storey_law);
    }
    return law;
}

const struct storey_law *storey_choice_find_rateless(struct deck *d, const struct word *name) {
    const struct storey_law *law = storey_choice_find(d, name);
    if (law && law->respond_at_rate) {
        deck_error(d, name, "law %s depends on the velocity; it is for storeys only", law->name);
        return NULL;
    }
    return law;
}

bool storey_choice_find_link(struct deck *d, const struct word *name, struct link_law *out) {
    const char *text = deck_text(d, name);
    const char **known = text ? deck_array(d, (size_t)n_link_law, sizeof *known) : NULL;
    for (int i = 0; known && i < n_link_law; i++) {
        *out = link_law_at(i);
        if (strcmp(out->name, text) == 0) {
            return true;
        }
        known[i] = out->name;
    }
    if (known) {
        deck_unknown(d, name, text, "law of a link", known, n_link_law);
    }
    return false;
}

void storey_choice_turn(const struct row *from, int n, struct row *row) {
    for (int r = 0; r < n; r++) {
        row[r] = from[r];
        row[r].dimension.length = row[r].dimension.force;
    }
}

bool storey_choice_read(struct deck *d, const struct statement *s, const struct row *of, int n_row,
                        const struct row_set *own, const bool *found, struct storey_choice *out) {
    *out = (struct storey_choice){.word = &s->word[0]};
    struct row row[LOOP_ROWS_MAX];
    for (int r = 0; r < n_row; r++) {
        row[r] = of[r];
        if (found && found[r]) {
            row[r].flags &= ~(unsigned)ROW_REQUIRED;
        }
    }
    struct row_set set[] = {*own, {row, n_row, out->given}};
    if (!deck_options(d, s, set, 2)) {
        return false;
    }
    for (int r = 0; r < n_row; r++) {
        const struct argument *a = &out->given[r];
        if (a->n > 1) {
            return deck_error(d, &a->word[1], "-%s has one value here", row[r].key);
        }
        const bool flag = row[r].kind == ROW_FLAG && a->given;
        out->value[r] = a->n > 0 && a->number ? a->number[0] : flag ? 1.0 : NAN;
    }
    return true;
}

bool storey_choices_rows(struct builder *b, const struct row *row, int n_row,
                         const struct argument *given, int n, const char *owner, double **value) {
    double *flagged = arena_alloc(b->arena, 1, sizeof *flagged);
    const struct argument raised = {.given = true, .n = 1, .number = flagged};
    bool good = flagged != NULL;
    if (good) {
        *flagged = 1.0;
    }
    for (int r = 0; good && r < n_row; r++) {
        const bool flag = row[r].kind == ROW_FLAG && given[r].given;
        if (flag || given[r].n > 0) {
            value[r] = builder_spread(b, flag ? &raised : &given[r], n, owner);
            good &= value[r] != NULL;
        }
    }
    return good;
}

bool storey_choices_spread(struct builder *b, struct storey_choices *c, int n, const char *owner) {
    const struct storey_law *law = c->law;
    static const struct row damage[] = {STOREY_CHOICES_DAMAGE(OF_NONE)};
    const struct argument *first = c->damage[STOREY_DAMAGE_ULTIMATE].given
                                       ? &c->damage[STOREY_DAMAGE_ULTIMATE]
                                       : &c->damage[STOREY_DAMAGE_BETA];
    if (first->given && law->n_history == 0) {
        return deck_error(b->deck, &first->key, "law %s does not yield: it has no damage index",
                          law->name);
    }
    const bool good =
        storey_choices_rows(b, law->row, law->n_row, c->given, n, owner, c->value) &&
        storey_choices_rows(b, damage, STOREY_DAMAGE_COUNT, c->damage, n, owner, c->damage_value);
    const int yield = row_find(law->row, law->n_row, "yield");
    if (yield >= 0 && c->value[yield]) {
        c->yield = c->value[yield];
        c->yield_row = yield;
    }
    return good;
}

bool storey_choices_law(struct builder *b, const struct word *w, const struct storey_law *law,
                        const double *value, double stiffness, struct storey *out) {
    double *constant = arena_alloc(b->arena, (size_t)law->n_constant, sizeof *constant);
    if (!constant) {
        return false;
    }
    struct error e;
    if (storey_law_prepare(law, value, stiffness, constant, &e) != STATUS_OK) {
        return deck_error(b->deck, w, "%s", e.message);
    }
    out->law = law;
    out->constant = constant;
    return true;
}

bool storey_choices_prepare(struct builder *b, const struct word *w, const struct storey_choices *c,
                            int k, double stiffness, struct storey *out) {
    double own[STOREY_ROWS_MAX];
    const struct storey_law *law = c->law;
    for (int r = 0; r < law->n_row; r++) {
        own[r] = c->value[r] ? c->value[r][k] : NAN;
    }
    out->yield = c->yield ? c->yield[k] : (double)INFINITY;
    double *damage = arena_alloc(b->arena, STOREY_DAMAGE_COUNT, sizeof *damage);
    for (int q = 0; damage && q < STOREY_DAMAGE_COUNT; q++) {
        damage[q] = c->damage_value[q] ? c->damage_value[q][k] : (double)NAN;
    }
    out->damage = damage;
    return storey_choices_law(b, w, law, own, stiffness, out);
}

bool storey_choices_take(struct builder *b, struct building_draft *d, int i,
                         const struct statement *s) {
    struct word *mark = &d->storey_word[i];
    if (mark->text) {
        return deck_error(b->deck, &s->word[1], "storey %d of building %s has a law already, in %s",
                          i + 1, d->name, source_mention(b->deck, &mark->place, &s->word[0].place));
    }
    *mark = s->word[0];
    return true;
}

bool storey_choices_isolate(struct builder *b, struct building_draft *d, int i,
                            const struct word *w) {
    if (d->isolated > 0 && d->isolated != i + 1) {
        return deck_error(b->deck, w,
                          "storey %d of building %s is its isolator already; it can have one",
                          d->isolated, d->name);
    }
    d->isolated = i + 1;
    return true;
}
