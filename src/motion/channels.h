// SPDX-License-Identifier: GPL-3.0-or-later
// Files of several channels: the choice of a channel, and channels that are columns of rows.
#ifndef JOSTLE_MOTION_CHANNELS_H
#define JOSTLE_MOTION_CHANNELS_H

#include "motion/lines.h"
#include "motion/record_format.h"

enum { CHANNELS_MAX = 64 };

struct channels {
    int n;
    struct piece name[CHANNELS_MAX];
};

// The functions below return false after an error of STATUS_INPUT or STATUS_SYSTEM.

// The channel that -channel requests, from 0. A file of one channel needs no -channel. The error
// lists the channels if -channel is missing or requests a channel that does not exist;
// r->out->wrong says which.
bool channels_choose(const struct record_reader *r, const struct channels *c, int *chosen);

// Finds the requested channel in a file of channels one after the other. `next` goes to the next
// channel and fills the struct of the format, which begins with the name; false: there is none.
// Afterwards `l` and `channel` are those of the requested channel. Errors: those of
// channels_choose; `none` if the file has no channel.
bool channels_seek(const struct record_reader *r, bool (*next)(struct lines *l, void *channel),
                   const char *none, struct lines *l, void *channel);

// Rows of n_column numbers up to the end of the file.
struct channel_rows {
    struct lines from;  // the current line is the one before the first row
    int n_column;
    int column;  // the column to read, from 0
    bool timed;  // column 0 holds times, which must agree with out->dt
};

// Reads a column: sets value, n, peak and peak_line of r->out. If the file has more rows than the
// header states, all equal to the last one, sets n_filling, too.
bool channels_read(const struct record_reader *r, const struct channel_rows *rows);

#endif
