// SPDX-License-Identifier: GPL-3.0-or-later
// COSMOS 1.20: one channel after the other. Each has 13 lines of text, 100 integers, 100 reals,
// lines of comment and the values. Velocities and displacements may follow, with or without their
// own headers. These lines are read:
//
//     Corrected acceleration    (Format v01.20 with 13 text lines) Src: ...
//     Sta Chan   1: 90 deg (Rcrdr Chan  1) Location: ...                     the name
//     Processed: 06/17/2005, 12:01:00 PDT      Max =  -161.962 cm/sec2  at  27.850 sec
//     Values used when parameter or data value is unknown/unspecified:   -999, -999.0
//      100 Real-header values follow on  17 lines, Format= (6F13.6)          real 62: step in ms
//        7000  acceleration pts, approx   70 secs, units=cm/sec2(04),Format=(8F10.5)
//
// The step must agree with the number of values and their duration, which the file gives in
// seconds. Volume 0 (counts of a recorder) is refused: the factors in its header belong to parts of
// the instrument, and not every network gives them.
//
// Source: COSMOS Strong Motion Data Format, Ver. 1.20 (2001), www.cosmos-eq.org.
#include <math.h>
#include <string.h>

#include "motion/channels.h"
#include "motion/fixed.h"
#include "motion/header.h"

enum { REAL_STEP = 62 };

static const char none[] = "the file has no line 'acceleration pts' with 'units=' and 'Format='";
static const double DURATION_ROUNDING = 1;  // [s]

// A channel: its lines in the file and what its text says.
struct channel {
    struct piece name;           // `90 deg`; empty: the file has no name
    struct lines reals, values;  // at the lines before them; number 0: there is none
    struct header_entry peak;    // empty value: the file states no peak
    struct piece peak_unit;
    struct header_entry unknown;  // the text for an unknown value
};

static bool is_title(struct piece line) {
    return lines_contain(line, "(FORMAT V") && lines_contain(line, "TEXT LINES");
}

static bool cosmos_matches(const struct record_text *t) {
    struct lines l;
    lines_init(&l, t);
    return lines_next(&l) && is_title(l.line);
}

static void note_text(struct channel *c, const struct lines *l) {
    struct piece rest;
    if (is_title(l->line)) {
        *c = (struct channel){0};
    } else if (lines_contain(l->line, "REAL-HEADER VALUES")) {
        c->reals = *l;
    } else if ((rest = lines_behind(l->line, "STA CHAN")).n > 0 ||
               (rest = lines_behind(l->line, "STA CHA")).n > 0) {
        // The name is `90 deg` in `   1: 90 deg (Rcrdr Chan  1) Location: ...`.
        const char *bracket = memchr(rest.text, '(', rest.n);
        rest.n = bracket ? (size_t)(bracket - rest.text) : rest.n;
        for (const char *colon; (colon = memchr(rest.text, ':', rest.n));) {
            rest.n -= (size_t)(colon + 1 - rest.text);
            rest.text = colon + 1;
        }
        c->name = lines_trim(rest);
    } else if (lines_word(l->line, "PROCESSED") && lines_value(l->line, "MAX", &rest)) {
        c->peak = (struct header_entry){"Max", rest, l->number};
        rest.n = (size_t)(l->line.text + l->line.n - rest.text);
        lines_field(&rest, "", &c->peak_unit);
        lines_field(&rest, "", &c->peak_unit);
    } else {
        rest = lines_behind(l->line, "UNKNOWN/UNSPECIFIED");
        for (struct piece field; lines_field(&rest, ":,", &field);) {
            c->unknown = (struct header_entry){"unknown", field, l->number};
        }
    }
}

// Goes to the next line before accelerations; false: there is no further channel.
static bool next_channel(struct lines *l, void *channel) {
    struct channel *c = channel;
    *c = (struct channel){0};
    while (lines_next(l)) {
        if (lines_contain(l->line, " ACC") && lines_contain(l->line, " PTS") &&
            lines_contain(l->line, "UNITS=")) {
            c->values = *l;
            return true;
        }
        note_text(c, l);
    }
    return false;
}

