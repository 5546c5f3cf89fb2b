// SPDX-License-Identifier: GPL-3.0-or-later
// Columns that are struck between two floors (struct struck_column).
#ifndef JOSTLE_STRUCK_COLUMN_H
#define JOSTLE_STRUCK_COLUMN_H

#include "model/builder.h"

// Adds the column: its name, place, mass and bending stiffness are given, the rest is found here.
// `damping` is the damping ratio of the struck point. Reports a second column at that level, and
// links that have named the level before.
// `choice` has the law of one column, taken for one law; NULL: the column is elastic.
struct storey_choice;
void struck_column_add(struct builder *b, const struct struck_column *column, double damping,
                       const struct storey_choice *choice, const struct word *w);

// The index of the column of the building at this level; -1: none.
int struck_column_at(const struct builder *b, int building, double level);

struct struck_draft *struck_column_draft(const struct builder *b, int i);

// Sets what depends on the place of the column among the degrees of freedom, of which `point` is
// its struck point, and `first` the first floor of its building.
void struck_column_place(struct struck_column *c, int point, int first);

// A force in the column at displacements u (n_dof), and the force of its spring.
static inline double struck_column_force(const struct struck_column *c, enum column_force force,
                                         const double *u, double spring) {
    const double *row = c->force[force];
    const double below = c->dof[2] == WALL ? 0.0 : u[c->dof[2]];
    return row[0] * u[c->dof[0]] + row[1] * u[c->dof[1]] + row[2] * below +
           c->by_spring[force] * spring;
}

// The building that a body belongs to: itself, or that of its column. WALL: WALL.
static inline int struck_column_host(const struct model *m, int body) {
    return body < m->n_building ? body : m->column[body - m->n_building].building;
}

// At the end of the deck: appends a body for each struck point to the buildings, and its spring to
// the links.
void struck_column_finish(struct builder *b);

#endif
