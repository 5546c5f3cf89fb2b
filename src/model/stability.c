// SPDX-License-Identifier: GPL-3.0-or-later
// The longest stable step of Dormand & Prince's method. A step h multiplies a motion exp(z t / h)
// by
//     R(z) = 1 + z + z^2/2 + z^3/6 + z^4/24 + z^5/120 + z^6/600,
// and is stable if |R| <= 1: Hairer & Wanner (1996), Solving Ordinary Differential Equations II,
// section IV.2. Without damping z = i y, and
//     |R|^2 = 1 - y^6 (1/1800 - y^2/1600 + y^4/14400 - y^6/360000) <= 1 up to y = 0.997;
// With 1 % of the critical damping the limit of |z| is 1.87, with 5 % it is 2.40. For a decay
// without oscillation, z < 0, it is 3.307.
//
// A motion phi exp(lambda t) of the whole system, phi complex, satisfies
//     m lambda^2 + c lambda + k = 0,   m = phi* M phi,  c = phi* C phi,  k = phi* K phi,
// which are real and not negative. So either |lambda| = sqrt(k / m), or lambda is real and |lambda|
// <= c / m. So bounds of k / m and c / m are bounds of the rates of all motions:
//   - Link e between floors i and j adds k_e |phi_i - phi_j|^2 to k, and with its effective mass
//     m_e, 1 / m_e = 1 / m_i + 1 / m_j, that is by the inequality of Cauchy and Schwarz no more
//     than (k_e / m_e) (m_i |phi_i|^2 + m_j |phi_j|^2). So k / m is at most the largest over all
//     buildings of omega^2 + S, with the largest frequency omega of the building alone and S the
//     largest sum of k_e / m_e over the links of one floor.
//   - In the same way c / m is at most the largest of g + D, where g is the largest row sum of
//     M^-1 |C| (Gershgorin), and D the largest sum of c_e / m_e.
// The part of k from storeys is damped as in the building alone. The part from links may be
// undamped. So the step must meet two limits: that of the building alone, at the larger frequency,
// and that of the links alone, without damping.
#include "model/stability.h"

#include <assert.h>
#include <complex.h>
#include <math.h>
#include <stdlib.h>

#include "core/root.h"
#include "model/parts.h"

// Limits of |z|: of an undamped oscillation, and of a decay.
static const double UNDAMPED = 0.99, DECAYING = 3.3;
static const double LARGEST = 3.5;  // above all limits
static const double DECAYS = 0.9;   // share of the limit that is used, so that motions decay
enum { HALVINGS = 14 };

static bool is_stable(double complex z) {
    double complex r = 1.0 + z / 5.0;
    for (int n = 5; n > 0; n--) {
        r = 1.0 + z / n * r;
    }
    return cabs(r) <= 1.0;
}

// Each ray leaves the region of stability once below LARGEST.
double stability_limit(double ratio) {
    double complex ray =
        ratio < 1.0 ? -ratio + I * sqrt(1.0 - ratio * ratio) : -ratio - sqrt(ratio * ratio - 1.0);
    struct root end = {.high = LARGEST};
    for (int i = 0; i < HALVINGS; i++) {
        root_halve(&end, is_stable(root_middle(&end) * ray));
    }
    return end.low;
}

// Entry (i, j) of the damping matrix, including the dashpots of parts.
static double damping_entry(const struct building *g, int i, int j) {
    const int n = g->n_dof, lower = i < j ? i : j;
    const double banded = i == j            ? g->damping_diagonal[i]
                          : abs(i - j) == 1 ? g->damping_off[lower]
                                            : 0.0;
    return (g->damping_full ? g->damping_full[i * n + j] : banded) +
           (g->n_part > 0 ? parts_on_floors(g->part_dashpot, n, i, j) : 0.0);
}

struct stability stability_of(const struct building *g) {
    struct stability s = {.alone = INFINITY, .square = pow(g->omega[g->n_dof - 1], 2.0)};
    for (int i = 0; i < g->n_dof; i++) {
        double ratio = building_damping_ratio(g, i + 1);
        if (g->omega[i] > 0.0) {
            s.alone = fmin(s.alone, DECAYS * stability_limit(ratio) / g->omega[i]);
        }
    }
    // A motion decays at the rate c / 2m, and c / m of one floor against the others is at least
    // that of the floor with the least.
    double least = INFINITY;
    int n = g->n_dof;
    for (int i = 0; i < n; i++) {
        const double own = damping_entry(g, i, i);
        double sum = own;
        for (int j = n - 1; j >= 0; j--) {
            sum += j == i ? 0.0 : fabs(damping_entry(g, i, j));
        }
        s.decay = fmax(s.decay, sum / g->mass[i]);
        least = fmin(least, own / g->mass[i]);
    }
    s.memory = 2.0 / least;
    return s;
}

double stability_step(const struct stability *s, double spring, double dashpot) {
    assert(s);
    double step = s->alone * sqrt(s->square / (s->square + spring));
    step = s->square > 0.0 ? step : INFINITY;
    step = spring > 0.0 ? fmin(step, UNDAMPED / sqrt(spring)) : step;
    return s->decay + dashpot > 0.0 ? fmin(step, DECAYING / (s->decay + dashpot)) : step;
}
