// SPDX-License-Identifier: GPL-3.0-or-later
// RENADIC, Universidad de Chile: volume 1 (volume1.h) with pairs of time and acceleration (10F7.3),
// which may touch. Lines 1, 7, 11, 12 and the last line:
//
//     UNCORRECTED ACCELEROGRAM DATA              PROCESSED: 06/30/2011
//     CHAN  1: EW       (STA CHN:  1)
//     NO. OF POINTS =   3500  RECORD LENGTH = 35.000 SEC
//     UNITS OF UNCOR ACCEL ARE SEC AND G/10.     MAX  = -0.051 G, AT   3.910 SEC
//     /&  ----------  END OF DATA FOR CHANNEL 1  ----------
//
// Times off the even grid are refused.
//
// Source: files of RENADIC; the reader of gmprocess (USGS) for them.
#include "motion/volume1.h"

static bool renadic_next(struct lines *l, struct piece *channel);

static const struct volume1 layout = {
    .title = "UNCORRECTED ACCELEROGRAM DATA",
    .units = "UNITS OF UNCOR ACCEL",
    .length = "RECORD LENGTH",
    .none = "the file has no line 'UNCORRECTED ACCELEROGRAM DATA'",
    .format = {.n = 5, .width = 7, .timed = true},
    .next = renadic_next,
};

static bool renadic_next(struct lines *l, struct piece *channel) {
    return volume1_next(&layout, l, channel);
}

static bool renadic_matches(const struct record_text *t) {
    return volume1_matches(&layout, t);
}

static int renadic_read(struct arena *a, const struct record_request *request,
                        const struct record_text *t, struct record_content *out, struct error *e) {
    return volume1_read(&layout, a, request, t, out, e);
}

const struct record_format record_renadic = {
    .name = "renadic",
    .doc = "RENADIC, Chile, volume 1, accelerations of one of its channels",
    .certain = true,
    .channels = true,
    .matches = renadic_matches,
    .read = renadic_read,
};
