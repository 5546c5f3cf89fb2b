// SPDX-License-Identifier: GPL-3.0-or-later
// Volume 1, uncorrected accelerations, in the layout of Caltech, which other networks use too. A
// file has one or more channels. Each has 13 lines of text, 7 of integers and 7 of reals before its
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
// BHRC, Iran (ISMN): accelerations (10E13.6). The headers of numbers are cut off at 70 characters.
//
//     * VOL1DS FILE:  5529/01
//     COMP L1
//     NO. OF POINTS =   9472      DURATION =  47.360
//     UNITS ARE SECONDS AND G/10
//     /&
//
// RENADIC, Universidad de Chile: pairs of time and acceleration (10F7.3), which may touch. Times
// off the even grid are refused.
//
//     UNCORRECTED ACCELEROGRAM DATA              PROCESSED: 06/30/2011
//     CHAN  1: EW       (STA CHN:  1)
//     NO. OF POINTS =   3500  RECORD LENGTH = 35.000 SEC
//     UNITS OF UNCOR ACCEL ARE SEC AND G/10.     MAX  = -0.051 G, AT   3.910 SEC
//     /&  ----------  END OF DATA FOR CHANNEL 1  ----------
//
// The times of Caltech's own files, from digitised films, are uneven. Such files are refused.
//
// Source: files of the networks; the reader of gmprocess (USGS) for them; of the layout, Caltech
// (1969), Strong motion earthquake accelerograms, digitized and plotted data, volume I, part A,
// EERL 70-20.
#include <math.h>

#include "motion/channels.h"
#include "motion/fixed.h"
#include "motion/header.h"

enum { LINE_NAME = 7, LINE_POINTS = 11, LINE_UNITS = 12, HEADER_LINES = 27 };

static const double DURATION_ROUNDING = 0.001;  // [s]

// The variant of a network; words in capitals.
struct variant {
    const char *title;   // in line 1
    const char *units;   // in line 12
    const char *length;  // key of the duration
    const char *none;    // the error of a file without channels
    struct fixed_format format;
};

static const struct variant bhrc = {
    .title = "VOL1DS FILE",
    .units = "UNITS ARE SECONDS AND",
    .length = "DURATION",
    .none = "the file has no line 'VOL1DS FILE'",
    .format = {.n = 10, .width = 13},
};

static const struct variant renadic = {
    .title = "UNCORRECTED ACCELEROGRAM DATA",
    .units = "UNITS OF UNCOR ACCEL",
    .length = "RECORD LENGTH",
    .none = "the file has no line 'UNCORRECTED ACCELEROGRAM DATA'",
    .format = {.n = 5, .width = 7, .timed = true},
};

struct channel {
    struct piece name;
    const struct variant *variant;
};

static bool has_layout(const struct variant *v, const struct record_text *t) {
    struct lines l;
    lines_init(&l, t);
    return lines_next(&l) && lines_contain(l.line, v->title) &&
           lines_contain(lines_at(l, LINE_UNITS).line, v->units);
}

// Goes to the first line of the next channel; false: there is no further channel.
static bool next_channel(struct lines *l, void *channel) {
    struct channel *c = channel;
    while (lines_next(l)) {
        if (lines_contain(l->line, c->variant->title)) {
            c->name = lines_at(*l, LINE_NAME).line;
            return true;
        }
    }
    return false;
}

// Reads the number of values and the time step.
static bool read_sizes(const struct variant *v, const struct record_reader *r,
                       const struct lines *l) {
    struct header_entry points = {"NO. OF POINTS", {0}, l->number};
    struct header_entry length = {v->length, {0}, l->number};
    struct record_content *out = r->out;
    double duration;
    if (!lines_value(l->line, points.key, &points.value) ||
        !lines_value(l->line, length.key, &length.value)) {
        return record_fail(r, l->number, "no '%s =' and '%s ='", points.key, length.key);
    }
    if (!header_take(r, HEADER_COUNT, &points) || !header_positive(r, &length, &duration)) {
        return false;
    }
    if (out->npts > (double)r->text->size) {
        return record_fail(r, l->number, "%.0f values; the file ends before", out->npts);
    }
    const double rate = round(out->npts / duration);
    if (rate < 1 || fabs(out->npts / rate - duration) > DURATION_ROUNDING) {
        return record_fail(r, l->number,
                           "%.0f values in %g s are %g a second; that must be a whole number",
                           out->npts, duration, out->npts / duration);
    }
    out->dt = 1 / rate;
    out->dt_line = l->number;
    return true;
}

// Reads the unit, and the peak against which the values are checked. The peak has its own unit.
static bool read_unit(const struct record_reader *r, const struct lines *l) {
    struct piece rest = lines_behind(l->line, "AND");
    struct header_entry unit = {"UNITS", {0}, l->number}, peak = {"MAX", {0}, l->number};
    if (lines_field(&rest, ".", &unit.value)) {
        header_take(r, HEADER_UNIT, &unit);
    }
    if (!lines_value(l->line, peak.key, &peak.value)) {
        return true;
    }
    const char *end = peak.value.text + peak.value.n;
    rest = (struct piece){end, (size_t)(l->line.text + l->line.n - end)};
    lines_field(&rest, ",", &unit.value);
    const double size = header_unit(r, unit.value);
    return size > 0 ? header_peak(r, &peak, size)
                    : record_fail(r, l->number, "unit '%s' of MAX is not a unit of acceleration",
                                  lines_excerpt(unit.value).text);
}

// Goes over the line `/&`, unless the file ends.
static bool check_end(const struct record_reader *r, struct lines l) {
    while (lines_next(&l)) {
        if (l.line.n > 0) {
            return (l.line.n > 1 && l.line.text[0] == '/' && l.line.text[1] == '&') ||
                   record_fail(r, l.number,
                               "'%s' is where '/&' should end the channel of %zu values",
                               lines_excerpt(l.line).text, r->out->n);
        }
    }
    return true;
}

static bool read_variant(const struct variant *v, const struct record_reader *r) {
    struct channel c = {.variant = v};
    struct lines l;
    if (!channels_seek(r, next_channel, v->none, &l, &c)) {
        return false;
    }
    const struct lines points = lines_at(l, LINE_POINTS), units = lines_at(l, LINE_UNITS);
    l = lines_at(l, HEADER_LINES);
    return read_sizes(v, r, &points) && read_unit(r, &units) && fixed_read(r, &l, &v->format) &&
           check_end(r, l);
}

static bool bhrc_matches(const struct record_text *t) {
    return has_layout(&bhrc, t);
}

static bool bhrc_read(const struct record_reader *r) {
    return read_variant(&bhrc, r);
}

const struct record_format record_bhrc = {
    .name = "bhrc",
    .doc = "BHRC, Iran, volume 1, accelerations of one of its channels",
    .certain = true,
    .channels = true,
    .matches = bhrc_matches,
    .read = bhrc_read,
};

static bool renadic_matches(const struct record_text *t) {
    return has_layout(&renadic, t);
}

static bool renadic_read(const struct record_reader *r) {
    return read_variant(&renadic, r);
}

const struct record_format record_renadic = {
    .name = "renadic",
    .doc = "RENADIC, Chile, volume 1, accelerations of one of its channels",
    .certain = true,
    .channels = true,
    .matches = renadic_matches,
    .read = renadic_read,
};
