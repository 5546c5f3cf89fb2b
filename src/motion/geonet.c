// SPDX-License-Identifier: GPL-3.0-or-later
// GeoNet (New Zealand) V1A, uncorrected, and V2A, corrected: one component after the other. Each
// has 16 lines of text, 4 of integers (10I8), 6 of reals (10F8.0), and its accelerations in mm/s/s
// (10F8.1). In V2A velocities (mm/s) and displacements (mm) follow. These lines of a component are
// read:
//
//      1   Corrected accelerogram 20180212_211554_WPWS_20 GNS Science
//     10   Number of points  5800    Duration 115.98 sec
//     13   Component S16W  Longitudinal Accelerometer Axis
//     14   Acceleration:  peak    -41.6 mm/s/s at  43.68 sec     rms      2.2 mm/s/s
//     20   its integers 4, 5 and 6: numbers of accelerations, velocities and displacements
//     21   its real 8: factor that makes mm/s/s of the values
//     23   its real 6: time step in seconds
//
// Numbers of values, time step and duration must agree with each other and with the lines that
// follow. Values with a factor other than 1 are refused.
//
// Source: GeoNet, Strong motion file formats,
// https://www.geonet.org.nz/data/supplementary/strong_motion_file_formats; W J Cousins (2008), GNS
// accelerogram data files, standard format.
#include <math.h>

#include "motion/channels.h"
#include "motion/fixed.h"
#include "motion/header.h"

enum { LINE_POINTS = 10, LINE_NAME = 13, LINE_PEAK = 14, LINE_COUNTS = 20, LINE_FACTOR = 21 };
enum { LINE_STEP = 23, HEADER_LINES = 26, ROW = 10 };
enum { VELOCITIES, DISPLACEMENTS, N_OTHER };

static const struct fixed_format columns = {.n = ROW, .width = 8};
static const char none[] =
    "the file has no line 'Corrected accelerogram' or 'Uncorrected accelerogram' of 'GNS Science'";
static const double DURATION_ROUNDING = 0.01;  // [s]

// A component: its first line, and the numbers of its other values.
struct component {
    struct piece name;
    struct lines title;
    const struct record_reader *reading;
    double other[N_OTHER];
};

static bool is_title(struct piece line) {
    return lines_contain(line, "GNS SCIENCE") && lines_contain(line, "CORRECTED ACCELEROGRAM");
}

static bool geonet_matches(const struct record_text *t) {
    struct lines l;
    lines_init(&l, t);
    return lines_next(&l) && is_title(l.line);
}

// Goes to the first line of the next component.
static bool next_component(struct lines *l, void *component) {
    struct component *c = component;
    while (lines_next(l)) {
        if (is_title(l->line)) {
            struct piece rest = lines_behind(lines_at(*l, LINE_NAME).line, "COMPONENT");
            lines_field(&rest, "", &c->name);
            c->title = *l;
            return true;
        }
    }
    return false;
}

// The first word after `word` in line `number`, as an entry.
static struct header_entry word_behind(const struct component *c, int number, const char *key,
                                       const char *word) {
    const struct lines l = lines_at(c->title, number);
    struct header_entry entry = {key, {0}, l.number};
    struct piece rest = lines_behind(l.line, word);
    lines_field(&rest, "", &entry.value);
    return entry;
}

// Number `i`, from 1, of a line of integers or reals.
static struct header_entry number(const struct component *c, const char *key, int line, size_t i) {
    return fixed_entry(key, lines_at(c->title, line), &columns, i);
}

