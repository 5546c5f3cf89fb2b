// SPDX-License-Identifier: GPL-3.0-or-later
#include "model/storey_choice.h"

#include <math.h>
#include <string.h>

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

int storey_choice_row(const struct storey_law *law, const char *key) {
    for (int r = 0; r < law->n_row; r++) {
        if (strcmp(law->row[r].key, key) == 0) {
            return r;
        }
    }
    return -1;
}

void storey_choice_turn(const struct storey_law *law, struct row *row) {
    for (int r = 0; r < law->n_row; r++) {
        row[r] = law->row[r];
        row[r].dimension.length = row[r].dimension.force;
    }
}

bool storey_choice_read(struct deck *d, const struct statement *s, const struct storey_law *law,
                        const struct row *of, const struct row_set *own, const bool *found,
                        struct storey_choice *out) {
    *out = (struct storey_choice){.law = law, .word = &s->word[0]};
    struct row row[STOREY_ROWS_MAX];
    memcpy(row, of, (size_t)law->n_row * sizeof *row);
    for (int r = 0; found && r < law->n_row; r++) {
        row[r].flags &= found[r] ? ~(unsigned)ROW_REQUIRED : ~0u;
    }
    struct row_set set[] = {*own, {row, law->n_row, out->given}};
    if (!deck_options(d, s, set, 2)) {
        return false;
    }
    for (int r = 0; r < law->n_row; r++) {
        const struct argument *a = &out->given[r];
        if (a->n > 1) {
            return deck_error(d, &a->word[1], "one storey has one -%s", law->row[r].key);
        }
        const bool flag = law->row[r].kind == ROW_FLAG && a->given;
        out->value[r] = a->n > 0 && a->number ? a->number[0] : flag ? 1.0 : NAN;
    }
    return true;
}

bool storey_choice_prepare(struct deck *d, struct storey_choice *c) {
    struct error e;
    if (c->law->prepare(c->value, c->stiffness, c->constant, &e) != STATUS_OK) {
        return deck_error(d, c->word, "%s", e.message);
    }
    return true;
}
