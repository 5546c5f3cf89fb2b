// SPDX-License-Identifier: GPL-3.0-or-later
// The longest stable step of Dormand & Prince's method: no motion that decays in the model may
// grow.
#ifndef JOSTLE_STABILITY_H
#define JOSTLE_STABILITY_H

#include "jostle/model.h"

// The properties of a building that limit its steps.
struct stability {
    double alone;   // [T] longest stable step without links
    double square;  // [1/T^2] square of the largest circular frequency
    double decay;   // [1/T] upper bound of the rates of decay by dampers
    double memory;  // [T] time in which motions of single floors decay; may be infinite
};

struct stability stability_of(const struct building *g);

// The longest stable step of a building with links [T]. `spring` [1/T^2] and `dashpot` [1/T] are
// sums over the links of one floor: of their stiffnesses, and of their dashpots, each divided by
// the effective mass.
double stability_step(const struct stability *s, double spring, double dashpot);

// The largest stable |z|: a step of the method multiplies the motion exp(z t / h) of an oscillator
// with this damping ratio by at most 1.
double stability_limit(double ratio);

#endif
