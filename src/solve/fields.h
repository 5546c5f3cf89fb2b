// SPDX-License-Identifier: GPL-3.0-or-later
// Lists of the fields of a struct. What a run carries from step to step is described by such lists:
// they allocate its arrays and copy it, so that no field can be forgotten in one of both.
#ifndef JOSTLE_FIELDS_H
#define JOSTLE_FIELDS_H

#include <stdbool.h>
#include <stddef.h>

struct arena;
struct model;

// The actions that forces follow from, in whole lanes: drifts, then departures of hinges.
int fields_actions(const struct model *m);

// States whose forces are looked at together (account/force_peaks.c).
enum { FORCES_BATCH = 32 };

// How many elements a field has. The list allocates arrays from FIELDS_ALLOCATED on.
enum field_count {
    FIELD_ONE,                // it is in the struct itself
    FIELD_AT,                 // one, behind a pointer
    FIELD_BUILDINGS,          // structs behind a pointer
    FIELD_BUILDING_FLOORS,    // (n_dof) of one of them
    FIELD_BUILDING_TANGENTS,  // of its storeys (n_dof), and of its parts by drifts and by rates,
                              // each (n_dof, n_dof), or (n_dof) where matrices are not full
    FIELDS_ALLOCATED,
    FIELD_FLOORS = FIELDS_ALLOCATED,  // (n_dof) an array of core/lanes.h
    FIELD_LINKS,                      // (n_link) from the start of a line of the cache, whole lanes
    FIELD_COLUMNS,                    // (n_column)
    FIELD_GROUNDS,
    FIELD_LOADS,
    FIELD_SIGNALS,           // of all grounds
    FIELD_STOREY_HISTORIES,  // (model.n_storey_history)
    FIELD_PART_SCRATCH,      // (model.n_part_scratch), which is not copied
    FIELD_PART_TANGENTS,     // (model.n_part_tangent)
    FIELD_LINK_HISTORIES,    // (model.n_link_history)
    FIELD_FORCES,            // (model.n_force)
    FIELD_HINGES,            // (model.n_hinge)
    FIELD_ACTIONS,           // (fields_actions)
    FIELD_FORCE_STATES,      // (FORCES_BATCH, fields_actions) if the model has forces
};

struct fields;

struct fields_row {
    size_t offset;  // in the struct
    size_t size;    // [bytes] of an element
    enum field_count count;
    const struct fields *part;  // the list of its own fields; NULL: all of it
    int more;                   // such members behind it, where the struct has an array of them
};

struct fields {
    const struct fields_row *row;
    int n;
};

// Rows of a list for struct S: a value in it, or all from the first to the last of some; arrays
// behind a pointer, and structs with a list. The members of the last two macros are arrays in S, of
// pointers to arrays and of structs with a list.
#define FIELD_VALUE(S, member)                                                                     \
    { offsetof(S, member), sizeof((S *)0)->member, FIELD_ONE, NULL, 0 }
#define FIELD_VALUES(S, first, last)                                                               \
    { offsetof(S, first), FIELDS_END(S, last) - offsetof(S, first), FIELD_ONE, NULL, 0 }
#define FIELD_ARRAY(S, member, count)                                                              \
    { offsetof(S, member), sizeof *((S *)0)->member, count, NULL, 0 }
#define FIELD_PART(S, member, list)                                                                \
    { offsetof(S, member), sizeof((S *)0)->member, FIELD_ONE, &(list), 0 }
#define FIELD_PARTS(S, member, count, list)                                                        \
    { offsetof(S, member), sizeof *((S *)0)->member, count, &(list), 0 }
#define FIELD_ARRAYS(S, member, count)                                                             \
    { offsetof(S, member), sizeof **((S *)0)->member, count, NULL, FIELDS_MORE(S, member) }
#define FIELD_EACH_PART(S, member, list)                                                           \
    { offsetof(S, member), sizeof *((S *)0)->member, FIELD_ONE, &(list), FIELDS_MORE(S, member) }
#define FIELDS_END(S, member) (offsetof(S, member) + sizeof((S *)0)->member)
#define FIELDS_MORE(S, member) (sizeof((S *)0)->member / sizeof *((S *)0)->member - 1)
#define FIELDS(array)                                                                              \
    { array, sizeof(array) / sizeof(array)[0] }

// Allocates the arrays of `s`, and of its parts in it; false: no memory.
bool fields_alloc(const struct fields *f, const struct model *m, void *s, struct arena *a);

// Copies `from` to `to`, which has room for it.
void fields_copy(const struct fields *f, const struct model *m, void *to, const void *from);

#endif