// If the header gives no time step, the user must give it.
static bool read_step(const struct record_reader *r, const struct channel *c, double unknown) {
    struct fixed_format format;
    struct lines l = c->reals;
    if (l.number == 0 || !fixed_format_find(l.line, &format)) {
        return record_fail(
            r, c->values.number,
            "the header has no line 'Real-header values follow' with a format above it");
    }
    if (!lines_next(&l)) {
        return record_fail(r, l.number, "the file ends within its reals");
    }
    const struct header_entry entry = fixed_entry("real 62", l, &format, REAL_STEP);
    double step;
    if (!header_number(r, &entry, &step)) {
        return false;
    }
    if (step <= 0 && step != unknown) {
        return record_fail(r, entry.line, "a time step of %g ms; it must be > 0", step);
    }
    r->out->dt = step == unknown ? 0 : step / 1000;
    r->out->dt_line = entry.line;
    return true;
}

static bool read_count(const struct record_reader *r, const struct channel *c) {
    const struct record_content *out = r->out;
    struct header_entry entry = {.key = "number of values", .line = c->values.number};
    struct piece rest = c->values.line;
    struct piece approx = lines_behind(c->values.line, "APPROX");
    struct piece told;
    double duration;
    lines_field(&rest, "", &entry.value);
    if (!header_take(r, HEADER_COUNT, &entry)) {
        return false;
    }
    return !lines_field(&approx, "", &told) || lines_number(told, &duration) != NUMBER_OK ||
           out->dt == 0 || fabs(out->npts * out->dt - duration) <= DURATION_ROUNDING + out->dt ||
           record_fail(r, entry.line,
                       "%.0f values in approx %g s; the time step of %g s (line %d) makes it %g",
                       out->npts, duration, out->dt, out->dt_line, out->npts * out->dt);
}

static bool read_unit(const struct record_reader *r, const struct channel *c) {
    struct piece rest = lines_behind(c->values.line, "UNITS");
    struct header_entry unit = {"units", {0}, c->values.number};
    lines_field(&rest, "=", &unit.value);
    lines_field(&rest, "(,", &unit.value);
    if (lines_contain(unit.value, "COUNT")) {
        return record_fail(r, c->values.number,
                           "the values are counts of a recorder (volume 0), which are not "
                           "converted; volumes 1 and 2 hold accelerations");
    }
    return header_take(r, HEADER_UNIT, &unit);
}

static bool check_unknown(const struct record_reader *r, const struct channel *c, double unknown) {
    for (size_t i = 0; i < r->out->n; i++) {
        if (r->out->value[i] == unknown) {
            return record_fail(r, c->values.number,
                               "value %zu of those below is %g, which marks a value that is not "
                               "known (line %d)",
                               i + 1, unknown, c->unknown.line);
        }
    }
    return true;
}

static bool cosmos_read(const struct record_reader *r) {
    struct channel c;
    struct fixed_format format;
    struct lines l;
    double unknown;
    if (!channels_seek(r, next_channel, none, &l, &c)) {
        return false;
    }
    if (lines_number(c.unknown.value, &unknown) != NUMBER_OK) {
        unknown = -999;
    }
    if (!read_unit(r, &c) || !read_step(r, &c, unknown) || !read_count(r, &c) ||
        !header_peak(r, &c.peak, header_unit(r, c.peak_unit))) {
        return false;
    }
    if (!fixed_format_find(c.values.line, &format)) {
        return record_fail(r, c.values.number, "the line has no format such as (8F10.5)");
    }
    return fixed_read(r, &l, &format) && fixed_check_end(r, l, &format) &&
           check_unknown(r, &c, unknown);
}

const struct record_format record_cosmos = {
    .name = "cosmos",
    .doc = "COSMOS 1.20, volumes 1 and 2, accelerations of one of their channels",
    .certain = true,
    .channels = true,
    .matches = cosmos_matches,
    .read = cosmos_read,
};
