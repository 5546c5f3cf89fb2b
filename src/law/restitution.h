// SPDX-License-Identifier: GPL-3.0-or-later
// Relations between the coefficient of restitution e and a damping parameter, published or exact,
// shared by the laws that use them.
#ifndef JOSTLE_RESTITUTION_H
#define JOSTLE_RESTITUTION_H

#include "jostle/contact_law.h"
#include "jostle/row.h"

// 1e-6 <= e <= 1. Published relations have 1 / e, which gives excessive forces for small e. Below
// 1e-12 rounding errors exceed the dissipated energy.
extern const struct range restitution_range;

#define RESTITUTION_ROW                                                                            \
    { "e", ROW_NUMBER, ROW_ONE_OF, OF_NONE, &restitution_range, NAN, "coefficient of restitution" }

// The meaning of -zeta in laws of the family k d^n (1 + q v / v0).
#define HYSTERESIS_ZETA_DOC "dimensionless damping q = zeta v0 / k"

// The row of -vmin: a smaller velocity at closure counts as this value in v0.
#define LEAST_V0_ROW                                                                               \
    {                                                                                              \
        "vmin", ROW_NUMBER, 0, OF_VELOCITY, &range_positive, 1e-3,                                 \
            "least value of v0: slower closures count as this velocity"                            \
    }

// Damping ratio of a linear dashpot that delivers e when its tension is kept:
//     zeta = -ln e / sqrt(pi^2 + ln^2 e).
// Anagnostopoulos (1988), eq. 4; the minus sign is missing in several later papers, where the
// dashpot would add energy.
double restitution_kelvin_voigt(double e);

// q = 3 (1 - e^2) / 4 of F = k d^n (1 + q v / v0): Lankarani & Nikravesh (1990). Accurate only
// near e = 1: a requested e of 0.65 gives 0.7748.
double restitution_lankarani_nikravesh(double e);

// The q > 0 of F = k d^n (1 + q v / v0) that delivers e, for every n. The energies of approach and
// release at the largest penetration give
//     q (1 + e) = ln((1 + q) / (1 - e q)),   q < 1 / e.
// NAN: no memory.
double restitution_exact_q(double e);

// The q >= 0 of an approach under F = k d^n (1 + q v / v0), for every n, after which the spring has
// the share s of the energy, 0 < s <= 1:
//     s = 2 (q - ln(1 + q)) / q^2.
// NAN: no memory.
double restitution_stored_q(double share);

// The q > 0 of a release under F = f(d) (1 + q v / v0), v < 0, that delivers e. The approach before
// it is elastic, under any spring f:
//     ln(1 - e q) + e q + q^2 / 2 = 0,   q < 1 / e.
// NAN: no memory.
double restitution_release_q(double e);

// Damping ratio of a linear dashpot that delivers e if the dashpot acts during approach only, or if
// the contact does not pull. With zeta = cos a the approach ends after the phase a at the
// penetration exp(-a / tan a). A release without dashpot gives e = exp(-a / tan a). A release
// without tension mirrors the approach: e = exp(-2 a / tan a). For zeta > 1, a is imaginary. NAN:
// no memory.
double restitution_approach(double e);
double restitution_no_tension(double e);

// The ratio given by the user, or the one from e: exactly one of the two is not NAN.
double restitution_ratio(double e, double zeta, double (*relation)(double e));

// The damping ratio with which a law delivers a given coefficient of restitution.

// The value of row `zeta` with which an isolated impact has the restitution e. The impact has k, m
// and v0 equal to 1. Other rows have their default. Use it as `exact` of a law whose restitution
// depends only on zeta and falls with zeta. The search starts at `guess` > 0. NAN: no such value
// was found, or no memory.
double calibrate_by_impact(const struct contact_law *law, double e, double guess);

// Rows and constants of the laws with a linear spring k and a dashpot c = 2 zeta sqrt(k m). The
// laws differ in the part of the impact in which the dashpot acts, and in the relation zeta(e).
enum dashpot_row { DASHPOT_K, DASHPOT_E, DASHPOT_ZETA, DASHPOT_ROWS };
extern const struct row restitution_dashpot_rows[DASHPOT_ROWS];

enum dashpot_constant { DASHPOT_STIFFNESS, DASHPOT_COEFFICIENT, DASHPOT_CONSTANTS };

// Computes k and c from the values of these rows. zeta is the given value or relation(e).
void restitution_dashpot(const double *value, double m_eff, double (*relation)(double e),
                         double *constant);

// The same with the relation of Anagnostopoulos: `prepare` of laws with these rows.
int restitution_prepare(const double *value, double m_eff, double *constant, struct error *e);

#endif
