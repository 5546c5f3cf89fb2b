// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/method.h"

#include <assert.h>

#define METHOD(descriptor) &descriptor,
static const struct method *const methods[] = {
#include "solve/method_list.inc"
};
#undef METHOD

const struct method *method_of(const struct model *m) {
    size_t i = 0;
    while (methods[i]->integrator != m->integrator || methods[i]->adaptive != m->adaptive) {
        i++;
        assert(i < sizeof methods / sizeof methods[0]);
    }
    return methods[i];
}
