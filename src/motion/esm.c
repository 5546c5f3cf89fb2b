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

static const struct header_row entries[] = {
    {.kind = HEADER_COUNT, .key = "NDATA"},
    {.kind = HEADER_STEP, .key = "SAMPLING_INTERVAL_S"},
    {.kind = HEADER_UNIT, .key = "UNITS"},
    {.key = NULL},
};

// The lines before the first line without a colon. The current line of *values is the last of them.
static struct header find_header(const struct record_reader *r, struct lines *values) {
    struct lines l;
    lines_init(&l, r->text);
    *values = l;
    while (l.number < HEADER_LINES_MAX && lines_next(&l) && lines_contain(l.line, ":")) {
        *values = l;
    }
    return (struct header){r, values->number};
}

static bool check_type(const struct header *h) {
    struct header_entry type;
    if (!header_text(h, "DATA_TYPE", &type)) {
        return false;
    }
    return (lines_word(type.value, "ACCELERATION") && !lines_word(type.value, "SPECTRUM")) ||
           record_fail(h->reading, type.line, "this is not an acceleration: DATA_TYPE is '%s'",
                       lines_excerpt(type.value).text);
}

// The stated peak is in cm/s^2, whatever the unit of the values.
static bool read_peak(const struct header *h) {
    static const double cm = 0.01;
    struct header_entry entry;
    return h->reading->out->unit == 0 || !header_find(h, "PGA_CM/S^2", &entry) ||
           header_peak(h->reading, &entry, cm);
}

static bool esm_read(const struct record_reader *r) {
    struct lines values;
    const struct header h = find_header(r, &values);
    return check_type(&h) && header_rows(&h, entries, 0) && read_peak(&h) &&
           values_read_stated(r, values, r->out->npts, r->out->count_line);
}

const struct record_format record_esm = {
    .name = "esm",
    .doc = "DYNA ASCII of ESM and ITACA",
    .certain = true,
    .mark = "EVENT_NAME:",
    .mark_lines = 1,
    .read = esm_read,
};
