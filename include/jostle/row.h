// SPDX-License-Identifier: GPL-3.0-or-later
// A row describes one argument of a statement or one parameter of a law: from rows come parsing,
// range checks, help texts and the reference in docs/.
#ifndef JOSTLE_ROW_H
#define JOSTLE_ROW_H

#include <math.h>
#include <stdbool.h>

#include "jostle/names.h"
#include "jostle/units.h"

JOSTLE_C_BEGIN

enum row_kind {
    ROW_NUMBER,   // one number
    ROW_LIST,     // one or more numbers, repeats allowed: 7*300e3 250e3
    ROW_INTEGER,  // one whole number
    ROW_TEXT,     // one word
    ROW_TEXTS,    // one or more words
    ROW_FILE,     // one word: the path of a file
    ROW_FLAG,     // no value
    ROW_CHOICE,   // one of the words of its range; as a number 0 for the first, 1 for the next
};

enum row_flag {
    ROW_REQUIRED = 1,             // must be given
    ROW_ONE_OF = 2,               // exactly one of the rows with this flag must be given
    ROW_POWER = 4,                // its value is the exponent p of the rows with the flags below
    ROW_PER_LENGTH_POWER = 8,     // the dimension given is divided by length^p
    ROW_PER_VELOCITY_POWER = 16,  // the dimension given is divided by velocity^p
};

// Limits in SI, so that they hold whatever the deck's units are.
struct range {
    double min, max;          // may be infinite
    bool min_open, max_open;  // the limit itself is not allowed
    const char *text;         // how a message states it: "> 0", ">= 0 and < 1", "peak or pinched"
    const char *const *word;  // of ROW_CHOICE, NULL after the last
};

extern const struct range range_positive;      // > 0
extern const struct range range_non_negative;  // >= 0

// Is the value within the range? All are where that is NULL.
bool range_holds(const struct range *r, double value);

struct row {
    const char *key;  // without the dash
    enum row_kind kind;
    unsigned flags;              // enum row_flag
    struct dimension dimension;  // of numbers: OF_LENGTH and the like, or {0, -2, 0}
    const struct range *range;   // NULL: any finite number
    double fallback;             // value in SI if not given (numbers); NAN: none
    const char *doc;             // half a sentence: what it is
};

// A row in a macro of rows.
#define ROW_OF(key, kind, flags, of, range, fallback, doc)                                         \
    { key, kind, flags, of, range, fallback, doc }

// The place of the row with this key among n; -1: none.
int row_find(const struct row *row, int n, const char *key);

// The dimension of the row where the exponent is `power`.
struct dimension row_dimension(const struct row *row, double power);

JOSTLE_C_END

#endif
