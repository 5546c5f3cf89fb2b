// SPDX-License-Identifier: GPL-3.0-or-later
// Values that continue from line to line up to the end of the file.
#ifndef JOSTLE_MOTION_VALUES_H
#define JOSTLE_MOTION_VALUES_H

#include "motion/lines.h"
#include "motion/record_format.h"

// STATUS_INPUT if a comment is between the first and the last number after the current line.
int values_check_comments(const struct record_text *t, struct lines from, struct error *e);

// The number of values after the current line. Repeated values and values that touch count
// (compound.h); blank lines and comments do not. *last_line: the last line with a value; 0: none.
size_t values_count(struct lines from, const char *separators, int *last_line);

// Reads the first n values, at most as many as values_count has found. Sets value, n, peak and
// peak_line of r->out. This and the next two functions return false after an error.
bool values_read(const struct record_reader *r, struct lines from, const char *separators,
                 size_t n);

// Reads all values, separated by spaces. Their number must be that of the header, in line
// `stated_line`.
bool values_read_stated(const struct record_reader *r, struct lines from, double stated,
                        int stated_line);

// Checks the time of value `index`: it must be out->time_offset + index out->dt, except for
// rounding. The time of the first value sets out->time_offset.
bool values_check_time(const struct record_reader *r, int line, size_t index, double time);

// Sets `peak` and `peak_line` if |value[index]|, from line `line`, is larger than all earlier ones.
void values_note_peak(struct record_content *out, const double *value, size_t index, int line);

// The mean of n >= 1 values. If all are equal, the result is exactly this value.
double values_mean(const double *value, size_t n);

#endif
