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
enum { ACCELERATIONS, VELOCITIES, DISPLACEMENTS, N_KIND };

static const struct fixed_format columns = {.n = ROW, .width = 8};
static const char none[] =
    "the file has no line 'Corrected accelerogram' or 'Uncorrected accelerogram' of 'GNS Science'";
static const double DURATION_ROUNDING = 0.01;  // [s]

// A component: numbers of its lines, and their content.
struct component {
    const struct record_reader *reading;
    struct lines line[HEADER_LINES + 1];
    double count[N_KIND];
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
static bool next_component(struct lines *l, struct piece *name) {
    while (lines_next(l)) {
        if (is_title(l->line)) {
            struct lines at = *l;
            for (int i = 1; i < LINE_NAME && lines_next(&at); i++) {
            }
            struct piece rest = lines_behind(at.line, "COMPONENT");
            lines_field(&rest, "", name);
            return true;
        }
    }
    return false;
}

// Reads the lines of the component that begins at the current line of `l`.
static bool read_lines(struct component *c, struct lines l) {
    for (int i = 1; i <= HEADER_LINES; i++) {
        c->line[i] = l;
        if (i < HEADER_LINES && !lines_next(&l)) {
            return record_fail(c->reading, l.number,
                               "the file ends after %d of the %d lines of a header", i,
                               HEADER_LINES);
        }
    }
    return true;
}

// The first word after `word` in line `i`.
static struct piece word_behind(const struct component *c, int i, const char *word) {
    struct piece rest = lines_behind(c->line[i].line, word);
    struct piece field;
    lines_field(&rest, "", &field);
    return field;
}

// Number `i`, from 1, of a line of integers or reals.
static bool read_number(const struct component *c, int line, size_t i, double *value) {
    const struct lines *l = &c->line[line];
    const struct number_field f = {c->reading->text, l->number, "number", i,
                                   fixed_field(l->whole, &columns, i - 1)};
    return record_number(c->reading, &f, value);
}

static bool read_counts(struct component *c) {
    const int line = c->line[LINE_COUNTS].number;
    for (int i = 0; i < N_KIND; i++) {
        const double least = i == ACCELERATIONS ? 2 : 0;
        double *n = &c->count[i];
        if (!read_number(c, LINE_COUNTS, 4 + (size_t)i, n)) {
            return false;
        }
        if (*n != floor(*n) || *n < least || *n > 1e9) {
            return record_fail(c->reading, line,
                               "number %d is %g; it must be a number of values, whole and at "
                               "least %g",
                               4 + i, *n, least);
        }
    }
    double points;
    const struct piece told = word_behind(c, LINE_POINTS, "NUMBER OF POINTS");
    return (lines_number(told, &points) == NUMBER_OK && points == c->count[ACCELERATIONS]) ||
           record_fail(c->reading, c->line[LINE_POINTS].number,
                       "Number of points '%s'; line %d says %.0f", lines_excerpt(told).text, line,
                       c->count[ACCELERATIONS]);
}

// Reads the time step and checks the duration. The duration is n - 1 steps; n steps are accepted
// too.
static bool read_step(const struct component *c) {
    const int line = c->line[LINE_STEP].number;
    double *dt = &c->reading->out->dt;
    if (!read_number(c, LINE_STEP, 6, dt)) {
        return false;
    }
    if (*dt <= 0) {
        return record_fail(c->reading, line, "a time step of %g s; it must be > 0", *dt);
    }
    c->reading->out->dt_line = line;
    double told;
    const double duration = (c->count[ACCELERATIONS] - 1) * *dt;
    const struct header_entry entry = {"Duration", word_behind(c, LINE_POINTS, "DURATION"),
                                       c->line[LINE_POINTS].number};
    return header_read_positive(c->reading, &entry, entry.value, &told) &&
           (fabs(told - duration) <= *dt + DURATION_ROUNDING ||
            record_fail(c->reading, entry.line,
                        "Duration %g s; the time step of %g s (line %d) makes it %g", told, *dt,
                        line, duration));
}

// Reads the unit, and the peak against which the values are checked.
static bool read_acceleration(const struct component *c) {
    const int line = c->line[LINE_PEAK].number;
    struct piece rest = lines_behind(c->line[LINE_PEAK].line, "ACCELERATION:  PEAK");
    struct piece peak = {0}, unit = {0};
    double factor;
    if (!read_number(c, LINE_FACTOR, 8, &factor)) {
        return false;
    }
    if (factor != 1) {
        return record_fail(c->reading, c->line[LINE_FACTOR].number,
                           "a factor of %g makes mm/s/s of the values; only files in mm/s/s are "
                           "read",
                           factor);
    }
    if (!lines_field(&rest, "", &peak) || !lines_field(&rest, "", &unit)) {
        return record_fail(c->reading, line, "the line has no 'Acceleration:  Peak' with its unit");
    }
    header_read_unit(c->reading, line, unit);
    return header_read_peak(c->reading, &(struct header_entry){"peak", peak, line}, peak, 0);
}

// Checks that the lines of velocities and displacements follow, and no further accelerations.
static bool check_end(const struct component *c, struct lines l) {
    const double rows = ceil(c->count[VELOCITIES] / ROW) + ceil(c->count[DISPLACEMENTS] / ROW);
    double n = 0;
    while (lines_next(&l) && !is_title(l.line)) {
        n += l.line.n > 0;
    }
    return n == rows || record_fail(c->reading, c->line[LINE_COUNTS].number,
                                    "%.0f lines follow the accelerations; %.0f velocities and "
                                    "%.0f displacements fill %.0f",
                                    n, c->count[VELOCITIES], c->count[DISPLACEMENTS], rows);
}

static bool geonet_read(const struct record_reader *r) {
    struct component c = {.reading = r};
    struct fixed_format format = columns;
    struct lines l;
    struct piece name;
    if (!channels_seek(r, next_component, none, &l)) {
        return false;
    }
    next_component(&l, &name);
    if (!read_lines(&c, l) || !read_counts(&c) || !read_step(&c) || !read_acceleration(&c)) {
        return false;
    }
    format.stated = c.line[LINE_COUNTS].number;
    l = c.line[HEADER_LINES];
    return fixed_read(r, &l, &format, (size_t)c.count[ACCELERATIONS]) && check_end(&c, l);
}

const struct record_format record_geonet = {
    .name = "geonet",
    .doc = "GeoNet, New Zealand, V1A and V2A, accelerations of one of their components",
    .certain = true,
    .channels = true,
    .matches = geonet_matches,
    .read = geonet_read,
};
