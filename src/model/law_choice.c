// SPDX-License-Identifier: GPL-3.0-or-later
// Reads the options of a contact law, and computes its constants.
#include "model/law_choice.h"

#include <assert.h>
#include <string.h>

#include "motion/curve_file.h"

const struct row law_choice_rows[LAW_CHOICE_ROWS] = {
    [LAW_CHOICE_CALIBRATE] = {"calibrate", ROW_FLAG, 0, OF_NONE, NULL, NAN,
                              "damping that delivers -e exactly, instead of the published damping"},
    [LAW_CHOICE_K_FROM] = {"k-from", ROW_TEXT, 0, OF_NONE, NULL, NAN,
                           "hertz or slab: -k from the dimensions and moduli of the bodies"},
};

const struct contact_law *law_choice_find(struct deck *d, const struct word *name) {
    const char *text = deck_text(d, name);
    const struct contact_law *law = text ? contact_law_find(text) : NULL;
    const char **known = text && !law ? deck_array(d, (size_t)n_contact_law, sizeof *known) : NULL;
    for (int i = 0; known && i < n_contact_law; i++) {
        known[i] = contact_laws[i]->name;
    }
    if (known) {
        deck_unknown(d, name, text, "contact law", known, n_contact_law);
    }
    return law;
}

// Replaces -e by the damping that delivers it exactly, if this damping depends on e only.
static bool calibrate_now(struct deck *d, struct law_choice *c) {
    struct argument *restitution = &c->given[contact_law_row(c->law, "e")];
    double *zeta = deck_array(d, 1, sizeof *zeta);
    if (!zeta) {
        return false;
    }
    *zeta = c->law->exact(restitution->number[0]);
    if (isnan(*zeta)) {
        return deck_error(d, &restitution->word[0],
                          "no damping is found with which %s delivers e = %.6g", c->law->name,
                          restitution->number[0]);
    }
    restitution->n = 0;
    struct argument *damping = &c->given[contact_law_row(c->law, "zeta")];
    damping->number = zeta;
    damping->n = 1;
    return true;
}

// Handles -calibrate. If the damping depends on the mass, too, law_choice_prepare computes it.
static bool calibrate(struct deck *d, const struct word *flag, struct law_choice *c) {
    bool exact = c->law->traits & CONTACT_EXACT;
    if (!exact && !c->law->exact && !c->law->calibrate) {
        return deck_error(d, flag, "contact law %s takes no -e that could be calibrated",
                          c->law->name);
    }
    if (isnan(c->restitution)) {
        return deck_error(d, flag, "-calibrate needs -e: coefficient of restitution to deliver");
    }
    c->calibrated = true;
    return !c->law->exact || calibrate_now(d, c);
}

// The row of the stiffness of a law; -1: the law has none.
static int stiffness_row(const struct contact_law *law) {
    int row = contact_law_row(law, "k");
    return row >= 0 ? row : contact_law_row(law, "kh");
}

// The estimate that -k-from names; NULL without one, or after a report, when *good is false.
static const struct stiffness_estimate *find_estimate(struct deck *d, const struct statement *s,
                                                      const struct contact_law *law, bool *good) {
    int n;
    const struct word *name = deck_option(s, law_choice_rows[LAW_CHOICE_K_FROM].key, &n);
    if (!name || n == 0) {
        return NULL;
    }
    const struct stiffness_estimate *estimate = stiffness_estimate_find(d, name);
    *good = estimate;
    if (estimate && stiffness_row(law) < 0) {
        deck_error(d, name, "contact law %s has no -k that could be estimated", law->name);
        *good = false;
    }
    return estimate;
}

double law_choice_power(const struct law_choice *c) {
    for (int r = 0; r < c->law->n_row; r++) {
        if (c->law->row[r].flags & ROW_POWER) {
            return c->given[r].number[0];
        }
    }
    return 0.0;
}

// Sets -k to the estimated stiffness; false after a report.
static bool estimate_stiffness(struct deck *d, const struct word *word, struct law_choice *c,
                               const struct stiffness_estimate *estimate,
                               const struct argument *given) {
    int row = stiffness_row(c->law);
    struct dimension dimension = row_dimension(&c->law->row[row], law_choice_power(c));
    if (c->given[row].given) {
        return deck_error(d, &c->given[row].key, "-%s and -k-from cannot be combined",
                          c->law->row[row].key);
    }
    if (!dimension_equal(dimension, estimate->dimension)) {
        char has[64];
        char needs[64];
        unit_text(&d->units, estimate->dimension, has, sizeof has);
        unit_text(&d->units, dimension, needs, sizeof needs);
        return deck_error(d, word, "the stiffness from %s is in %s; -%s of %s is in %s",
                          estimate->name, has, c->law->row[row].key, c->law->name, needs);
    }
    double *number = deck_array(d, 1, sizeof *number);
    if (!number) {
        return false;
    }
    *number = estimate->stiffness(given);
    c->given[row] = (struct argument){.given = true, .key = *word, .n = 1, .number = number};
    return true;
}

