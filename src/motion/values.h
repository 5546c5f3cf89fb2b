// SPDX-License-Identifier: GPL-3.0-or-later
// Values that run on from line to line to the end of the file.
#ifndef JOSTLE_MOTION_VALUES_H
#define JOSTLE_MOTION_VALUES_H

#include "motion/lines.h"
#include "motion/record_format.h"

struct arena;

// Refuses a comment between the first and the last number after the line where `from` stands.
int values_check_comments(const struct record_text *t, struct lines from, struct error *e);

// Values after the line where `from` stands, with repeated ones and those that touch (compound.h),
// without blank and comment lines. *last_line: the last
// line that holds one; 0: none does.
size_t values_count(struct lines from, const char *separators, int *last_line);

// Reads the first n of them, at most as many as values_count has found: sets value, n, peak and
// peak_line of `out`.
int values_read(struct arena *a, const struct record_text *t, struct lines from,
                const char *separators, size_t n, struct record_content *out, struct error *e);

// Reads all, which are to be as many as the header states in line `stated_line`, separated by
// blanks.
int values_read_stated(struct arena *a, const struct record_text *t, struct lines from,
                       double stated, int stated_line, struct record_content *out, struct error *e);

// Time of value `index`: out->time_offset, which that of the first sets, and so many steps of
// out->dt, but for rounding. Errors: STATUS_INPUT.
int values_check_time(const struct record_text *t, int line, size_t index, double time,
                      struct record_content *out, struct error *e);

// Keeps `peak` and `peak_line` when value `index`, read from `line`, is larger than all before it.
void values_note_peak(struct record_content *out, const double *value, size_t index, int line);

// The mean of n >= 1 values, to the last bit where they are all the same.
double values_mean(const double *value, size_t n);

#endif
