// SPDX-License-Identifier: GPL-3.0-or-later
// Values in fields of a fixed width, as a Fortran format such as (8F9.6) writes them. Fields may
// touch, without a space between them.
#ifndef JOSTLE_MOTION_FIXED_H
#define JOSTLE_MOTION_FIXED_H

#include "motion/header.h"
#include "motion/lines.h"
#include "motion/record_format.h"

struct fixed_format {
    size_t n;         // values per line
    size_t width;     // characters per field
    size_t decimals;  // 0: not stated
    bool timed;       // a field with the time is before each value; times must agree with out->dt
};

// The last format in brackets in the line, such as (8F9.6), (8F9) or (5e15.6). Without brackets,
// the format after the word `Format`. False: there is none.
bool fixed_format_find(struct piece line, struct fixed_format *out);

// Field i, from 0, of the line, without the spaces around it; empty if the line is shorter.
struct piece fixed_field(struct piece line, const struct fixed_format *format, size_t i);

// Number `i`, from 1, of the fields that begin in the current line of `first`, as an entry.
struct header_entry fixed_entry(const char *key, struct lines first,
                                const struct fixed_format *format, size_t i);

// Reads as many values as the header states from the lines after the current one, up to the end of
// the line with the last value. Sets value, n, peak and peak_line of r->out. False after an error:
// too few lines, a field that is empty or not a number, characters after the last field, uneven
// times.
bool fixed_read(const struct record_reader *r, struct lines *l, const struct fixed_format *format);

// False, with an error, if a row of numbers follows the values that have been read, the last of
// which is in the current line of `l`.
bool fixed_check_end(const struct record_reader *r, struct lines l,
                     const struct fixed_format *format);

#endif
