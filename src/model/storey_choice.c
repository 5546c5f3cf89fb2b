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
    memcpy(row, of, (size_t)n_row * sizeof *row);
    for (int r = 0; found && r < n_row; r++) {
        row[r].flags &= found[r] ? ~(unsigned)ROW_REQUIRED : ~0u;
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
