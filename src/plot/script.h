// SPDX-License-Identifier: GPL-3.0-or-later
// What figures have in common: quoting, units, colours, thinning.
#ifndef JOSTLE_SCRIPT_H
#define JOSTLE_SCRIPT_H

#include <stddef.h>
#include <stdio.h>

#include "jostle/result.h"

// Colours that the colour-blind can tell apart (Okabe and Ito 2008), without the yellow, which is
// too light for lines on white.
enum { SCRIPT_COLOURS = 7 };
extern const char *const script_colour[];

// A point for each colour, to tell them apart without: gnuplot's numbers.
extern const int script_point[];

// About how wide an UTF-8 text is [em]: usual sans-serif fonts are not wider.
double script_width(const char *text);

// A text whose end is cut off behind `width` em.
void script_cut(const char *text, double width, char *cut, size_t size);

// A name with as much of its middle left out as makes it at most `width` em wide. A word that the
// end begins with keeps the blank before it.
void script_shorten(const char *name, double width, char *cut, size_t size);

// The unit, powers as raised digits, products with raised points.
void script_unit(const struct unit_system *units, struct dimension dimension, char *text,
                 size_t size);

// Puts raised digits for ^2 and ^3; the text gets no longer.
void script_raise(char *text);

// The power of ten in which numbers up to `largest` are short; 0 where that is from `least` to
// below `most`, or no positive number.
int script_exponent(double largest, double least, double most);

// Ten to the power `exponent`, in raised digits.
void script_power(int exponent, char *text, size_t size);

// A number for running text: four digits, and a power of ten as axes have it where it is large or
// small.
void script_number(double value, char *text, size_t size);

// A step of 1, 2 or 5 times a power of ten that divides [0, largest] into at most `n` parts.
double script_step(double largest, int n);

// Chooses rows of `n_series` series of `n` values so that each of `bins` equal parts keeps the
// smallest and the largest value of every series. `row` has room for 2 n_series bins + 2 indices,
// or n; returns how many were chosen, ascending.
size_t script_thin(const double *const *series, int n_series, size_t n, size_t bins, size_t *row);

#endif
