// SPDX-License-Identifier: GPL-3.0-or-later
// Files of several channels: which one is asked for, and channels that stand side by side in rows.
#ifndef JOSTLE_MOTION_CHANNELS_H
#define JOSTLE_MOTION_CHANNELS_H

#include "motion/lines.h"
#include "motion/record_format.h"

struct arena;

enum { CHANNELS_MAX = 64 };

struct channels {
    int n;
    struct piece name[CHANNELS_MAX];
};

// The channel that -channel asks for, from 0; the only one need not be asked for. Errors:
// STATUS_INPUT, with a list of the channels where none is asked for, or one that is not there;
// out->wrong says which.
int channels_choose(const struct record_request *request, const struct record_text *t,
                    const struct channels *c, int *chosen, struct record_content *out,
                    struct error *e);

// Seeks the channel that is asked for in a file of one after the other. `next` steps to the next
// and gives its name; false: there is none. *before: from there, `next` steps to the channel.
// Errors: as above, and `none` where there is no channel.
int channels_seek(const struct record_request *request, const struct record_text *t,
                  bool (*next)(struct lines *l, struct piece *name), const char *none,
                  struct lines *before, struct record_content *out, struct error *e);

// Rows of numbers to the end of the file, all of n_column.
struct channel_rows {
    struct lines from;  // stands on the line before the first
    int n_column;
    int column;  // to be read, from 0
    bool timed;  // column 0 holds times, which must agree with out->dt
    double stated;
    int stated_line;  // where the header states so many rows
};

// Reads a column: sets value, n, peak and peak_line of `out`; n_filling where more rows than stated
// follow, all the same as the last.
int channels_read(struct arena *a, const struct record_text *t, const struct channel_rows *rows,
                  struct record_content *out, struct error *e);

#endif
