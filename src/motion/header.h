// SPDX-License-Identifier: GPL-3.0-or-later
// Headers of one entry a line: `KEY: value`, `KEY   : value` or `KEY   value`.
#ifndef JOSTLE_MOTION_HEADER_H
#define JOSTLE_MOTION_HEADER_H

#include "motion/lines.h"
#include "motion/record_format.h"

struct header {
    const struct record_text *text;
    int n_line;  // it is the first so many lines
};

struct header_entry {
    const char *key;     // as the format writes it
    struct piece value;  // may be empty
    int line;
};

// The first entry of this key; false: there is none.
bool header_find(const struct header *h, const char *key, struct header_entry *out);

// An entry that must be there and not be empty. Errors of this and what follows: STATUS_INPUT.
int header_text(const struct header *h, const char *key, struct header_entry *out, struct error *e);

// One that must be a number > 0.
int header_positive(const struct header *h, const char *key, struct header_entry *out,
                    double *number, struct error *e);

// One that must be a number of values: whole, from 2 to 1e9.
int header_count(const struct header *h, const char *key, struct header_entry *out, double *n,
                 struct error *e);

// The number of values of a duration at `rate` a second.
int header_duration(const struct header *h, const char *key, double rate, struct header_entry *out,
                    double *n, struct error *e);

// `value`, a piece of the entry's, as a number.
int header_read_number(const struct header *h, const struct header_entry *from, struct piece value,
                       double *number, struct error *e);

// The same as a number > 0.
int header_read_positive(const struct header *h, const struct header_entry *from,
                         struct piece value, double *number, struct error *e);

// The entry's value as a number of values: whole, from 2 to 1e9.
int header_read_count(const struct header *h, const struct header_entry *from, double *n,
                      struct error *e);

// `value` as the largest acceleration that the file states, in its unit. It may be rounded or cut
// off in its last digit, and have a sign; an empty one states nothing.
int header_read_peak(const struct header *h, const struct header_entry *from, struct piece value,
                     struct record_content *out, struct error *e);

// The same where the peak has a unit of its own [m/s^2], 0: that of the values, which out->unit is.
int header_read_peak_of_unit(const struct header *h, const struct header_entry *from,
                             struct piece value, double unit, struct record_content *out,
                             struct error *e);

// The same as the unit of the values, which is left 0 where it is none of acceleration.
void header_read_unit(const struct record_request *request, const struct header_entry *from,
                      struct piece value, struct record_content *out);

#endif
