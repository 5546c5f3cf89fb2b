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

static const struct header_row entries[] = {
    {.kind = HEADER_RATE, .key = "Sampling Freq(Hz)", .unit = "Hz"},
    {.kind = HEADER_DURATION, .key = "Duration Time(s)"},
    {.kind = HEADER_PEAK, .key = "Max. Acc. (gal)", .optional = true},
    {.key = NULL},
};

// The acceleration of one count in the unit of the file, `3920(gal)/6182761`.
static bool read_scale(const struct header *h, double *scale) {
    const struct record_reader *r = h->reading;
    struct header_entry entry;
    if (!header_text(h, "Scale Factor", &entry)) {
        return false;
    }
    const struct piece whole = entry.value;
    struct piece rest = whole, unit;
    if (!lines_bracket(&rest, &unit) || rest.n == 0 || rest.text[0] != '/') {
        return record_fail(r, entry.line, "Scale Factor '%s' is not of the form 3920(gal)/6182761",
                           lines_excerpt(whole).text);
    }
    double size, counts;
    entry.value = unit;
    header_take(r, HEADER_UNIT, &entry);
    entry.value = (struct piece){whole.text, (size_t)(unit.text - 1 - whole.text)};
    if (!header_positive(r, &entry, &size)) {
        return false;
    }
    entry.value = (struct piece){rest.text + 1, rest.n - 1};
    if (!header_positive(r, &entry, &counts)) {
        return false;
    }
    *scale = size / counts;
    return isfinite(*scale) || record_fail(r, entry.line, "Scale Factor '%s' is out of range",
                                           lines_excerpt(whole).text);
}

static bool knet_read(const struct record_reader *r) {
    struct record_content *out = r->out;
    struct lines l;
    double scale = 0;
    if (!header_end(r, "Memo.", HEADER_LINES_MAX, "K-NET", &l)) {
        return false;
    }
    const struct header h = {r, l.number};
    out->stated_about_mean = true;
    if (!read_scale(&h, &scale) || !header_rows(&h, entries, 0) ||
        !values_read_stated(r, l, out->npts, out->count_line)) {
        return false;
    }
    for (size_t i = 0; i < out->n; i++) {
        out->value[i] *= scale;
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
