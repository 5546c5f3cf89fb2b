// SPDX-License-Identifier: GPL-3.0-or-later
// K-NET and KiK-net ASCII (NIED, Japan): one component in each file. The header has 17 lines, with
// the value of each from column 19 on. These lines are read:
//
//     Sampling Freq(Hz) 100Hz
//     Duration Time(s)  102
//     Scale Factor      3920(gal)/6182761      the acceleration of one count
//     Max. Acc. (gal)   4.078                  about the mean
//     Memo.                                    the last line, maybe with a remark
//
// The values follow in whole counts, eight in a line. Their number is rate times duration. They are
// not corrected: their offset may be many times the largest acceleration.
//
// Source: NIED, https://www.kyoshin.bosai.go.jp, and the reader of ObsPy, obspy.io.nied.knet.
#include <math.h>
#include <string.h>

#include "motion/header.h"
#include "motion/values.h"

enum { HEADER_LINES_MAX = 32 };

// The number of samples a second, `100Hz`.
static bool read_rate(const struct header *h, double *rate) {
    struct header_entry entry;
    if (!header_text(h, "Sampling Freq(Hz)", &entry)) {
        return false;
    }
    struct piece number = entry.value;
    if (number.n > 2 && memcmp(number.text + number.n - 2, "Hz", 2) == 0) {
        number.n -= 2;
    }
    if (!header_read_positive(h->reading, &entry, number, rate)) {
        return false;
    }
    h->reading->out->dt = 1 / *rate;
    h->reading->out->dt_line = entry.line;
    return true;
}

// The acceleration of one count in the unit of the file, `3920(gal)/6182761`.
static bool read_scale(const struct header *h, double *scale) {
    const struct record_reader *r = h->reading;
    struct header_entry entry;
    if (!header_text(h, "Scale Factor", &entry)) {
        return false;
    }
    struct piece rest = entry.value;
    struct piece unit;
    if (!lines_bracket(&rest, &unit) || rest.n == 0 || rest.text[0] != '/') {
        return record_fail(r, entry.line, "Scale Factor '%s' is not of the form 3920(gal)/6182761",
                           lines_excerpt(entry.value).text);
    }
    double size, counts;
    header_read_unit(r, entry.line, unit);
    const struct piece above = {entry.value.text, (size_t)(unit.text - 1 - entry.value.text)};
    const struct piece below = {rest.text + 1, rest.n - 1};
    if (!header_read_positive(r, &entry, above, &size) ||
        !header_read_positive(r, &entry, below, &counts)) {
        return false;
    }
    *scale = size / counts;
    return isfinite(*scale) || record_fail(r, entry.line, "Scale Factor '%s' is out of range",
                                           lines_excerpt(entry.value).text);
}

static bool read_peak(const struct header *h) {
    struct header_entry entry;
    if (!header_find(h, "Max. Acc. (gal)", &entry)) {
        return true;
    }
    h->reading->out->stated_about_mean = true;
    return header_read_peak(h->reading, &entry, entry.value, 0);
}

static bool knet_read(const struct record_reader *r) {
    struct header_entry entry;
    struct lines l;
    double rate = 0, scale = 0, n = 0;
    if (!header_end(r, "Memo.", HEADER_LINES_MAX, "K-NET", &l)) {
        return false;
    }
    const struct header h = {r, l.number};
    if (!read_rate(&h, &rate) || !read_scale(&h, &scale) || !read_peak(&h) ||
        !header_duration(&h, "Duration Time(s)", rate, &entry, &n) ||
        !values_read_stated(r, l, n, entry.line)) {
        return false;
    }
    for (size_t i = 0; i < r->out->n; i++) {
        r->out->value[i] *= scale;
    }
    return true;
}

const struct record_format record_knet = {
    .name = "knet",
    .doc = "K-NET and KiK-net ASCII, counts with a scale factor",
    .certain = true,
    .mark = "SAMPLING FREQ(HZ)",
    .mark_lines = HEADER_LINES_MAX,
    .read = knet_read,
};
