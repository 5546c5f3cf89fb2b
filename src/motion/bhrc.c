// SPDX-License-Identifier: GPL-3.0-or-later
// BHRC, Iran (ISMN): volume 1 (volume1.h) with accelerations (10E13.6). Lines 1, 7, 11, 12 and the
// last line:
//
//     * VOL1DS FILE:  5529/01
//     COMP L1
//     NO. OF POINTS =   9472      DURATION =  47.360
//     UNITS ARE SECONDS AND G/10
//     /&
//
// The headers of numbers are cut off at 70 characters.
//
// Source: files of BHRC; the reader of gmprocess (USGS) for them.
#include "motion/volume1.h"

static bool bhrc_next(struct lines *l, struct piece *channel);

static const struct volume1 layout = {
    .title = "VOL1DS FILE",
    .units = "UNITS ARE SECONDS AND",
    .length = "DURATION",
    .none = "the file has no line 'VOL1DS FILE'",
    .format = {.n = 10, .width = 13},
    .next = bhrc_next,
};

static bool bhrc_next(struct lines *l, struct piece *channel) {
    return volume1_next(&layout, l, channel);
}

static bool bhrc_matches(const struct record_text *t) {
    return volume1_matches(&layout, t);
}

static int bhrc_read(struct arena *a, const struct record_request *request,
                     const struct record_text *t, struct record_content *out, struct error *e) {
    return volume1_read(&layout, a, request, t, out, e);
}

const struct record_format record_bhrc = {
    .name = "bhrc",
    .doc = "BHRC, Iran, volume 1, accelerations of one of its channels",
    .certain = true,
    .channels = true,
    .matches = bhrc_matches,
    .read = bhrc_read,
};
