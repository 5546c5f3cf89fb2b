// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/impact.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "support/support.h"

void impact_values(const struct contact_law *law, const char *parameters, double *value) {
    char key[32];
    int used;
    for (int i = 0; i < law->n_row; i++) {
        value[i] = law->row[i].fallback;
    }
    while (sscanf(parameters, " %31s%n", key, &used) == 1) {
        int row = contact_law_row(law, key);
        assert_true(row >= 0);
        char *end;
        value[row] = strtod(parameters + used, &end);
        assert_true(end > parameters + used);
        parameters = end;
    }
}

struct isolated_impact impact_of(const struct contact_law *law, const double *value, double mass,
                                 double velocity) {
    double constant[CONTACT_CONSTANTS_MAX];
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
    const struct contact_law *found = contact_law_find(law);
    assert_non_null(found);
    double value[CONTACT_ROWS_MAX];
    impact_values(found, parameters, value);
    return impact_of(found, value, mass, velocity);
}