// Reads -units: the units of penetration and force in the file of a curve, in either order.
static bool read_units(struct deck *d, const struct argument *a, struct curve_request *request) {
    struct deck_quote quote;
    for (int i = 0; i < a->n; i++) {
        const char *end;
        struct dimension dimension;
        if (strchr(a->text[i], ' ')) {
            return deck_error(d, &a->word[i], "%s is one word; the units are two: -units mm kN",
                              deck_quote(&quote, &a->word[i], a->text[i]));
        }
        double si;
        bool whole = unit_parse(a->text[i], d->units.gravity, &end, &dimension, &si) && !*end;
        bool force = whole && dimension_equal(dimension, dimension_force);
        double *size = force ? &request->force : &request->length;
        if (!whole || (!force && !dimension_equal(dimension, dimension_length)) || *size > 0.0) {
            return deck_error(
                d, &a->word[i],
                "%s is not expected; a unit of penetration and one of force are, such as "
                "mm kN",
                deck_quote(&quote, &a->word[i], a->text[i]));
        }
        *size = si;
    }
    return true;
}

static bool read_curve(struct deck *d, struct law_choice *c) {
    int row = contact_law_curve(c->law);
    int units = contact_law_row(c->law, "units");
    struct curve_request request = {.units = &d->units};
    if (row < 0) {
        return true;
    }
    if (units >= 0 && !read_units(d, &c->given[units], &request)) {
        return false;
    }
    const struct argument *file = &c->given[row];
    request.path = deck_file(d, &file->word[0], file->text[0]);
    struct error e;
    if (request.path && curve_read(d->arena, &request, &c->curve, &e) != STATUS_OK) {
        deck_error_of(d, &file->word[0], &e);
        return false;
    }
    return request.path;
}

bool law_choice_read(struct deck *d, const struct statement *s, const struct contact_law *law,
                     const struct word *name, const struct row_set *own, struct law_choice *out) {
    *out = (struct law_choice){.law = law, .word = name, .restitution = NAN};
    bool good = true;
    const struct stiffness_estimate *estimate = find_estimate(d, s, law, &good);
    if (!good) {
        return false;
    }
    struct row row[CONTACT_ROWS_MAX];
    memcpy(row, law->row, (size_t)law->n_row * sizeof *row);
    if (estimate) {
        row[stiffness_row(law)].flags &= ~(unsigned)ROW_REQUIRED;
    }
    struct argument common[LAW_CHOICE_ROWS] = {0};
    struct argument body[STIFFNESS_ROWS_MAX] = {0};
    struct row_set set[] = {
        *own,
        {law_choice_rows, LAW_CHOICE_ROWS, common},
        {row, law->n_row, out->given},
        {estimate ? estimate->row : NULL, estimate ? estimate->n_row : 0, body}};
    if (!deck_options(d, s, set, 4) || !read_curve(d, out)) {
        return false;
    }
    int e = contact_law_row(law, "e");
    if (e >= 0 && out->given[e].n > 0) {
        out->restitution = out->given[e].number[0];
    }
    if (estimate && !estimate_stiffness(d, &common[LAW_CHOICE_K_FROM].key, out, estimate, body)) {
        return false;
    }
    const struct argument *flag = &common[LAW_CHOICE_CALIBRATE];
    return !flag->given || calibrate(d, &flag->key, out);
}

bool law_choice_prepare(struct deck *d, const struct law_choice *c, double mass,
                        const double **value, const double **constant) {
    assert(c->law && mass >= 0.0 && value && constant);
    const struct contact_law *law = c->law;
    // The values of the rows followed by the curve.
    int n_row = c->law->n_row;
    size_t n_point = (size_t)c->curve.n * CURVE_COLUMNS;
    double *v = deck_array(d, (size_t)n_row + n_point, sizeof *v);
    for (int r = 0; v && r < n_row; r++) {
        bool number = c->given[r].n > 0 && c->given[r].number;
        v[r] = number ? c->given[r].number[0] : NAN;
    }
    if (v && n_point > 0) {
        v[contact_law_curve(c->law)] = c->curve.n;
        memcpy(v + n_row, c->curve.point, n_point * sizeof *v);
    }
    double *k = v ? deck_array(d, (size_t)contact_law_n_constant(law, v), sizeof *k) : NULL;
    if (!k) {
        return false;
    }
    struct error e;
    bool later = c->calibrated && law->calibrate;
    if ((later && law->calibrate(v, mass, &e) != STATUS_OK) ||
        law->prepare(v, mass, k, &e) != STATUS_OK) {
        return deck_error(d, c->word, "%s", e.message);
    }
    *value = v;
    *constant = k;
    return true;
}
