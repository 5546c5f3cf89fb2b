// SPDX-License-Identifier: GPL-3.0-or-later
// Columns that are struck between two floors (struct struck_column).
#ifndef JOSTLE_STRUCK_COLUMN_H
#define JOSTLE_STRUCK_COLUMN_H

#include <stddef.h>

#include "model/builder.h"

// Adds a column at this level, below this floor. The draft has its name, building, mass, damping
// ratio, law and strengths, and its bending stiffness or its line of the frame. Reports a second
// column at that level, and links that have named the level before.
void struck_column_add(struct builder *b, const struct struck_draft *given, int floor,
                       double level);

// The columns of storeys, of which contacts strike those at levels that they name.
struct struck_storeys {
    struct selection storeys;   // below these floors
    struct struck_draft draft;  // of each of them
    bool struck;                // by some contact
};

// Adds such columns. Reports a storey that has some already.
void struck_column_add_storeys(struct builder *b, const struct struck_storeys *storeys);

// Adds the column that a contact strikes at this level, below this floor, if the storey has columns
// and none of them is at this level already.
void struck_column_strike(struct builder *b, int building, int floor, double level);

// Finds what depends on the stiffness of the column, which is on a line of this frame, or clamped
// in the floors (NULL). False after a report.
struct plane_frame;
bool struck_column_settle(struct builder *b, struct struck_draft *d, const struct plane_frame *f);

// The index of the column of the building at this level; -1: none.
int struck_column_at(const struct builder *b, int building, double level);

struct struck_draft *struck_column_draft(const struct builder *b, int i);

// The number of columns on lines of the frame of this building.
int struck_column_points(const struct builder *b, int building);

// Column `i` of the model: `point` is the degree of freedom of its struck point, and `first` the
// first one of its building.
struct struck_column struck_column_place(struct builder *b, int i, int point, int first);

// The link that is the spring of column i.
static inline int struck_column_spring(const struct model *m, int i) {
    return m->n_link - m->n_column + i;
}

// A force in the column at displacements u (n_dof), and the force of its spring.
static inline double struck_column_force(const struct struck_column *c, enum column_force force,
                                         const double *u, double spring) {
    const double *row = c->force + (ptrdiff_t)force * c->n_dof;
    double sum = 0.0;
    for (int i = 0; i < c->n_dof; i++) {
        sum += row[i] * u[c->dof[i]];
    }
    return sum + c->by_spring[force] * spring;
}

// Where the struck point of a column with a law would be if its spring were elastic and had the
// same force. The forces of the members of a frame follow from this displacement. The point is at
// `w`, and its spring has this deformation, positive in compression.
static inline double struck_column_elastic(const struct struck_column *c, double w,
                                           double deformation, double spring) {
    return w + (deformation - spring / c->stiffness);
}

// The building that a body belongs to: itself, or that of its column. WALL: WALL.
static inline int struck_column_host(const struct model *m, int body) {
    return body < m->n_building ? body : m->column[body - m->n_building].building;
}

// At the end of the deck: appends a body for each struck point to the buildings, and its spring to
// the links.
void struck_column_finish(struct builder *b);

#endif
