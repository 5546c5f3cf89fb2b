// SPDX-License-Identifier: GPL-3.0-or-later
// Root of a function of one variable.
#ifndef JOSTLE_ROOT_H
#define JOSTLE_ROOT_H

// The root of `function` between low and high, where its values have different signs, to the
// relative tolerance, by Brent's method (GSL). NAN: no memory, or the values are not finite.
double root_find(double (*function)(double x, void *context), void *context, double low,
                 double high, double tolerance);

#endif
