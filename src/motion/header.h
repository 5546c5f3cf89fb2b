// SPDX-License-Identifier: GPL-3.0-or-later
// What the header of a file states: entries in lines `KEY: value`, `KEY   : value` or `KEY value`,
// or in fields of a fixed width (fixed.h), and what they mean.
#ifndef JOSTLE_MOTION_HEADER_H
#define JOSTLE_MOTION_HEADER_H

#include "motion/lines.h"
#include "motion/record_format.h"

struct header {
    const struct record_reader *reading;
    int n_line;  // lines of the header, from the first line of the text
};

struct header_entry {
    const char *key;     // as the format writes it, or its name in messages
    struct piece value;  // may be empty
    int line;
};

// What an entry says about the record.
enum header_kind {
    HEADER_COUNT,     // the number of values: whole, from 2 to 1e9
    HEADER_STEP,      // the time step [s]
    HEADER_RATE,      // values per second
    HEADER_DURATION,  // [s] makes the number of values, by the rate, which is taken before
    HEADER_UNIT,      // the unit of the values; one that is not of acceleration is for record_check
    HEADER_PEAK,  // the largest acceleration; empty: not stated. Of two peaks the larger one counts
};

// A row of the table of a format: what the entry of a key says. A row without a key ends the table.
struct header_row {
    enum header_kind kind;
    const char *key;
    const char *until;  // characters that end the value; NULL: it ends with the line
    const char *unit;   // which the file may write behind the number; NULL: none
    bool channels;      // a slash and a value for each channel
    bool optional;
};

// The functions below return false after an error of STATUS_INPUT, if they do not say otherwise.

// Goes to the last line of a header, which begins with `mark`, among the first `n_line` lines.
// `name` is that of the format, for the message.
bool header_end(const struct record_reader *r, const char *mark, int n_line, const char *name,
                struct lines *l);

// Goes to the last one of the `n` lines of a header, of which the current line of `l` is the first.
bool header_skip(const struct record_reader *r, struct lines *l, int n);

// The first entry with this key; false: there is none.
bool header_find(const struct header *h, const char *key, struct header_entry *out);

// An entry that must exist and not be empty.
bool header_text(const struct header *h, const char *key, struct header_entry *out);

// Reads the value of an entry as a number, or as a number > 0.
bool header_number(const struct record_reader *r, const struct header_entry *from, double *number);
bool header_positive(const struct record_reader *r, const struct header_entry *from,
                     double *number);

// Notes what an entry says, and its line, in r->out.
bool header_take(const struct record_reader *r, enum header_kind kind,
                 const struct header_entry *from);

// Takes the entries of a table in the order of its rows. `channel`: that of rows with channels.
bool header_rows(const struct header *h, const struct header_row *row, int channel);

// Takes a peak in a unit [m/s^2] of its own; 0: in that of the values. Its last digit may be
// rounded or cut off, and it may have a sign.
bool header_peak(const struct record_reader *r, const struct header_entry *from, double unit);

// The size of a unit of acceleration [m/s^2]; 0: the text is not such a unit.
double header_unit(const struct record_reader *r, struct piece text);

#endif
