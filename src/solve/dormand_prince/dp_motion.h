// SPDX-License-Identifier: GPL-3.0-or-later
// The motion within a step of Dormand & Prince's method, from position, velocity and acceleration
// at both its ends: x = t / h in [0, 1] is the place in the step. Hermite interpolation: Hairer,
// Norsett & Wanner (1993), Solving Ordinary Differential Equations I, section II.6.
#ifndef JOSTLE_DP_MOTION_H
#define JOSTLE_DP_MOTION_H

struct dp;

struct motion {
    double d[2], v[2], a[2];  // at the start and at the end
    double h;                 // [T] length of the step
};

// Polynomial in x, lowest power first.
enum { POLYNOMIAL_SIZE = 6 };
struct polynomial {
    double c[POLYNOMIAL_SIZE];
};

// Its value and its slope at x, and a zero between low and high, where the values differ in sign
// (or are zero).
double dp_motion_value(const struct polynomial *p, double x);
double dp_motion_slope(const struct polynomial *p, double x);
double dp_motion_root(struct polynomial p, double low, double high);

// The zeros in (0, 1) of the slope of a cubic, ascending; returns how many, at most 2.
int dp_motion_extrema(const struct polynomial *p, double *at);

// The position, a polynomial of degree 5, right to order 6. The velocity from velocities and
// accelerations alone, of degree 3 and order 4: of lower order than the slope of the position, but
// free of its rounding in short steps.
struct polynomial dp_motion_path(const struct motion *m);
struct polynomial dp_motion_velocity(const struct motion *m);

// Instants 0 < x < 1 at which the velocity changes its sign, ascending; returns how many.
enum { TURNS_MAX = 3 };
int dp_motion_turns(const struct motion *m, double *at);

// The motions of floor i relative to floor `below` (-1: to the ground), and of link k.
struct motion dp_motion_floor(const struct dp *p, int i, int below);
struct motion dp_motion_link(const struct dp *p, int k);

// Ways of link k that mean nothing [L].
double dp_motion_noise(const struct dp *p, int k);

// Upper bounds of the penetrations of contacts, into p->reach, and what follows from them.
void dp_motion_reach(struct dp *p);

// The motion of a building, or of all (DP_ALL), at place x of the step, and its rates there.
// Between steps only: they are made in the second stage, whose weight in the works is 0.
void dp_motion_between(const struct dp *p, double x, int building);
void dp_motion_rates(struct dp *p, double x, int building);

#endif
