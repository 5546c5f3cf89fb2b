// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/fields.h"

#include <string.h>

#include "core/arena.h"
#include "core/lanes.h"
#include "jostle/model.h"

// Elements of a field in building k.
static size_t count_of(const struct fields_row *f, const struct model *m, int k) {
    size_t n = 0;
    switch (f->count) {
        case FIELD_ONE:
        case FIELD_AT:
            return 1;
        case FIELD_FLOORS:
            return (size_t)m->n_dof;
        case FIELD_LINKS:
            return (size_t)m->n_link;
        case FIELD_GROUNDS:
            return (size_t)m->n_ground;
        case FIELD_LOADS:
            return (size_t)m->n_load;
        case FIELD_SIGNALS:
            for (int i = 0; i < m->n_ground; i++) {
                n += (size_t)m->ground[i].n_signal;
            }
            return n;
        case FIELD_BUILDINGS:
            return (size_t)m->n_building;
        case FIELD_BUILDING_FLOORS:
            return (size_t)m->building[k].n_floor;
        case FIELD_STOREY_HISTORIES:
            return (size_t)m->n_storey_history;
        case FIELD_LINK_HISTORIES:
            return (size_t)m->n_link_history;
    }
    return n;
}

static void *array_of(const struct fields_row *f, const struct model *m, struct arena *a) {
    size_t n = count_of(f, m, 0);
    if (f->count == FIELD_FLOORS && f->size == sizeof(double)) {
        return lanes_array(a, m->n_dof);
    }
    return f->count == FIELD_LINKS ? lanes_lines(a, n + LANES_WIDTH, f->size)
                                   : arena_alloc(a, n, f->size);
}

static bool is_allocated(const struct fields_row *f) {
    return f->count != FIELD_ONE && f->count != FIELD_AT && f->count != FIELD_BUILDINGS &&
           f->count != FIELD_BUILDING_FLOORS;
}

bool fields_alloc(const struct fields *f, const struct model *m, void *s, struct arena *a) {
    for (const struct fields_row *i = f->row; i < f->row + f->n; i++) {
        char *member = (char *)s + i->offset;
        if (is_allocated(i)) {
            void *array = array_of(i, m, a);
            memcpy(member, &array, sizeof array);  // pointers of all types are alike here
        } else if (i->count == FIELD_ONE && i->part) {
            fields_alloc(i->part, m, member, a);
        }
    }
    return !arena_failed(a);
}

// Where the elements of a field are.
static void *elements_of(const struct fields_row *f, const void *s) {
    char *member = (char *)s + f->offset;
    if (f->count == FIELD_ONE) {
        return member;
    }
    void *array;
    memcpy(&array, member, sizeof array);
    return array;
}

static void copy(const struct fields *f, const struct model *m, int building, void *to,
                 const void *from) {
    for (const struct fields_row *i = f->row; i < f->row + f->n; i++) {
        const size_t n = count_of(i, m, building);
        char *there = elements_of(i, to);
        const char *here = elements_of(i, from);
        if (!i->part && n > 0) {
            memcpy(there, here, n * i->size);
        }
        for (size_t k = 0; i->part && k < n; k++) {
            copy(i->part, m, (int)k, there + k * i->size, here + k * i->size);
        }
    }
}

void fields_copy(const struct fields *f, const struct model *m, void *to, const void *from) {
    copy(f, m, 0, to, from);
}
