// SPDX-License-Identifier: GPL-3.0-or-later
#include "model/storey_choices.h"

#include <math.h>
#include <string.h>

#include "deck/reader.h"

bool storey_choices_spread(struct builder *b, struct storey_choices *c, int n, const char *owner) {
    bool good = true;
    for (int r = 0; r < c->law->n_row; r++) {
        if (c->given[r].n > 0) {
            c->value[r] = builder_spread(b, &c->given[r], n, owner);
            good &= c->value[r] != NULL;
        }
        if (c->value[r] && strcmp(c->law->row[r].key, "yield") == 0) {
            c->yield = c->value[r];
            c->yield_row = r;
        }
    }
    return good;
}

bool storey_choices_prepare(struct builder *b, const struct word *w, const struct storey_choices *c,
                            int k, double stiffness, struct storey *out) {
    double own[STOREY_ROWS_MAX];
    const struct storey_law *law = c->law;
    for (int r = 0; r < law->n_row; r++) {
        const bool flag = law->row[r].kind == ROW_FLAG && c->given[r].given;
        own[r] = c->value[r] ? c->value[r][k] : flag ? 1.0 : NAN;
    }
    double *constant = arena_alloc(b->arena, (size_t)law->n_constant, sizeof *constant);
    if (!constant) {
        return false;
    }
    struct error e;
    if (law->prepare(own, stiffness, constant, &e) != STATUS_OK) {
        deck_error(b->deck, w, "%s", e.message);
        return false;
    }
    out->law = law;
    out->constant = constant;
    out->yield = c->yield ? c->yield[k] : (double)INFINITY;
    return true;
}
