// SPDX-License-Identifier: GPL-3.0-or-later
// Where within a step a penetration passes through zero.
#ifndef JOSTLE_CROSSING_H
#define JOSTLE_CROSSING_H

// Penetration and velocity at both ends of a step of length h [L] [L/T] [T].
struct path {
    double d0, v0, d1, v1, h;
};

// Time from the start of the step [T] at which the cubic through both ends passes through zero, and
// its velocity there. Needs d0 <= 0 < d1 or d0 >= 0 > d1 (or a zero at either end); from d0 = 0
// there and back it is the second zero.
double crossing_find(const struct path *p, double *velocity);

// For v0 > 0 > v1: time from the start of the step [T] at which the cubic is largest, and how
// large.
double crossing_summit(const struct path *p, double *largest);

#endif
