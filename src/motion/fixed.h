// SPDX-License-Identifier: GPL-3.0-or-later
// Values in fields of a fixed width, as a Fortran format such as (8F9.6) writes them. Fields may
// touch, so that blanks do not part them.
#ifndef JOSTLE_MOTION_FIXED_H
#define JOSTLE_MOTION_FIXED_H

#include "motion/lines.h"
#include "motion/record_format.h"

struct arena;

struct fixed_format {
    size_t n;         // values a line
    size_t width;     // characters a field
    size_t decimals;  // 0: not told
    bool timed;  // each value has a field with its time before it, which must agree with out->dt
    int stated;  // line that states the number of values; 0: the one before them
};

// The last format in brackets in the line, as (8F9.6), (8F9) or (5e15.6), else the one behind the
// word `Format`; false: there is none.
bool fixed_format_find(struct piece line, struct fixed_format *out);

// Field i, from 0, of the line, without the blanks around it; of no characters if the line is
// shorter.
struct piece fixed_field(struct piece line, const struct fixed_format *format, size_t i);

// Reads n values from the lines after the one where `l` stands, to the end of the line with the
// last: sets value, n, peak and peak_line of `out`. Errors: STATUS_INPUT (too few lines, a field
// that is empty or no number, characters behind the last field, a time off the even grid).
int fixed_read(struct arena *a, const struct record_text *t, struct lines *l,
               const struct fixed_format *format, size_t n, struct record_content *out,
               struct error *e);

// Refuses a row of numbers after the n values, the last of which is in the line where `l` stands.
int fixed_check_end(const struct record_text *t, struct lines l, const struct fixed_format *format,
                    size_t n, struct error *e);

#endif
