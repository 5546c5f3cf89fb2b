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

// Goes to the last line of the header.
static bool find_memo(struct lines *l) {
    while (l->number < HEADER_LINES_MAX && lines_next(l)) {
        if (l->line.n >= 5 && memcmp(l->line.text, "Memo.", 5) == 0) {
            return true;
        }
    }
    return false;
}

static bool knet_matches(const struct record_text *t) {
    struct lines l;
    lines_init(&l, t);
    while (l.number < HEADER_LINES_MAX && lines_next(&l)) {
        if (lines_contain(l.line, "SAMPLING FREQ(HZ)")) {
            return true;
        }
    }
    return false;
}

// The number of samples a second, `100Hz`.
static int read_rate(const struct header *h, double *rate, struct record_content *out,
                     struct error *e) {
    struct header_entry entry;
    int status = header_text(h, "Sampling Freq(Hz)", &entry, e);
    if (status != STATUS_OK) {
        return status;
    }
    struct piece number = entry.value;
    if (number.n > 2 && memcmp(number.text + number.n - 2, "Hz", 2) == 0) {
        number.n -= 2;
    }
    status = header_read_positive(h, &entry, number, rate, e);
    if (status == STATUS_OK) {
        out->dt = 1 / *rate;
        out->dt_line = entry.line;
    }
    return status;
}

// The acceleration of one count in the unit of the file, `3920(gal)/6182761`.
static int read_scale(const struct record_request *request, const struct header *h, double *scale,
                      struct record_content *out, struct error *e) {
    struct header_entry entry;
    int status = header_text(h, "Scale Factor", &entry, e);
    if (status != STATUS_OK) {
        return status;
    }
    struct piece rest = entry.value;
    struct piece unit;
    if (!lines_bracket(&rest, &unit) || rest.n == 0 || rest.text[0] != '/') {
        return lines_error(e, h->text->path, entry.line,
                           "Scale Factor '%s' is not of the form 3920(gal)/6182761",
                           lines_excerpt(entry.value).text);
    }
    double size, counts;
    header_read_unit(request, &entry, unit, out);
    const struct piece above = {entry.value.text, (size_t)(unit.text - 1 - entry.value.text)};
    const struct piece below = {rest.text + 1, rest.n - 1};
    status = header_read_positive(h, &entry, above, &size, e);
    if (status == STATUS_OK) {
        status = header_read_positive(h, &entry, below, &counts, e);
    }
    if (status != STATUS_OK) {
        return status;
    }
    *scale = size / counts;
    return isfinite(*scale)
               ? STATUS_OK
               : lines_error(e, h->text->path, entry.line, "Scale Factor '%s' is out of range",
                             lines_excerpt(entry.value).text);
}

static int read_peak(const struct header *h, struct record_content *out, struct error *e) {
    struct header_entry entry;
    if (!header_find(h, "Max. Acc. (gal)", &entry)) {
        return STATUS_OK;
    }
    out->stated_about_mean = true;
    return header_read_peak(h, &entry, entry.value, out, e);
}

// Reads the counts and scales them.
static int read_values(struct arena *a, const struct header *h, const struct lines *l, double rate,
                       double scale, struct record_content *out, struct error *e) {
    double n;
    struct header_entry entry;
    int status = header_duration(h, "Duration Time(s)", rate, &entry, &n, e);
    if (status == STATUS_OK) {
        status = values_read_stated(a, h->text, *l, n, entry.line, out, e);
    }
    for (size_t i = 0; status == STATUS_OK && i < out->n; i++) {
        out->value[i] *= scale;
    }
    return status;
}

static int knet_read(struct arena *a, const struct record_request *request,
                     const struct record_text *t, struct record_content *out, struct error *e) {
    struct lines l;
    lines_init(&l, t);
    if (!find_memo(&l)) {
        return lines_error(
            e, t->path, 0,
            "the file has no 'Memo.' in the first %d lines; it ends the header of a K-NET file",
            HEADER_LINES_MAX);
    }
    const struct header h = {t, l.number};
    double rate = 0;
    double scale = 0;
    int status = read_rate(&h, &rate, out, e);
    if (status == STATUS_OK) {
        status = read_scale(request, &h, &scale, out, e);
    }
    if (status == STATUS_OK) {
        status = read_peak(&h, out, e);
    }
    return status == STATUS_OK ? read_values(a, &h, &l, rate, scale, out, e) : status;
}

const struct record_format record_knet = {
    .name = "knet",
    .doc = "K-NET and KiK-net ASCII, counts with a scale factor",
    .certain = true,
    .matches = knet_matches,
    .read = knet_read,
};
