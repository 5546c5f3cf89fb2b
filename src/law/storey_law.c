// SPDX-License-Identifier: GPL-3.0-or-later
// The table of storey laws.
#include "jostle/storey_law.h"

#include <assert.h>
#include <math.h>
#include <string.h>

#include "law/lists.h"
#include "law/yield.h"

const struct range yield_hardening_range = {
    .min = 0.0, .max = 1.0, .max_open = true, .text = ">= 0 and < 1"};
const struct range yield_falling_range = {
    .min = -1.0, .max = 1.0, .max_open = true, .text = ">= -1 and < 1"};

#define STOREY_LAW(descriptor) &descriptor,
const struct storey_law *const storey_laws[] = {
#include "law/storey_list.inc"
};
#undef STOREY_LAW

const int n_storey_law = sizeof storey_laws / sizeof storey_laws[0];

const struct storey_law *storey_law_find(const char *name) {
    assert(name);
    for (int i = 0; i < n_storey_law; i++) {
        if (strcmp(storey_laws[i]->name, name) == 0) {
            return storey_laws[i];
        }
    }
    return NULL;
}

struct storey_figures storey_law_figures(const struct storey_law *law, const double *constant) {
    struct storey_figures f = {
        {INFINITY, INFINITY}, {INFINITY, INFINITY}, {INFINITY, INFINITY}, INFINITY, 0.05};
    if (law->describe) {
        law->describe(constant, &f);
    }
    return f;
}

double storey_law_ductility(const struct storey_figures *f, const double most[2]) {
    return fmax(most[0] / f->yield[0], most[1] / f->yield[1]);
}

double storey_law_damage(const struct storey_figures *f, const double most[2], double energy) {
    double damage = 0.0;
    for (int i = 0; i < 2; i++) {
        const double of_energy = f->beta * fmax(energy, 0.0) / f->strength[i];
        damage = fmax(damage, (most[i] + of_energy) / f->ultimate[i]);
    }
    return damage;
}

int storey_law_prepare(const struct storey_law *law, const double *value, double stiffness,
                       double *constant, struct error *e) {
    if (stiffness == 0.0 && law->describe) {
        return error_set(e, STATUS_INPUT, "a storey of stiffness 0 cannot yield");
    }
    return law->prepare(value, stiffness, constant, e);
}
