// SPDX-License-Identifier: GPL-3.0-or-later
// Fields of Fortran output that hold several values: repeat counts, 60*0.0, and numbers that touch,
// 1.2345E-01-2.3456E-02.
#ifndef JOSTLE_MOTION_COMPOUND_H
#define JOSTLE_MOTION_COMPOUND_H

#include "motion/lines.h"

enum compound_kind {
    COMPOUND_ONE,        // one value, or not a number
    COMPOUND_REPEATED,   // one value, n times
    COMPOUND_TOUCHING,   // n values
    COMPOUND_AMBIGUOUS,  // numbers that touch and can be separated in two ways
    COMPOUND_NO_LETTER   // not a number: an exponent without a letter has other than three digits
};

struct compound {
    enum compound_kind kind;
    struct piece rest;  // the part of the field that has not been taken
    size_t n;           // number of values in the field; 1 if the kind is COMPOUND_ONE
};

// The values in a field between separators. Each of several numbers that touch has a decimal point,
// and the sign of the next number ends it. 1.234-103 is one number, with an exponent of three
// digits. So 1.234-103.5 is ambiguous.
struct compound compound_of(struct piece field);

// Takes the next value off `c`. If the kind is not COMPOUND_TOUCHING, the result is the whole
// value.
struct piece compound_next(struct compound *c);

#endif
