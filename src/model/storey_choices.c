// SPDX-License-Identifier: GPL-3.0-or-later
#include "model/storey_choices.h"

#include <math.h>
#include <string.h>

#include "deck/reader.h"

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
    const int yield = storey_choice_row(law, "yield");
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
    if (law->prepare(value, stiffness, constant, &e) != STATUS_OK) {
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
