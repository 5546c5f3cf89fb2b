// SPDX-License-Identifier: GPL-3.0-or-later
#include "law/restitution.h"

#include <gsl/gsl_math.h>
#include <math.h>

const struct range restitution_range = {
    .min = 0.0, .max = 1.0, .min_open = true, .text = "> 0 and <= 1"};

double restitution_kelvin_voigt(double e) {
    double l = log(e);
    return -l / sqrt(M_PI * M_PI + l * l);
}

double restitution_ratio(double e, double zeta, double (*relation)(double e)) {
    return isnan(e) ? zeta : relation(e);
}
