// SPDX-License-Identifier: GPL-3.0-or-later
// SMC of the USGS, corrected accelerations: 11 lines of text, 6 of integers (8I10), 10 of reals
// (5E15.7), lines of comment that begin with a |, and values in cm/s/s in fields of 10 that touch.
// These lines and numbers are read:
//
//     line 1         2 CORRECTED ACCELEROGRAM
//     integer 16     number of lines of comment
//     integer 17     number of values
//     real 2         samples a second
//     real 30, 32    largest and smallest value; 1.7E+38: not known
//
// Uncorrected accelerations have uneven times. They are refused, and so are velocities,
// displacements and spectra. The first line names the kind.
//
// Source: USGS National Strong-Motion Project, SMC-format data files,
// http://escweb.wr.usgs.gov/nsmp-data/smcfmt.html; files of the USGS.
#include <math.h>

#include "motion/fixed.h"
#include "motion/header.h"

enum { INTEGER_LINE = 12, REAL_LINE = 18, HEADER_LINES = 27 };
enum { INT_COMMENTS = 16, INT_VALUES = 17, REAL_RATE = 2, REAL_LARGEST = 30, REAL_SMALLEST = 32 };

static const struct fixed_format integers = {.n = 8, .width = 10};
static const struct fixed_format reals = {.n = 5, .width = 15};
static const struct fixed_format values = {.n = 8, .width = 10, .stated = 14};
static const double UNKNOWN = 1e38;
static const double ROUNDING = 1e-4;  // of values of five digits

struct smc {
    const struct record_reader *reading;
    struct lines line[HEADER_LINES + 1];
};

static bool is_title(struct piece line) {
    return lines_contain(line, "2 CORRECTED ACCELEROGRAM") && line.text[0] == '2';
}

static bool smc_matches(const struct record_text *t) {
    struct lines l;
    lines_init(&l, t);
    return lines_next(&l) && is_title(l.line);
}

static bool read_lines(struct smc *s) {
    struct lines l;
    lines_init(&l, s->reading->text);
    for (int i = 1; i <= HEADER_LINES; i++) {
        if (!lines_next(&l)) {
            return record_fail(s->reading, l.number,
                               "the file ends after %d of the %d lines of a header", i - 1,
                               HEADER_LINES);
        }
        s->line[i] = l;
    }
    return is_title(s->line[1].line) ||
           record_fail(s->reading, 1, "the line has no \'2 CORRECTED ACCELEROGRAM'");
}

// Number `i`, from 1, in the fields of this format that begin in line `first`.
static struct header_entry number(const struct smc *s, const char *key, int first,
                                  const struct fixed_format *format, size_t i) {
    const int line = first + (int)((i - 1) / format->n);
    return (struct header_entry){key, fixed_field(s->line[line].whole, format, (i - 1) % format->n),
                                 line};
}

static bool read_rate(const struct smc *s) {
    const struct header_entry entry = number(s, "samples a second", REAL_LINE, &reals, REAL_RATE);
    double rate;
    if (!header_read_positive(s->reading, &entry, entry.value, &rate)) {
        return false;
    }
    s->reading->out->dt = 1 / rate;
    s->reading->out->dt_line = entry.line;
    return true;
}

static bool read_peak(const struct smc *s) {
    static const size_t places[] = {REAL_LARGEST, REAL_SMALLEST};
    struct record_content *out = s->reading->out;
    for (int i = 0; i < 2; i++) {
        const struct header_entry entry = number(s, "peak", REAL_LINE, &reals, places[i]);
        double peak;
        if (!header_read_number(s->reading, &entry, entry.value, &peak)) {
            return false;
        }
        if (fabs(peak) < UNKNOWN && fabs(peak) > out->stated_peak) {
            out->stated_peak = fabs(peak);
            out->stated_rounding = ROUNDING * fabs(peak);
            out->stated_line = entry.line;
        }
    }
    return true;
}

// Goes over the lines of comment, to the last of them.
static bool skip_comments(const struct smc *s, struct lines *l) {
    const struct header_entry entry =
        number(s, "number of comments", INTEGER_LINE, &integers, INT_COMMENTS);
    double told;
    int n = 0;
    for (struct lines next = *l; lines_next(&next) && next.line.n > 0 && next.line.text[0] == '|';
         n++) {
        *l = next;
    }
    return header_read_number(s->reading, &entry, entry.value, &told) &&
           (told == n ||
            record_fail(s->reading, entry.line,
                        "the header states %.0f lines of comment; %d lines begin with a |", told,
                        n));
}

static bool smc_read(const struct record_reader *r) {
    struct smc s = {.reading = r};
    double n;
    if (!read_lines(&s)) {
        return false;
    }
    const struct header_entry count =
        number(&s, "number of values", INTEGER_LINE, &integers, INT_VALUES);
    if (!header_read_count(r, &count, &n) || !read_rate(&s) || !read_peak(&s)) {
        return false;
    }
    header_read_unit(r, 1, (struct piece){"cm/s/s", 6});
    struct lines l = s.line[HEADER_LINES];
    return skip_comments(&s, &l) && fixed_read(r, &l, &values, (size_t)n) &&
           fixed_check_end(r, l, &values);
}

const struct record_format record_smc = {
    .name = "smc",
    .doc = "SMC (USGS), corrected accelerations",
    .certain = true,
    .matches = smc_matches,
    .read = smc_read,
};
