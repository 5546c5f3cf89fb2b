// SPDX-License-Identifier: GPL-3.0-or-later
// The stages of builder_finish.
#ifndef JOSTLE_FINISH_H
#define JOSTLE_FINISH_H

#include "model/builder.h"

// Buildings with their modes and damping, floor masses, storeys and initial state.
int finish_buildings(struct builder *b, struct model *m, struct error *e);

// The floors of all buildings as one chain.
void finish_chain(struct builder *b, struct model *m);

// Scales records to their spectral accelerations. Which ground motions act under which building;
// buildings with the same ones share a ground.
void finish_grounds(struct builder *b, struct model *m, struct building *building);

// Contacts and bilateral links, loads.
void finish_links(struct builder *b, struct model *m);
void finish_loads(struct builder *b, struct model *m);

// Duration, steps, rows of output, stability of the integrator.
void finish_time(struct builder *b, struct model *m);

// Has the building no storey without stiffness?
bool finish_stands(const struct building *g);

// Warns of magnitudes that come from units that were mixed up.
void finish_magnitudes(struct builder *b, const struct model *m);

// Warns of what is legal but hardly meant: excitation that does nothing, steps that skip it,
// grounds that drift apart, floors that do not face each other.
void finish_warnings(struct builder *b, const struct model *m);

// The damping matrix of a building from what the deck asks for.

// Does a statement give ratios of modes?
bool damping_is_modal(const struct building_draft *d);

// Fills damping_diagonal and damping_off, or damping_full, of `building` from the draft. `shape` is
// normalised to phi^T M phi = 1; it may be NULL unless the damping is modal. Reports in the deck
// what cannot be done.
void damping_matrix(struct builder *b, const struct building_draft *d, const double *omega,
                    const double *shape, struct building *building);

#endif
