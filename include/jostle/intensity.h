// SPDX-License-Identifier: GPL-3.0-or-later
// Intensities of a ground acceleration that is given by samples. They are exact for the straight
// lines between the samples, without a correction of the baseline.
#ifndef JOSTLE_INTENSITY_H
#define JOSTLE_INTENSITY_H

#include "jostle/names.h"
#include "jostle/signal.h"

JOSTLE_C_BEGIN

// Times are since the first sample. The time of a peak is when it is first reached.
struct intensity {
    double pga, pga_time;  // [L/T^2], [T] largest |acceleration|
    double pgv, pgv_time;  // [L/T], [T] largest |velocity| from rest
    double pgd, pgd_time;  // [L], [T] largest |displacement| from rest, within the record
    double arias;          // [L/T] pi / (2 g) times the integral of the squared acceleration
    double cav;            // [L/T] cumulative absolute velocity, the integral of |acceleration|
    double arias_trapezoid, cav_trapezoid;  // [L/T] the same integrals by the trapezoidal rule of
                                            // the samples, as other programs print them
    double time_5;                          // [T] at which 5 % of the Arias intensity is reached
    double d5_75, d5_95;  // [T] from time_5 to 75 % and 95 %: significant durations
};

// `gravity` [L/T^2] is the g of the Arias intensity.
struct intensity intensity_of(const struct signal *ground, double gravity);

JOSTLE_C_END

#endif
