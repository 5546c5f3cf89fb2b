// SPDX-License-Identifier: GPL-3.0-or-later
// CSMIP/CGS volume 1 and 2, and USC volume 2: one channel after the other. Each has lines of text,
// headers of integers and of reals, and its values. The line before the values has their number,
// the time step and the unit:
//
//      31932 Accelerogram points at 100 pts/sec in units of g.       Format: (8f9.6)     volume 1
//      3251 POINTS OF ACCEL DATA EQUALLY SPACED AT  .020 SEC.  (UNITS: CM/SEC/SEC)       volume 2
//      1887 POINTS OF ACC DATA EQUALLY SPACED AT   .020 SEC.  IN UNITS CM/SEC/SEC        of USC
//
// Values of volume 2 are (8F10.3). The velocities and displacements after them are not read. The
// lines of text have the name of the channel, `CHAN  1:  90 DEG` or for USC `COMP N08W`, and its
// peak, `MAX  =   .344 G` or `PEAK ACCELERATION =  -267.957`. The values are checked against this
// peak. The headers of numbers repeat the lines of text and are skipped.
//
// Source: Shakal & Huang (1985), Standard tape format for CSMIP strong-motion data tapes, OSMS
// 85-03. Volume 1 is read as written later, with `pts/sec`; a file with a time for every value is
// refused. For USC: its files, and the reader of gmprocess (USGS).
#include <math.h>
#include <string.h>

#include "motion/channels.h"
#include "motion/fixed.h"
#include "motion/header.h"

enum { TITLE_LINES = 3, SEARCHED_LINES_MAX = 200 };

static const char none[] =
    "the file has no line 'accelerogram points at' or 'points of accel data'";
static const char volume_1[] = "ACCELEROGRAM POINTS AT";
static const char volume_2[] = "POINTS OF ACCEL DATA EQUALLY SPACED AT";
static const char volume_2_usc[] = "POINTS OF ACC DATA EQUALLY SPACED AT";

// A channel: its names and its place in the file.
struct channel {
    struct piece name;         // `CHAN  1:  90 DEG`, `N08W`; empty: no name
    struct lines title;        // at the line before the values
    struct header_entry peak;  // empty value: the file states no peak
};

static bool is_volume_2(struct piece line) {
    return lines_contain(line, volume_2) || lines_contain(line, volume_2_usc);
}

static bool is_title(struct piece line) {
    return lines_contain(line, volume_1) || is_volume_2(line);
}

static bool csmip_matches(const struct record_text *t) {
    struct lines l;
    lines_init(&l, t);
    bool is_accelerogram = false;
    while (l.number < SEARCHED_LINES_MAX && lines_next(&l)) {
        is_accelerogram |= l.number <= TITLE_LINES && lines_contain(l.line, "CORRECTED ACCELERO");
        if (is_accelerogram && is_title(l.line)) {
            return true;
        }
    }
    return false;
}

// Goes to the next line before accelerations; false: there is no further channel.
static bool next_channel(struct lines *l, void *channel) {
    struct channel *c = channel;
    *c = (struct channel){0};
    while (lines_next(l)) {
        if (is_title(l->line)) {
            c->title = *l;
            return true;
        }
        // A line of text may have the name or the peak of the channel.
        const char *name = lines_word(l->line, "CHAN");
        if (name && memchr(name, ':', (size_t)(l->line.text + l->line.n - name))) {
            c->name = (struct piece){name, (size_t)(l->line.text + l->line.n - name)};
        }
        struct piece component = lines_behind(l->line, "COMP");
        if (c->name.n == 0) {
            lines_field(&component, "", &c->name);
        }
        struct piece peak;
        if (lines_value(l->line, "PEAK ACCELERATION", &peak) ||
            (!lines_word(l->line, "UNCOR MAX") && lines_value(l->line, "MAX", &peak))) {
            c->peak = (struct header_entry){"peak", peak, l->number};
        }
    }
    return false;
}

// Reads the number of values and the time step from the line before the values.
static bool read_sizes(const struct record_reader *r, const struct lines *l) {
    struct header_entry count = {"number of values", {0}, l->number},
                        step = {"the number after AT", {0}, l->number};
    struct piece rest = l->line, spacing = lines_behind(l->line, "AT"), unit;
    lines_field(&rest, "", &count.value);
    lines_field(&spacing, "", &step.value);
    lines_field(&spacing, ".,", &unit);
    const bool rate = unit.n == 7 && lines_contain(unit, "PTS/SEC");
    if (!rate && (unit.n != 3 || !lines_contain(unit, "SEC"))) {
        return record_fail(r, l->number, "'%s' is neither SEC nor PTS/SEC",
                           lines_excerpt(unit).text);
    }
    return header_take(r, HEADER_COUNT, &count) &&
           header_take(r, rate ? HEADER_RATE : HEADER_STEP, &step);
}

static void read_unit(const struct record_reader *r, const struct lines *l) {
    static const char *const before[] = {"UNITS OF", "UNITS:", "IN UNITS", "IN"};
    struct header_entry unit = {"unit", {0}, l->number};
    struct piece rest = {0};
    for (int i = 0; i < 4 && rest.n == 0; i++) {
        rest = lines_behind(l->line, before[i]);
    }
    if (lines_field(&rest, ".,)", &unit.value)) {
        header_take(r, HEADER_UNIT, &unit);
    }
}

// The last format in brackets. For volume 2 it is (8F10.3) if the line has no format.
static bool read_format(const struct record_reader *r, const struct lines *l,
                        struct fixed_format *format) {
    if (fixed_format_find(l->line, format)) {
        return true;
    }
    *format = (struct fixed_format){.n = 8, .width = 10, .decimals = 3};
    return is_volume_2(l->line) ||
           record_fail(r, l->number, "the line has no format such as (8F9.6)");
}

static bool csmip_read(const struct record_reader *r) {
    struct channel c;
    struct fixed_format format = {.decimals = 0};
    struct lines l;
    if (!channels_seek(r, next_channel, none, &l, &c)) {
        return false;
    }
    if (!read_sizes(r, &c.title) || !read_format(r, &c.title, &format) ||
        !header_take(r, HEADER_PEAK, &c.peak)) {
        return false;
    }
    if (format.decimals > 0) {
        r->out->stated_rounding = fmax(r->out->stated_rounding, pow(10, -(double)format.decimals));
    }
    read_unit(r, &c.title);
    l = c.title;
    return fixed_read(r, &l, &format) && fixed_check_end(r, l, &format);
}

const struct record_format record_csmip = {
    .name = "csmip",
    .doc = "CSMIP/CGS volume 1 and 2, accelerations of one of their channels",
    .certain = true,
    .channels = true,
    .matches = csmip_matches,
    .read = csmip_read,
};
