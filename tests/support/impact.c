// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/impact.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "support/support.h"

const double pad[PAD_NUMBERS] = {
    0.0, 0.0, 0.0, 1e-5, 0.0, 0.0, 2e-3, 2e5, 2e4, 1e-2, 8e5, 2e5, 2e-2, 4e6, 4e6,
};

const struct contact_law *impact_law(const char *name, const char *parameters, double *value) {
    const struct contact_law *law = contact_law_find(name);
    char key[32];
    int used;
    assert_non_null(law);
    for (int i = 0; i < law->n_row; i++) {
        value[i] = law->row[i].fallback;
    }
    if (contact_law_curve(law) >= 0) {
        value[contact_law_curve(law)] = PAD_POINTS;
        memcpy(value + law->n_row, pad, sizeof pad);
    }
    while (sscanf(parameters, " %31s%n", key, &used) == 1) {
        int row = contact_law_row(law, key);
        assert_true(row >= 0);
        char *end;
        value[row] = strtod(parameters + used, &end);
        assert_true(end > parameters + used);
        parameters = end;
    }
    return law;
}

struct bound_law bound_law(const struct contact_law *law, const double *value, double mass,
                           double v0) {
    struct bound_law b = {.law = law};
    struct error e;
    assert_int_equal(law->prepare(value, mass, b.constant, &e), STATUS_OK);
    if (law->close) {
        law->close(b.constant, v0, b.history);
    }
    return b;
}

struct contact_response bound_at(const struct bound_law *b, double d, double v) {
    return b->law->force(b->constant, b->history, d, v);
}

void bound_commit(struct bound_law *b, double d, double v) {
    if (b->law->commit) {
        b->law->commit(b->constant, b->history, d, v);
    }
}

struct isolated_impact impact_of(const struct contact_law *law, const double *value, double mass,
                                 double velocity) {
    double constant[IMPACT_CONSTANTS_MAX];
    struct isolated_impact impact = {0};
    struct error e = {0};
    if (law->prepare(value, mass, constant, &e) != STATUS_OK ||
        isolated_run(law, constant, mass, velocity, NULL, &impact, &e) != STATUS_OK) {
        fail_msg("%s: %s", law->name, e.message);
    }
    return impact;
}

struct isolated_impact impact_under(const char *law, const char *parameters, double mass,
                                    double velocity) {
    double value[IMPACT_VALUES_MAX];
    return impact_of(impact_law(law, parameters, value), value, mass, velocity);
}
