// SPDX-License-Identifier: GPL-3.0-or-later
// The table of contact laws.
#include "jostle/contact_law.h"

#include <assert.h>
#include <string.h>

#include "law/lists.h"
#include "law/power.h"

const struct range power_range = {.min = 1.0, .max = 3.0, .text = ">= 1 and <= 3"};

#define CONTACT_LAW(descriptor) &descriptor,
const struct contact_law *const contact_laws[] = {
#include "law/contact_list.inc"
};
#undef CONTACT_LAW

const int n_contact_law = sizeof contact_laws / sizeof contact_laws[0];

const struct contact_law *contact_law_find(const char *name) {
    assert(name);
    for (int i = 0; i < n_contact_law; i++) {
        if (strcmp(contact_laws[i]->name, name) == 0) {
            return contact_laws[i];
        }
    }
    return NULL;
}

int contact_law_row(const struct contact_law *law, const char *key) {
    assert(law && key);
    return row_find(law->row, law->n_row, key);
}

int contact_law_curve(const struct contact_law *law) {
    for (int i = 0; i < law->n_row; i++) {
        if (law->row[i].kind == ROW_FILE) {
            return i;
        }
    }
    return -1;
}

// The number of values of the curve.
static int n_curve(const struct contact_law *law, const double *value) {
    int row = contact_law_curve(law);
    assert(row < 0 || value);
    return row >= 0 ? CURVE_COLUMNS * (int)value[row] : 0;
}

int contact_law_n_value(const struct contact_law *law, const double *value) {
    assert(law);
    return law->n_row + n_curve(law, value);
}

int contact_law_n_constant(const struct contact_law *law, const double *value) {
    assert(law);
    return law->n_constant + n_curve(law, value);
}
