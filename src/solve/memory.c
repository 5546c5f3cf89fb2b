// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/memory.h"

#include <string.h>

static const struct fields_row list[] = {
    FIELD_ARRAY(struct memory, tangent, FIELD_FLOORS),
    FIELD_ARRAY(struct memory, resolved, FIELD_LINKS),
    FIELD_VALUE(struct memory, unresolved),
};
const struct fields memory_fields = FIELDS(list);

bool memory_alloc(struct memory *s, const struct model *m, struct arena *a) {
    s->unresolved = -1;
    if (!fields_alloc(&memory_fields, m, s, a)) {
        return false;
    }
    memcpy(s->tangent, m->chain.stiffness, (size_t)m->n_dof * sizeof *s->tangent);
    return true;
}
