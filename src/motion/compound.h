// SPDX-License-Identifier: GPL-3.0-or-later
// Fields of Fortran output that hold several values: repeat counts, 60*0.0, and numbers that touch,
// 1.2345E-01-2.3456E-02.
#ifndef JOSTLE_MOTION_COMPOUND_H
#define JOSTLE_MOTION_COMPOUND_H

#include "motion/lines.h"

enum compound_kind {
    COMPOUND_ONE,        // one value, or no number at all
    COMPOUND_REPEATED,   // one value, n times
    COMPOUND_TOUCHING,   // n values
    COMPOUND_AMBIGUOUS,  // numbers that touch, which could end at two places
    COMPOUND_NO_LETTER   // no number: an exponent without a letter, and not of three digits
};

struct compound {
    enum compound_kind kind;
    struct piece rest;  // what is still to be taken
    size_t n;           // values of the field; 1 if it is not several
};

// What a field between separators holds. Numbers that touch have a decimal point each, and the sign
// of the next ends them: 1.234-103 is one number, with an exponent of three digits, and so
// 1.234-103.5 is ambiguous.
struct compound compound_of(struct piece field);

// Takes the next value off; of the others the whole field.
struct piece compound_next(struct compound *c);

#endif
