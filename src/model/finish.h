// SPDX-License-Identifier: GPL-3.0-or-later
// The stages of builder_finish.
#ifndef JOSTLE_FINISH_H
#define JOSTLE_FINISH_H

#include "model/builder.h"

// Buildings with their modes and damping, floor masses, storeys and initial state.
int finish_buildings(struct builder *b, struct model *m, struct error *e);

// The floors of all buildings as one chain.
void finish_chain(struct builder *b, struct model *m);

// Scales records to their spectral accelerations. Gives each building its ground. Buildings with
// the same ground motions share a ground.
void finish_grounds(struct builder *b, struct model *m, struct building *building);

// True if the ground motion acts below the building.
bool finish_acts_under(const struct ground_draft *g, int building);

// Contacts and bilateral links, loads.
void finish_links(struct builder *b, struct model *m);
void finish_loads(struct builder *b, struct model *m);

// Limits of drift at which runs end.
void finish_collapse(struct builder *b, struct model *m);

// Duration, steps, rows of output, stability of the integrator.
void finish_time(struct builder *b, struct model *m);

// True if all storeys of the building have a stiffness.
bool finish_stands(const struct building *g);

// Warns about magnitudes that come from mixed-up units.
void finish_magnitudes(struct builder *b, const struct model *m);

// Warns about input that is allowed but is probably a mistake: excitation without effect, steps
// that do not resolve it, grounds that move apart, contacts of floors at different levels.
void finish_warnings(struct builder *b, const struct model *m);

// True if a statement gives damping ratios of modes (modal damping).
bool damping_is_modal(const struct building_draft *d);

// Fills damping_diagonal and damping_off, or damping_full, of `building` from the draft. `shape` is
// normalised to phi^T M phi = 1; it may be NULL unless the damping is modal. Reports errors in the
// diagnostics of the deck.
void damping_matrix(struct builder *b, const struct building_draft *d, const double *omega,
                    const double *shape, struct building *building);

#endif
