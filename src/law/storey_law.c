// SPDX-License-Identifier: GPL-3.0-or-later
// The table of storey laws.
#include "jostle/storey_law.h"

#include <assert.h>
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
