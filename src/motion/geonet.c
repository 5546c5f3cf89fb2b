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
    const struct record_text *text;
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
static int read_lines(struct component *c, struct lines l, struct error *e) {
    for (int i = 1; i <= HEADER_LINES; i++) {
        c->line[i] = l;
        if (i < HEADER_LINES && !lines_next(&l)) {
            return lines_error(e, c->text->path, l.number,
                               "the file ends after %d of the %d lines of a header", i,
                               HEADER_LINES);
        }
    }
    return STATUS_OK;
}

// The first word after `word` in line `i`.
static struct piece word_behind(const struct component *c, int i, const char *word) {
    struct piece rest = lines_behind(c->line[i].line, word);
    struct piece field;
    lines_field(&rest, "", &field);
    return field;
}

// Number `i`, from 1, of a line of integers or reals.
static int read_number(const struct component *c, int line, size_t i, double *value,
                       struct error *e) {
    const struct lines *l = &c->line[line];
    const struct number_field f = {c->text, l->number, "number", i,
                                   fixed_field(l->whole, &columns, i - 1)};
    return lines_read_number(&f, value, e);
}

static int read_counts(struct component *c, struct error *e) {
    const int line = c->line[LINE_COUNTS].number;
    for (int i = 0; i < N_KIND; i++) {
        const double least = i == ACCELERATIONS ? 2 : 0;
        double *n = &c->count[i];
        const int status = read_number(c, LINE_COUNTS, 4 + (size_t)i, n, e);
        if (status != STATUS_OK) {
            return status;
        }
        if (*n != floor(*n) || *n < least || *n > 1e9) {
            return lines_error(e, c->text->path, line,
                               "number %d is %g; it must be a number of values, whole and at "
                               "least %g",
                               4 + i, *n, least);
        }
    }
    double points;
    const struct piece told = word_behind(c, LINE_POINTS, "NUMBER OF POINTS");
    return lines_number(told, &points) == NUMBER_OK && points == c->count[ACCELERATIONS]
               ? STATUS_OK
               : lines_error(e, c->text->path, c->line[LINE_POINTS].number,
                             "Number of points '%s'; line %d says %.0f", lines_excerpt(told).text,
                             line, c->count[ACCELERATIONS]);
}

// Reads the time step and checks the duration. The duration is n - 1 steps; n steps are accepted
// too.
static int read_step(const struct component *c, struct record_content *out, struct error *e) {
    const struct header h = {.text = c->text};
    const int line = c->line[LINE_STEP].number;
    int status = read_number(c, LINE_STEP, 6, &out->dt, e);
    if (status == STATUS_OK && out->dt <= 0) {
        status =
            lines_error(e, c->text->path, line, "a time step of %g s; it must be > 0", out->dt);
    }
    if (status != STATUS_OK) {
        return status;
    }
    out->dt_line = line;
    double told;
    const double duration = (c->count[ACCELERATIONS] - 1) * out->dt;
    const struct header_entry entry = {"Duration", word_behind(c, LINE_POINTS, "DURATION"),
                                       c->line[LINE_POINTS].number};
    status = header_read_positive(&h, &entry, entry.value, &told, e);
    return status != STATUS_OK || fabs(told - duration) <= out->dt + DURATION_ROUNDING
               ? status
               : lines_error(e, c->text->path, entry.line,
                             "Duration %g s; the time step of %g s (line %d) makes it %g", told,
                             out->dt, line, duration);
}

// Reads the unit, and the peak against which the values are checked.
static int read_acceleration(const struct record_request *request, const struct component *c,
                             struct record_content *out, struct error *e) {
    const struct header h = {.text = c->text};
    struct piece rest = lines_behind(c->line[LINE_PEAK].line, "ACCELERATION:  PEAK");
    struct piece peak = {0}, unit = {0};
    double factor;
    int status = read_number(c, LINE_FACTOR, 8, &factor, e);
    if (status == STATUS_OK && factor != 1) {
        status = lines_error(e, c->text->path, c->line[LINE_FACTOR].number,
                             "a factor of %g makes mm/s/s of the values; only files in mm/s/s are "
                             "read",
                             factor);
    }
    if (status == STATUS_OK && (!lines_field(&rest, "", &peak) || !lines_field(&rest, "", &unit))) {
        status = lines_error(e, c->text->path, c->line[LINE_PEAK].number,
                             "the line has no 'Acceleration:  Peak' with its unit");
    }
    if (status != STATUS_OK) {
        return status;
    }
    const struct header_entry entry = {"peak", peak, c->line[LINE_PEAK].number};
    header_read_unit(request, &entry, unit, out);
    return header_read_peak(&h, &entry, peak, out, e);
}

// Checks that the lines of velocities and displacements follow, and no further accelerations.
static int check_end(const struct component *c, struct lines l, struct error *e) {
    const double rows = ceil(c->count[VELOCITIES] / ROW) + ceil(c->count[DISPLACEMENTS] / ROW);
    double n = 0;
    while (lines_next(&l) && !is_title(l.line)) {
        n += l.line.n > 0;
    }
    return n == rows ? STATUS_OK
                     : lines_error(e, c->text->path, c->line[LINE_COUNTS].number,
                                   "%.0f lines follow the accelerations; %.0f velocities and %.0f "
                                   "displacements fill %.0f",
                                   n, c->count[VELOCITIES], c->count[DISPLACEMENTS], rows);
}

static int geonet_read(struct arena *a, const struct record_request *request,
                       const struct record_text *t, struct record_content *out, struct error *e) {
    struct component c = {.text = t};
    struct fixed_format format = columns;
    struct lines l;
    struct piece name;
    int status = channels_seek(request, t, next_component, none, &l, out, e);
    if (status == STATUS_OK) {
        next_component(&l, &name);
        status = read_lines(&c, l, e);
    }
    if (status == STATUS_OK) {
        status = read_counts(&c, e);
    }
    if (status == STATUS_OK) {
        status = read_step(&c, out, e);
    }
    if (status == STATUS_OK) {
        status = read_acceleration(request, &c, out, e);
    }
    if (status != STATUS_OK) {
        return status;
    }
    format.stated = c.line[LINE_COUNTS].number;
    l = c.line[HEADER_LINES];
    status = fixed_read(a, t, &l, &format, (size_t)c.count[ACCELERATIONS], out, e);
    return status == STATUS_OK ? check_end(&c, l, e) : status;
}

const struct record_format record_geonet = {
    .name = "geonet",
    .doc = "GeoNet, New Zealand, V1A and V2A, accelerations of one of their components",
    .certain = true,
    .channels = true,
    .matches = geonet_matches,
    .read = geonet_read,
};
