// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/fields.h"

#include <string.h>

#include "core/arena.h"
#include "core/lanes.h"
#include "jostle/model.h"

int fields_actions(const struct model *m) {
    return m->chain.n + lanes_whole(m->n_hinge);
}

// Elements of a field in building k.
static size_t fields_count(const struct fields_row *f, const struct model *m, int k) {
    int n_signal = 0;
    for (int i = 0; i < m->n_ground; i++) {
        n_signal += m->ground[i].n_signal;
    }
    const int n[] = {
        [FIELD_ONE] = 1,
        [FIELD_AT] = 1,
        [FIELD_BUILDINGS] = m->n_body,
        [FIELD_BUILDING_FLOORS] = m->building[k].n_dof,
        [FIELD_BUILDING_TANGENTS] = building_n_tangent(&m->building[k]),
        [FIELD_COLUMNS] = m->n_column,
        [FIELD_FLOORS] = m->n_dof,
        [FIELD_LINKS] = m->n_link,
        [FIELD_GROUNDS] = m->n_ground,
        [FIELD_LOADS] = m->n_load,
        [FIELD_SIGNALS] = n_signal,
        [FIELD_STOREY_HISTORIES] = m->n_storey_history,
        [FIELD_PART_SCRATCH] = m->n_part_scratch,
        [FIELD_PART_TANGENTS] = m->n_part_tangent,
        [FIELD_LINK_HISTORIES] = m->n_link_history,
        [FIELD_FORCES] = m->n_force,
        [FIELD_HINGES] = m->n_hinge,
        [FIELD_ACTIONS] = fields_actions(m),
        [FIELD_FORCE_STATES] = m->n_force > 0 ? fields_actions(m) * FORCES_BATCH : 0,
    };
    return (size_t)n[f->count];
}

// The row of the next of the members that one row stands for.
static struct fields_row fields_next(struct fields_row f) {
    f.offset += f.count == FIELD_ONE ? f.size : sizeof(void *);
    f.more--;
    return f;
}

bool fields_alloc(const struct fields *f, const struct model *m, void *s, struct arena *a) {
    for (int k = 0; k < f->n; k++) {
        for (struct fields_row i = f->row[k]; i.more >= 0; i = fields_next(i)) {
            const size_t n = fields_count(&i, m, 0);
            char *member = (char *)s + i.offset;
            if (i.count >= FIELDS_ALLOCATED) {
                const bool floors = i.count == FIELD_FLOORS && i.size == sizeof(double);
                void *array = floors                   ? lanes_array(a, m->n_dof)
                              : i.count == FIELD_LINKS ? lanes_lines(a, n + LANES_WIDTH, i.size)
                                                       : arena_alloc(a, n, i.size);
                memcpy(member, &array, sizeof array);  // pointers of all types are alike here
            } else if (i.count == FIELD_ONE && i.part) {
                fields_alloc(i.part, m, member, a);
            }
        }
    }
    return !arena_failed(a);
}

// Where the elements of a field are.
static char *fields_elements(const struct fields_row *f, const void *s) {
    const void *member = (const char *)s + f->offset;
    char *elements = (char *)s + f->offset;
    if (f->count != FIELD_ONE) {
        memcpy(&elements, member, sizeof elements);
    }
    return elements;
}

static void fields_copy_of(const struct fields *f, const struct model *m, int building, void *to,
                           const void *from) {
    for (int j = 0; j < f->n; j++) {
        for (struct fields_row i = f->row[j]; i.more >= 0; i = fields_next(i)) {
            const size_t n = fields_count(&i, m, building);
            char *there = fields_elements(&i, to);
            const char *here = fields_elements(&i, from);
            if (!i.part && n > 0 && i.count != FIELD_PART_SCRATCH) {
                memcpy(there, here, n * i.size);
            }
            for (size_t k = 0; i.part && k < n; k++) {
                fields_copy_of(i.part, m, (int)k, there + k * i.size, here + k * i.size);
            }
        }
    }
}

void fields_copy(const struct fields *f, const struct model *m, void *to, const void *from) {
    fields_copy_of(f, m, 0, to, from);
}
