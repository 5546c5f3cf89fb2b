// SPDX-License-Identifier: GPL-3.0-or-later
// What storeys and hinges that yield have gone through: energies, ductilities, and how far they
// have deteriorated.
//
// The work on a storey without parts beside it is in the account of energy, and its largest drift
// is among the peaks. Only laws of which this does not say enough are noted step by step: those in
// buildings with parts, whose works follow from the trapezoidal rule, and those of storeys whose
// yields differ in both directions.
#ifndef JOSTLE_YIELDING_H
#define JOSTLE_YIELDING_H

#include "solve/account/energy.h"

// A law that is noted: of a storey, or of a hinge.
struct yielding_law {
    const struct storey *storey;
    const struct building *building;
    int history;       // offset in the state's storey history
    int dof;           // of the floor above the storey; of a hinge: -1,
    int hinge;         // and its number among those of all buildings
    double stiffness;  // [F L] initial, of a hinge
};

struct yielding {
    const struct model *model;
    int n;                           // laws
    const struct yielding_law *law;  // (n)
    double *deformation, *force;     // (n) at the last state
    double *work_2x;                 // (n) twice the work so far
    double *most[2];                 // (n) largest deformation to the right, and to the left
    double *stored;                  // (n) [F L] at the start
};
extern const struct fields yielding_fields;

// Do the yields of a storey differ in both directions?
bool yielding_differs(const struct storey *s);

// Finds the laws of the model; its fields are allocated with those of force_peaks. False: no
// memory.
bool yielding_alloc(struct yielding *y, const struct model *m, struct arena *a);

// Takes the state at t = 0, and a state to which a step has led.
void yielding_start(struct yielding *y, const struct state *s);
void yielding_note(struct yielding *y, const struct state *s);

// Sets what the results say of storeys and hinges in the last state, when their peaks are final.
void yielding_finish(struct yielding *y, const struct energy_account *energy, const struct state *s,
                     struct results *r);

#endif
