// SPDX-License-Identifier: GPL-3.0-or-later
// Headers with one entry per line: `KEY: value`, `KEY   : value` or `KEY   value`.
#ifndef JOSTLE_MOTION_HEADER_H
#define JOSTLE_MOTION_HEADER_H

#include "motion/lines.h"
#include "motion/record_format.h"

struct header {
    const struct record_reader *reading;
    int n_line;  // lines of the header, from the first line of the text
};

struct header_entry {
    const char *key;     // as the format writes it
    struct piece value;  // may be empty
    int line;
};

// The functions below return false after an error of STATUS_INPUT, if they do not say otherwise.

// Goes to the last line of a header, which begins with `mark`, among the first `n_line` lines.
// `name` is that of the format, for the message.
bool header_end(const struct record_reader *r, const char *mark, int n_line, const char *name,
                struct lines *l);

// The first entry with this key; false: there is none.
bool header_find(const struct header *h, const char *key, struct header_entry *out);

// An entry that must exist and not be empty.
bool header_text(const struct header *h, const char *key, struct header_entry *out);

// An entry that must be a number > 0.
bool header_positive(const struct header *h, const char *key, struct header_entry *out,
                     double *number);

// An entry that must be a number of values: whole, from 2 to 1e9.
bool header_count(const struct header *h, const char *key, struct header_entry *out, double *n);

// The number of values in a duration, an entry [s], at `rate` values per second.
bool header_duration(const struct header *h, const char *key, double rate, struct header_entry *out,
                     double *n);

// Reads `value`, a piece of the value of the entry, as a number, or as a number > 0.
bool header_read_number(const struct record_reader *r, const struct header_entry *from,
                        struct piece value, double *number);
bool header_read_positive(const struct record_reader *r, const struct header_entry *from,
                          struct piece value, double *number);

// Reads the value of the entry as a number of values: whole, from 2 to 1e9.
bool header_read_count(const struct record_reader *r, const struct header_entry *from, double *n);

// Reads `value` as the stated largest acceleration, in the unit `unit` [m/s^2]; 0: in the unit of
// the values. Its last digit may be rounded or cut off, and it may have a sign. An empty value is
// allowed and states nothing. Of two peaks the larger one counts.
bool header_read_peak(const struct record_reader *r, const struct header_entry *from,
                      struct piece value, double unit);

// The size of a unit of acceleration [m/s^2]; 0: the text is not such a unit.
double header_unit(const struct record_reader *r, struct piece text);

// Reads `value`, in line `line`, as the unit of the values. out->unit stays 0 if it is not a unit
// of acceleration.
void header_read_unit(const struct record_reader *r, int line, struct piece value);

#endif
