// SPDX-License-Identifier: GPL-3.0-or-later
// How long a step of Dormand & Prince's method may be, so that no motion grows that ought to decay.
#ifndef JOSTLE_STABILITY_H
#define JOSTLE_STABILITY_H

#include "jostle/model.h"

// What limits the steps of a building.
struct stability {
    double alone;   // [T] longest stable step without links
    double square;  // [1/T^2] of its largest circular frequency
    double decay;   // [1/T] no motion decays faster by its dampers
    double memory;  // [T] in which motions of one floor against the others decay; may be infinite
};

struct stability stability_of(const struct building *g);

// The longest stable step of a building [T] to one floor of which links are fixed whose stiffnesses
// over their effective masses add up to `spring` [1/T^2], their dashpots to `dashpot` [1/T].
double stability_step(const struct stability *s, double spring, double dashpot);

// The largest |z| at which a step of the method multiplies the motion exp(z t / h) of an oscillator
// with this damping ratio by no more than 1.
double stability_limit(double ratio);

#endif
