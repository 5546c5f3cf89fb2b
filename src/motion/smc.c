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
static const struct fixed_format values = {.n = 8, .width = 10};
static const double UNKNOWN = 1e38;
static const double ROUNDING = 1e-4;  // of values of five digits

static bool is_title(struct piece line) {
    return lines_contain(line, "2 CORRECTED ACCELEROGRAM") && line.text[0] == '2';
}

static bool smc_matches(const struct record_text *t) {
    struct lines l;
    lines_init(&l, t);
    return lines_next(&l) && is_title(l.line);
}

static bool read_peak(const struct record_reader *r, struct lines reals_at) {
    static const size_t places[] = {REAL_LARGEST, REAL_SMALLEST};
    struct record_content *out = r->out;
    for (int i = 0; i < 2; i++) {
        const struct header_entry entry = fixed_entry("peak", reals_at, &reals, places[i]);
        double peak;
        if (!header_number(r, &entry, &peak)) {
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
static bool skip_comments(const struct record_reader *r, const struct header_entry *stated,
                          struct lines *l) {
    double told;
    int n = 0;
    for (struct lines next = *l; lines_next(&next) && next.line.n > 0 && next.line.text[0] == '|';
         n++) {
        *l = next;
    }
    return header_number(r, stated, &told) &&
           (told == n ||
            record_fail(r, stated->line,
                        "the header states %.0f lines of comment; %d lines begin with a |", told,
                        n));
}

static bool smc_read(const struct record_reader *r) {
    struct lines title, l;
    lines_init(&title, r->text);
    lines_next(&title);
    l = title;
    if (!header_skip(r, &l, HEADER_LINES)) {
        return false;
    }
    if (!is_title(title.line)) {
        return record_fail(r, 1, "the line has no '2 CORRECTED ACCELEROGRAM'");
    }
    const struct lines whole = lines_at(title, INTEGER_LINE), real = lines_at(title, REAL_LINE);
    const struct header_entry count = fixed_entry("number of values", whole, &integers, INT_VALUES),
                              comments =
                                  fixed_entry("number of comments", whole, &integers, INT_COMMENTS),
                              rate = fixed_entry("samples a second", real, &reals, REAL_RATE),
                              unit = {"unit", {"cm/s/s", 6}, 1};
    return header_take(r, HEADER_COUNT, &count) && header_take(r, HEADER_RATE, &rate) &&
           read_peak(r, real) && header_take(r, HEADER_UNIT, &unit) &&
           skip_comments(r, &comments, &l) && fixed_read(r, &l, &values) &&
           fixed_check_end(r, l, &values);
}

const struct record_format record_smc = {
    .name = "smc",
    .doc = "SMC (USGS), corrected accelerations",
    .certain = true,
    .matches = smc_matches,
    .read = smc_read,
};
