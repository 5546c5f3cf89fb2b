// SPDX-License-Identifier: GPL-3.0-or-later
// A motion within a step, from its position, velocity and acceleration at both ends: x = t / h in
// [0, 1] is the place in the step.
#ifndef JOSTLE_HERMITE_H
#define JOSTLE_HERMITE_H

struct motion {
    double d[2], v[2], a[2];  // at the start and at the end
    double h;                 // [T] length of the step
};

// Polynomial in x, lowest power first.
enum { POLYNOMIAL_SIZE = 6 };
struct polynomial {
    double c[POLYNOMIAL_SIZE];
};

// Its value and its slope at x.
double hermite_value(const struct polynomial *p, double x);
double hermite_slope(const struct polynomial *p, double x);

// A zero between low and high, where the values differ in sign (or are zero).
double hermite_root(const struct polynomial *p, double low, double high);

// The zeros in (0, 1) of the slope of a cubic, ascending; returns how many, at most 2.
int hermite_extrema(const struct polynomial *p, double *at);

// The position, a polynomial of degree 5, right to order 6.
struct polynomial hermite_position(const struct motion *m);

// The velocity from velocities and accelerations alone, of degree 3 and order 4: of lower order
// than the slope of the position, but free of its rounding in short steps.
struct polynomial hermite_velocity(const struct motion *m);

// Instants 0 < x < 1 at which the velocity changes its sign, ascending; returns how many.
enum { TURNS_MAX = 3 };
int hermite_turns(const struct motion *m, double *at);

#endif
