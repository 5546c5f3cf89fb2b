// SPDX-License-Identifier: GPL-3.0-or-later
// Volume 1, uncorrected accelerations, as Caltech wrote it and other networks after it: channel
// after channel, each with 13 lines of text, 7 of integers and 7 of reals before its values, and
// often a line `/&` behind them. By its line in the channel:
//
//      1   the title
//      7   the name of the channel
//     11   NO. OF POINTS =   3500  RECORD LENGTH = 35.000 SEC       or DURATION
//     12   UNITS ... ARE SEC AND G/10.     MAX  = -0.051 G, AT   3.910 SEC
//
// The duration is that of as many steps as there are values. They must make a whole number of
// values a second. The peak need not be told. What the headers of numbers say is in the lines of
// text too; they are skipped.
//
// Caltech's own times, of digitised films, are not even, and so refused.
//
// Source: files of the networks; of the layout, Caltech (1969), Strong motion earthquake
// accelerograms, digitized and plotted data, volume I, part A, EERL 70-20.
#ifndef JOSTLE_MOTION_VOLUME1_H
#define JOSTLE_MOTION_VOLUME1_H

#include "motion/fixed.h"
#include "motion/lines.h"
#include "motion/record_format.h"

// How a network writes it; words in capitals.
struct volume1 {
    const char *title;   // in line 1
    const char *units;   // in line 12
    const char *length;  // key of the duration
    const char *none;    // the error of a file without channels
    struct fixed_format format;
    bool (*next)(struct lines *l, struct piece *name);  // volume1_next with this
};

bool volume1_matches(const struct volume1 *v, const struct record_text *t);

// Steps to the first line of the next channel; false: there is none.
bool volume1_next(const struct volume1 *v, struct lines *l, struct piece *name);

int volume1_read(const struct volume1 *v, struct arena *a, const struct record_request *request,
                 const struct record_text *t, struct record_content *out, struct error *e);

#endif