static bool read_counts(struct component *c) {
    static const char *const names[] = {"number of velocities", "number of displacements"};
    const struct record_content *out = c->reading->out;
    const struct header_entry count = number(c, "number of accelerations", LINE_COUNTS, 4),
                              told = word_behind(c, LINE_POINTS, "Number of points",
                                                 "NUMBER OF POINTS");
    double points;
    if (!header_take(c->reading, HEADER_COUNT, &count)) {
        return false;
    }
    for (int i = 0; i < N_OTHER; i++) {
        const struct header_entry entry = number(c, names[i], LINE_COUNTS, 5 + (size_t)i);
        double *n = &c->other[i];
        if (!header_number(c->reading, &entry, n)) {
            return false;
        }
        if (*n != floor(*n) || *n < 0 || *n > 1e9) {
            return record_fail(c->reading, entry.line, "%s is %g; it must be a whole number >= 0",
                               names[i], *n);
        }
    }
    return (lines_number(told.value, &points) == NUMBER_OK && points == out->npts) ||
           record_fail(c->reading, told.line, "Number of points '%s'; line %d says %.0f",
                       lines_excerpt(told.value).text, out->count_line, out->npts);
}

// Reads the time step and checks the duration. The duration is n - 1 steps; n steps are accepted
// too.
static bool read_step(const struct component *c) {
    const struct record_content *out = c->reading->out;
    const struct header_entry step = number(c, "time step", LINE_STEP, 6),
                              told = word_behind(c, LINE_POINTS, "Duration", "DURATION");
    double duration;
    if (!header_take(c->reading, HEADER_STEP, &step) ||
        !header_positive(c->reading, &told, &duration)) {
        return false;
    }
    const double wanted = (out->npts - 1) * out->dt;
    return fabs(duration - wanted) <= out->dt + DURATION_ROUNDING ||
           record_fail(c->reading, told.line,
                       "Duration %g s; the time step of %g s (line %d) makes it %g", duration,
                       out->dt, out->dt_line, wanted);
}

// Reads the unit, and the peak against which the values are checked.
static bool read_acceleration(const struct component *c) {
    const struct header_entry factor = number(c, "factor", LINE_FACTOR, 8);
    const struct lines l = lines_at(c->title, LINE_PEAK);
    struct piece rest = lines_behind(l.line, "ACCELERATION:  PEAK");
    struct header_entry peak = {"peak", {0}, l.number}, unit = {"unit", {0}, l.number};
    double x;
    if (!header_number(c->reading, &factor, &x)) {
        return false;
    }
    if (x != 1) {
        return record_fail(c->reading, factor.line,
                           "a factor of %g makes mm/s/s of the values; only files in mm/s/s are "
                           "read",
                           x);
    }
    if (!lines_field(&rest, "", &peak.value) || !lines_field(&rest, "", &unit.value)) {
        return record_fail(c->reading, l.number,
                           "the line has no 'Acceleration:  Peak' with its unit");
    }
    return header_take(c->reading, HEADER_UNIT, &unit) &&
           header_take(c->reading, HEADER_PEAK, &peak);
}

// Checks that the lines of velocities and displacements follow, and no further accelerations.
static bool check_end(const struct component *c, struct lines l) {
    const double rows = ceil(c->other[VELOCITIES] / ROW) + ceil(c->other[DISPLACEMENTS] / ROW);
    double n = 0;
    while (lines_next(&l) && !is_title(l.line)) {
        n += l.line.n > 0;
    }
    return n == rows || record_fail(c->reading, c->reading->out->count_line,
                                    "%.0f lines follow the accelerations; %.0f velocities and "
                                    "%.0f displacements fill %.0f",
                                    n, c->other[VELOCITIES], c->other[DISPLACEMENTS], rows);
}

static bool geonet_read(const struct record_reader *r) {
    struct component c = {.reading = r};
    struct lines l;
    return channels_seek(r, next_component, none, &l, &c) && header_skip(r, &l, HEADER_LINES) &&
           read_counts(&c) && read_step(&c) && read_acceleration(&c) &&
           fixed_read(r, &l, &columns) && check_end(&c, l);
}

const struct record_format record_geonet = {
    .name = "geonet",
    .doc = "GeoNet, New Zealand, V1A and V2A, accelerations of one of their components",
    .certain = true,
    .channels = true,
    .matches = geonet_matches,
    .read = geonet_read,
};
