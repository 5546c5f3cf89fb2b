// SPDX-License-Identifier: GPL-3.0-or-later
// Measures of the intensity of a ground acceleration given by samples, all exact for the straight
// lines between them and without any correction of the baseline.
#ifndef JOSTLE_INTENSITY_H
#define JOSTLE_INTENSITY_H

#include "jostle/names.h"
#include "jostle/signal.h"

JOSTLE_C_BEGIN

// Times are since the first sample; a peak's time is where it is first reached.
struct intensity {
    double pga, pga_time;  // [L/T^2], [T] largest |acceleration|
    double pgv, pgv_time;  // [L/T], [T] largest |velocity| from rest
    double pgd, pgd_time;  // [L], [T] largest |displacement| from rest, within the record
    double arias;          // [L/T] pi / (2 g) times the integral of the squared acceleration
    double cav;            // [L/T] cumulative absolute velocity, the integral of |acceleration|
    double time_5;         // [T] when 5 % of the Arias intensity has come
    double d5_75, d5_95;   // [T] from there until 75 % and 95 % have come: significant duration
};

// `gravity` [L/T^2] is that in the Arias intensity.
struct intensity intensity_of(const struct signal *ground, double gravity);

JOSTLE_C_END

#endif
