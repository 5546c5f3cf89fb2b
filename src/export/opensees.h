// SPDX-License-Identifier: GPL-3.0-or-later
// A model as a script of OpenSees (docs/opensees.md). Every degree of freedom of the model is a
// node that moves in direction 1. Matrices and rows of the model become springs and dashpots
// between these nodes, and frames stand on them with their joints.
#ifndef JOSTLE_EXPORT_OPENSEES_H
#define JOSTLE_EXPORT_OPENSEES_H

#include "export/emit.h"
#include "jostle/model.h"

// The spring that makes a node follow a row of others is this many times as stiff as what it holds.
static const double OPENSEES_STIFF = 1e6;

struct arena;
struct opensees {
    struct emitter to;
    FILE *notes;  // borrowed: what has no counterpart in OpenSees, a line each; NULL: nowhere
    const struct model *m;
    // The last tags that were given.
    int node, element, material, series, region;
    int first_node;       // the first one that is made for the building at work
    const void *told[2];  // the law and the owner of the last note
    struct arena *arena;
};

// Writes the script of the model. Errors: STATUS_SYSTEM (no memory), those of analysis_run, which
// gives the accelerations at t = 0. Write errors are the caller's.
int opensees_write(const struct model *m, enum emit_language language, const char *version,
                   FILE *to, FILE *notes, struct error *e);

// Names what has no counterpart, and what stands in its place, in the script and in the notes.
void opensees_note(struct opensees *x, const char *format, ...)
    __attribute__((format(printf, 2, 3)));

// A node at a place, held in directions 1, 2 and 3. Returns its tag.
int opensees_node(struct opensees *x, double at_x, double at_y, int hold_1, int hold_2, int hold_3);

// The node of a degree of freedom; WALL: one that is at rest.
int opensees_dof(const struct opensees *x, int dof);

enum { OPENSEES_SWAY = 1, OPENSEES_RISE = 2, OPENSEES_TURN = 6 };

// A material between two nodes. `damped`: it has its share of Rayleigh damping.
void opensees_spring(struct opensees *x, int left, int right, int material, int direction,
                     bool damped);

// A spring k and a dashpot c between two nodes, in direction 1; nothing if both are 0.
void opensees_elastic(struct opensees *x, int left, int right, double k, double c, bool damped);

// Springs and dashpots that are the matrices k and c (n, n) over nodes, symmetric; NULL: none.
void opensees_matrix(struct opensees *x, int n, const int *node, const double *k, const double *c,
                     bool damped);

// The matrices k b b' and c b b' of a row b over nodes.
enum { OPENSEES_ROW_MAX = 8 };
void opensees_row(struct opensees *x, int n, const int *node, const double *b, double k, double c);

// A building: nodes, storeys, parts and damping.
void opensees_building(struct opensees *x, const struct building *g);

// Materials; they return their tags. `what` names them in notes.

// A storey law: force over deformation. `owner` is the building it belongs to: a note about a law
// is written once for each.
int material_storey(struct opensees *x, const struct storey_law *law, const double *constant,
                    const char *what, const void *owner);

// Materials side by side, n >= 1: their forces add up.
int material_parallel(struct opensees *x, const int *material, int n);

// The law of a link, a contact or bilateral, as a function of its lengthening.
int material_link(struct opensees *x, const struct link *l);

// A stiffness about as large as that of the law of the link.
double material_link_stiffness(const struct opensees *x, const struct link *l);

// The force at which a storey law leaves its first line to the side `sign`; infinite: nowhere.
double material_yield(const struct opensees *x, const struct storey_law *law,
                      const double *constant, double sign);

// The members of a frame or wall, between their joints and the floors of the building.
struct plane_frame;
void opensees_frame(struct opensees *x, const struct building *g, const struct plane_frame *f);

#endif
