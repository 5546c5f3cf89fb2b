// SPDX-License-Identifier: GPL-3.0-or-later
// AFAD (formerly NSMN), Turkey: three channels side by side. The header has 18 lines, which need
// not be UTF-8. These lines are read:
//
//     STRONG GROUND MOTION RECORDS OF TURKIYE
//     NUMBER OF DATA          : 28683
//     SAMPLING INTERVAL (sec) : 0.01
//     RAW PGA VALUES (gal)    : (N-S) 13.200332 (E-W) 12.163827 (U-D) 9.840572
//            N-S          E-W          U-D       the last line: names of the channels
//
// A row of values for each time follows. The unit of the values is that of RAW PGA VALUES.
//
// Source: files of https://tadas.afad.gov.tr; the reader of gmprocess (USGS) for NSMN.
#include <string.h>

#include "motion/channels.h"
#include "motion/header.h"

enum { HEADER_LINES_MAX = 32 };

static bool afad_matches(const struct record_text *t) {
    struct lines l;
    lines_init(&l, t);
    while (l.number < 3 && lines_next(&l)) {
        if (lines_contain(l.line, "STRONG GROUND MOTION RECORDS OF TURKIYE")) {
            return true;
        }
    }
    return false;
}

// Goes to the line with the names of the channels, the last line of the header.
static bool find_names(struct lines *l, struct channels *c) {
    while (l->number < HEADER_LINES_MAX && lines_next(l)) {
        struct piece rest = l->line;
        for (c->n = 0; c->n < CHANNELS_MAX && lines_field(&rest, "", &c->name[c->n]);) {
            c->n++;
        }
        if (c->n == 3 && lines_word(l->line, "N-S") && lines_word(l->line, "E-W") &&
            lines_word(l->line, "U-D")) {
            return true;
        }
    }
    return false;
}

// The unit, in brackets in the key of the largest values; and the largest value of the channel,
// behind its name in brackets.
static int read_peak(const struct record_request *request, const struct header *h,
                     struct piece name, struct record_content *out, struct error *e) {
    struct header_entry peaks;
    struct piece inside, value;
    const int status = header_text(h, "RAW PGA VALUES (gal)", &peaks, e);
    if (status != STATUS_OK) {
        return status;
    }
    header_read_unit(request, &peaks, (struct piece){"gal", 3}, out);
    struct piece rest = peaks.value;
    while (lines_bracket(&rest, &inside)) {
        if (inside.n == name.n && memcmp(inside.text, name.text, name.n) == 0 &&
            lines_field(&rest, "", &value)) {
            return header_read_peak(h, &peaks, value, out, e);
        }
    }
    return STATUS_OK;
}

static int read_sizes(const struct header *h, struct channel_rows *rows, struct record_content *out,
                      struct error *e) {
    struct header_entry count, step;
    int status = header_count(h, "NUMBER OF DATA", &count, &rows->stated, e);
    if (status == STATUS_OK) {
        status = header_positive(h, "SAMPLING INTERVAL (sec)", &step, &out->dt, e);
    }
    if (status != STATUS_OK) {
        return status;
    }
    rows->stated_line = count.line;
    out->dt_line = step.line;
    return STATUS_OK;
}

static int afad_read(struct arena *a, const struct record_request *request,
                     const struct record_text *t, struct record_content *out, struct error *e) {
    struct channels c;
    struct channel_rows rows = {.n_column = 3};
    lines_init(&rows.from, t);
    if (!find_names(&rows.from, &c)) {
        return lines_error(
            e, t->path, 0,
            "the file has no line 'N-S E-W U-D' in the first %d lines; it ends the header of an "
            "AFAD file",
            HEADER_LINES_MAX);
    }
    const struct header h = {t, rows.from.number};
    int status = channels_choose(request, t, &c, &rows.column, out, e);
    if (status == STATUS_OK) {
        status = read_sizes(&h, &rows, out, e);
    }
    if (status == STATUS_OK) {
        status = read_peak(request, &h, c.name[rows.column], out, e);
    }
    return status == STATUS_OK ? channels_read(a, t, &rows, out, e) : status;
}

const struct record_format record_afad = {
    .name = "afad",
    .doc = "AFAD (NSMN), Turkey, three channels side by side",
    .channels = true,
    .certain = true,
    .matches = afad_matches,
    .read = afad_read,
};
