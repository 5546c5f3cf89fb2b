// SPDX-License-Identifier: GPL-3.0-or-later
// Headers with one entry per line: `KEY: value`, `KEY   : value` or `KEY   value`.
#ifndef JOSTLE_MOTION_HEADER_H
#define JOSTLE_MOTION_HEADER_H

#include "motion/lines.h"
#include "motion/record_format.h"

struct header {
    const struct record_text *text;
    int n_line;  // lines of the header, from the first line of the text
};

struct header_entry {
    const char *key;     // as the format writes it
    struct piece value;  // may be empty
    int line;
};

// The first entry with this key; false: there is none.
bool header_find(const struct header *h, const char *key, struct header_entry *out);

// An entry that must exist and not be empty. Errors of this and the following functions:
// STATUS_INPUT.
int header_text(const struct header *h, const char *key, struct header_entry *out, struct error *e);

// An entry that must be a number > 0.
int header_positive(const struct header *h, const char *key, struct header_entry *out,
                    double *number, struct error *e);

// An entry that must be a number of values: whole, from 2 to 1e9.
int header_count(const struct header *h, const char *key, struct header_entry *out, double *n,
                 struct error *e);

// The number of values in a duration, an entry [s], at `rate` values per second.
int header_duration(const struct header *h, const char *key, double rate, struct header_entry *out,
                    double *n, struct error *e);

// Reads `value`, a piece of the value of the entry, as a number.
int header_read_number(const struct header *h, const struct header_entry *from, struct piece value,
                       double *number, struct error *e);

// Reads `value`, a piece of the value of the entry, as a number > 0.
int header_read_positive(const struct header *h, const struct header_entry *from,
                         struct piece value, double *number, struct error *e);

// Reads the value of the entry as a number of values: whole, from 2 to 1e9.
int header_read_count(const struct header *h, const struct header_entry *from, double *n,
                      struct error *e);

// Reads `value` as the stated largest acceleration, in the unit of the values. Its last digit may
// be rounded or cut off, and it may have a sign. An empty value is allowed and states nothing.
int header_read_peak(const struct header *h, const struct header_entry *from, struct piece value,
                     struct record_content *out, struct error *e);

// Reads the stated peak as header_read_peak does, in the unit `unit` [m/s^2]; 0: in the unit of the
// values, out->unit.
int header_read_peak_of_unit(const struct header *h, const struct header_entry *from,
                             struct piece value, double unit, struct record_content *out,
                             struct error *e);

// Reads `value` as the unit of the values. out->unit stays 0 if it is not a unit of acceleration.
void header_read_unit(const struct record_request *request, const struct header_entry *from,
                      struct piece value, struct record_content *out);

#endif
