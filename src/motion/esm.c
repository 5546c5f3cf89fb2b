// SPDX-License-Identifier: GPL-3.0-or-later
// DYNA ASCII of the Engineering Strong-Motion database (ESM) and of ITACA: one component in each
// file. The header has lines `KEY: value`: 43 (ITACA), 55 (DYNA 1.0) or 64 (DYNA 1.2). Many values
// are empty, and some contain colons. These lines are read:
//
//     EVENT_NAME: ...                  the first line
//     SAMPLING_INTERVAL_S: 0.01
//     NDATA: 5600
//     UNITS: cm/s^2
//     PGA_CM/S^2: 1.632                may be empty
//     DATA_TYPE: Acceleration          or UNPROCESSED ACCELERATION, PROCESSED ACCELERATION
//
// The values follow, one in a line. Files of velocities, displacements and response spectra have
// this header with another DATA_TYPE. They are refused.
//
// Source: headers of files of https://esm-db.eu; the DYNA bindings of the ITACA team to ObsPy.
#include "motion/header.h"
#include "motion/values.h"

enum { HEADER_LINES_MAX = 128 };

static bool esm_matches(const struct record_text *t) {
    struct lines l;
    lines_init(&l, t);
    return lines_next(&l) && lines_contain(l.line, "EVENT_NAME:");
}

// Finds the header, the lines before the first line without a colon. The current line of *values is
// the last of them.
static struct header find_header(const struct record_text *t, struct lines *values) {
    struct lines l;
    lines_init(&l, t);
    *values = l;
    while (l.number < HEADER_LINES_MAX && lines_next(&l) && lines_contain(l.line, ":")) {
        *values = l;
    }
    return (struct header){t, values->number};
}

static int check_type(const struct header *h, struct error *e) {
    struct header_entry type;
    const int status = header_text(h, "DATA_TYPE", &type, e);
    if (status != STATUS_OK ||
        (lines_word(type.value, "ACCELERATION") && !lines_word(type.value, "SPECTRUM"))) {
        return status;
    }
    return lines_error(e, h->text->path, type.line,
                       "this is not an acceleration: DATA_TYPE is '%s'",
                       lines_excerpt(type.value).text);
}

// The stated peak is in cm/s^2, whatever the unit of the values.
static int read_peak(const struct header *h, struct record_content *out, struct error *e) {
    static const double cm = 0.01;
    struct header_entry entry;
    if (out->unit == 0 || !header_find(h, "PGA_CM/S^2", &entry)) {
        return STATUS_OK;
    }
    const int status = header_read_peak(h, &entry, entry.value, out, e);
    out->stated_peak *= cm / out->unit;
    out->stated_rounding *= cm / out->unit;
    return status;
}

static int esm_read(struct arena *a, const struct record_request *request,
                    const struct record_text *t, struct record_content *out, struct error *e) {
    struct lines values;
    const struct header h = find_header(t, &values);
    struct header_entry count, step, unit;
    double n;
    int status = check_type(&h, e);
    if (status == STATUS_OK) {
        status = header_count(&h, "NDATA", &count, &n, e);
    }
    if (status == STATUS_OK) {
        status = header_positive(&h, "SAMPLING_INTERVAL_S", &step, &out->dt, e);
    }
    if (status == STATUS_OK) {
        out->dt_line = step.line;
        status = header_text(&h, "UNITS", &unit, e);
    }
    if (status == STATUS_OK) {
        header_read_unit(request, &unit, unit.value, out);
        status = read_peak(&h, out, e);
    }
    return status == STATUS_OK ? values_read_stated(a, t, values, n, count.line, out, e) : status;
}

const struct record_format record_esm = {
    .name = "esm",
    .doc = "DYNA ASCII of ESM and ITACA",
    .certain = true,
    .matches = esm_matches,
    .read = esm_read,
};
