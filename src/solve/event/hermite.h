// SPDX-License-Identifier: GPL-3.0-or-later
// Hermite interpolation within a step (Hairer, Norsett & Wanner (1993), Solving Ordinary
// Differential Equations I, section II.6): polynomials in x = t / h in [0, 1], the place in a step
// of length h, and where they are zero or turn.
#ifndef JOSTLE_HERMITE_H
#define JOSTLE_HERMITE_H

// Lowest power first.
enum { POLYNOMIAL_SIZE = 6 };
struct polynomial {
    double c[POLYNOMIAL_SIZE];
};

// Its value, its slope and its second derivative at x.
static inline double hermite_value(const struct polynomial *p, double x) {
    const double *c = p->c;
    return c[0] + x * (c[1] + x * (c[2] + x * (c[3] + x * (c[4] + x * c[5]))));
}

static inline double hermite_slope(const struct polynomial *p, double x) {
    const double *c = p->c;
    return c[1] + x * (2.0 * c[2] + x * (3.0 * c[3] + x * (4.0 * c[4] + x * 5.0 * c[5])));
}

static inline double hermite_bend(const struct polynomial *p, double x) {
    const double *c = p->c;
    return 2.0 * c[2] + x * (6.0 * c[3] + x * (12.0 * c[4] + x * 20.0 * c[5]));
}

// The cubic from the values y and the slopes s at both ends.
static inline struct polynomial hermite_cubic(double y0, double s0, double y1, double s1) {
    const double rise = y1 - y0;
    return (struct polynomial){
        {y0, s0, 3.0 * rise - 2.0 * s0 - s1, s0 + s1 - 2.0 * rise, 0.0, 0.0}};
}

// A zero between low and high, where the values differ in sign (or are zero).
double hermite_root(struct polynomial p, double low, double high);

// The zeros in (0, 1) of the slope of a cubic, ascending; returns how many, at most 2.
int hermite_extrema(const struct polynomial *p, double *at);

// A motion in a step: displacement, velocity and acceleration at its start and at its end.
struct motion {
    double d[2], v[2], a[2];
    double h;  // [T] length of the step
};

// The displacement, of degree 5, right to order 6.
static inline struct polynomial hermite_path(const struct motion *m) {
    double c1 = m->h * m->v[0];
    double c2 = m->h * m->h * m->a[0] / 2.0;
    double rise = m->d[1] - m->d[0] - c1 - c2;
    double slope = m->h * m->v[1] - c1 - 2.0 * c2;
    double bend = m->h * m->h * m->a[1] - 2.0 * c2;
    return (struct polynomial){{m->d[0], c1, c2, 10.0 * rise - 4.0 * slope + bend / 2.0,
                                -15.0 * rise + 7.0 * slope - bend,
                                6.0 * rise - 3.0 * slope + bend / 2.0}};
}

// The velocity from velocities and accelerations alone, of degree 3 and order 4: of lower order
// than the slope of the path, but free of its rounding in short steps.
static inline struct polynomial hermite_velocity(const struct motion *m) {
    return hermite_cubic(m->v[0], m->h * m->a[0], m->v[1], m->h * m->a[1]);
}

// A motion cut at the instants at which its velocity changes its sign: monotone pieces.
enum { TURNS_MAX = 3 };
struct motion_pieces {
    struct polynomial path;
    int n;
    double x[TURNS_MAX + 2], d[TURNS_MAX + 2];  // (n + 1) ends of the pieces
};
struct motion_pieces hermite_cut(const struct motion *m);

// The ends of a step of Newmark's method, of length h: penetrations and velocities [L] [L/T] [T].
// Its path within the step is the cubic through both ends, whose velocity is right to third order.
struct path {
    double d0, v0, d1, v1, h;
};

// Time from the start of the step [T] at which the path passes through zero, and the velocity
// there. Needs d0 <= 0 < d1 or d0 >= 0 > d1 (or a zero at either end); from d0 = 0 there and back
// it is the second zero.
double hermite_crossing(const struct path *p, double *velocity);

// For v0 > 0 > v1: time from the start of the step [T] at which the path is highest, and how high.
double hermite_summit(const struct path *p, double *highest);

#endif
