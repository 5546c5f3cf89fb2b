// SPDX-License-Identifier: GPL-3.0-or-later
#include "model/law_choice.h"

#include "core/arena.h"

const struct row law_choice_rows[LAW_CHOICE_ROWS] = {
    [LAW_CHOICE_CALIBRATE] = {"calibrate",
                              ROW_FLAG,
                              0,
                              {0},
                              NULL,
                              NAN,
                              "replace the published damping by that which delivers -e exactly"},
};

// A zeroed array from the deck's arena; NULL after having noted that there is no memory.
static void *array(struct deck *d, size_t n, size_t size) {
    void *a = arena_alloc(d->arena, n, size);
    if (!a) {
        diagnostics_no_memory(&d->diagnostics);
    }
    return a;
}

const struct contact_law *law_choice_find(struct deck *d, const struct word *name) {
    const char *text = deck_text(d, name);
    const struct contact_law *law = text ? contact_law_find(text) : NULL;
    const char **known = text && !law ? array(d, (size_t)n_contact_law, sizeof *known) : NULL;
    for (int i = 0; known && i < n_contact_law; i++) {
        known[i] = contact_laws[i]->name;
    }
    if (known) {
        deck_unknown(d, name, "contact law", known, n_contact_law);
    }
    return law;
}

// Puts the damping that delivers -e exactly in place of -e. A rigid impact delivers it as it is.
static bool calibrate(struct deck *d, const struct word *flag, struct law_choice *c) {
    if (c->law->rebound) {
        c->calibrated = true;
        return true;
    }
    if (!c->law->exact) {
        deck_error(d, flag, "contact law %s takes no -e that could be calibrated", c->law->name);
        return false;
    }
    struct argument *restitution = &c->given[contact_law_row(c->law, "e")];
    if (!restitution->given) {
        deck_error(d, flag, "-calibrate needs -e: coefficient of restitution to deliver");
        return false;
    }
    double *zeta = array(d, 1, sizeof *zeta);
    if (!zeta) {
        return false;
    }
    *zeta = c->law->exact(restitution->number[0]);
    if (isnan(*zeta)) {
        deck_error(d, &restitution->word[0], "no damping is found with which %s delivers e = %.6g",
                   c->law->name, restitution->number[0]);
        return false;
    }
    restitution->n = 0;
    struct argument *damping = &c->given[contact_law_row(c->law, "zeta")];
    damping->number = zeta;
    damping->n = 1;
    c->calibrated = true;
    return true;
}

bool law_choice_read(struct deck *d, const struct statement *s, const struct contact_law *law,
                     const struct word *name, const struct row_set *own, struct law_choice *out) {
    *out = (struct law_choice){.law = law, .word = name};
    struct argument common[LAW_CHOICE_ROWS] = {0};
    struct row_set set[] = {
        *own, {law_choice_rows, LAW_CHOICE_ROWS, common}, {law->row, law->n_row, out->given}};
    if (!deck_options(d, s, set, 3)) {
        return false;
    }
    const struct argument *flag = &common[LAW_CHOICE_CALIBRATE];
    return !flag->given || calibrate(d, &flag->key, out);
}

bool law_choice_prepare(struct deck *d, const struct law_choice *c, double mass,
                        const double **value, const double **constant) {
    const struct contact_law *law = c->law;
    double *v = array(d, (size_t)law->n_row, sizeof *v);
    double *k = array(d, (size_t)law->n_constant, sizeof *k);
    if (!v || !k) {
        return false;
    }
    for (int r = 0; r < law->n_row; r++) {
        v[r] = c->given[r].n > 0 ? c->given[r].number[0] : NAN;
    }
    struct error e;
    if (law->prepare(v, mass, k, &e) != STATUS_OK) {
        deck_error(d, c->word, "%s", e.message);
        return false;
    }
    *value = v;
    *constant = k;
    return true;
}
