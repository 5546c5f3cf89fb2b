// SPDX-License-Identifier: GPL-3.0-or-later
// Published relations between the coefficient of restitution e and a damping parameter, shared by
// the laws that use them.
#ifndef JOSTLE_RESTITUTION_H
#define JOSTLE_RESTITUTION_H

#include "jostle/row.h"

// 0 < e <= 1.
extern const struct range restitution_range;

// Damping ratio of a linear dashpot that delivers e when its tension is kept:
//     zeta = -ln e / sqrt(pi^2 + ln^2 e).
// Anagnostopoulos (1988), eq. 4; the minus sign is missing in several later papers, where the
// dashpot would feed energy in.
double restitution_kelvin_voigt(double e);

// The ratio given by the user, or the one from e: exactly one of the two is not NAN.
double restitution_ratio(double e, double zeta, double (*relation)(double e));

#endif
