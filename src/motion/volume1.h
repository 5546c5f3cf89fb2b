// SPDX-License-Identifier: GPL-3.0-or-later
// Volume 1, uncorrected accelerations, in the layout of Caltech and later of other networks. A file
// has one or more channels. Each has 13 lines of text, 7 of integers and 7 of reals before its
// values, and often a line `/&` after them. Lines of a channel that are read:
//
//      1   the title
//      7   the name of the channel
//     11   NO. OF POINTS =   3500  RECORD LENGTH = 35.000 SEC       or DURATION
//     12   UNITS ... ARE SEC AND G/10.     MAX  = -0.051 G, AT   3.910 SEC
//
// The duration divided by the number of values is the time step. The number of values per second
// must be whole. The peak may be missing. The headers of numbers repeat the lines of text and are
// skipped.
//
// The times of Caltech's own files, from digitised films, are uneven. Such files are refused.
//
// Source: files of the networks; of the layout, Caltech (1969), Strong motion earthquake
// accelerograms, digitized and plotted data, volume I, part A, EERL 70-20.
#ifndef JOSTLE_MOTION_VOLUME1_H
#define JOSTLE_MOTION_VOLUME1_H

#include "motion/fixed.h"
#include "motion/lines.h"
#include "motion/record_format.h"

// The variant of a network; words in capitals.
struct volume1 {
    const char *title;   // in line 1
    const char *units;   // in line 12
    const char *length;  // key of the duration
    const char *none;    // the error of a file without channels
    struct fixed_format format;
    bool (*next)(struct lines *l, struct piece *name);  // calls volume1_next with this struct
};

bool volume1_matches(const struct volume1 *v, const struct record_text *t);

// Goes to the first line of the next channel; false: there is no further channel.
bool volume1_next(const struct volume1 *v, struct lines *l, struct piece *name);

int volume1_read(const struct volume1 *v, struct arena *a, const struct record_request *request,
                 const struct record_text *t, struct record_content *out, struct error *e);

#endif
