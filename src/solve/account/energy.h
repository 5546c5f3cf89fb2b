// SPDX-License-Identifier: GPL-3.0-or-later
// The account of energy: works since t = 0, and what a state holds.
#ifndef JOSTLE_ENERGY_H
#define JOSTLE_ENERGY_H

#include "solve/event/impulse.h"

// Works since t = 0 [F L], each the sum over steps of a mean force times a displacement.
struct energy_account {
    double initial;  // kinetic, strain and contact energy at t = 0
    // Twice the work of external and damping forces: floor i of the chain adds to element i %
    // LANES_WIDTH, and in a step the lower floor first.
    double input_2x[LANES_WIDTH], damping_2x[LANES_WIDTH];
    double input, damping;  // other work: of links on the grounds, and of Dormand & Prince's steps
    double contact;
    double storey;        // work on storeys that are not elastic, beyond that of the arrays
    double stored_start;  // their recoverable energy at t = 0
    double *storey_2x;    // (n_dof) twice the work on storeys, where some are not elastic
    double *storey_own;   // (n_dof) work on storeys in steps of Dormand & Prince
};
extern const struct fields energy_fields;

// Energies of the start state. That of closed links, which is both initial energy and work done on
// them, also goes to each link's own in `link` (n_link). Errors: STATUS_SYSTEM (no memory).
int energy_start(struct energy_account *a, const struct model *m, const struct state *s,
                 struct link_peak *link, struct error *e);

// Adds the losses of rigid contacts that met at the instant of `s`. `meeting` is (n_contact).
void energy_meet(struct energy_account *a, const struct model *m, const struct state *s,
                 const struct meeting *meeting);

// What the account needs of a state: sums over all floors.
struct energy_sums {
    double kinetic;               // [F L]
    double elastic, other;        // [F L] stored in elastic storeys, and in others
    double storey;                // [F L] work so far on those, but for
    double damped;                // [F L] that of viscous forces of parts
    double input_2x, damping_2x;  // [F L] twice the work of external and damping forces so far
};

struct energy_sums energy_sums_of(const struct energy_account *a, const struct model *m,
                                  const struct state *s);

// The account with the sums of a state, into energy (ENERGY_COUNT).
void energy_close(const struct energy_account *a, const struct energy_sums *sums, double *energy);

#endif
