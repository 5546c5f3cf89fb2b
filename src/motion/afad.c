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

static const struct header_row entries[] = {
    {.kind = HEADER_COUNT, .key = "NUMBER OF DATA"},
    {.kind = HEADER_STEP, .key = "SAMPLING INTERVAL (sec)"},
    {.key = NULL},
};

// Goes to the line with the names of the channels, the last line of the header.
static bool find_names(const struct record_reader *r, struct lines *l, struct channels *c) {
    lines_init(l, r->text);
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
    return record_fail(r, 0,
                       "the file has no line 'N-S E-W U-D' in the first %d lines; it ends the "
                       "header of an AFAD file",
                       HEADER_LINES_MAX);
}

// The unit, in brackets in the key of the largest values; and the largest value of the channel,
// behind its name in brackets.
static bool take_peak(const struct header *h, struct piece name) {
    struct header_entry peaks;
    struct piece inside;
    if (!header_text(h, "RAW PGA VALUES (gal)", &peaks)) {
        return false;
    }
    struct piece rest = peaks.value;
    peaks.value = (struct piece){"gal", 3};
    header_take(h->reading, HEADER_UNIT, &peaks);
    while (lines_bracket(&rest, &inside)) {
        if (inside.n == name.n && memcmp(inside.text, name.text, name.n) == 0 &&
            lines_field(&rest, "", &peaks.value)) {
            return header_take(h->reading, HEADER_PEAK, &peaks);
        }
    }
    return true;
}

static bool afad_read(const struct record_reader *r) {
    struct channels c;
    struct channel_rows rows = {.n_column = 3};
    if (!find_names(r, &rows.from, &c) || !channels_choose(r, &c, &rows.column)) {
        return false;
    }
    const struct header h = {r, rows.from.number};
    return header_rows(&h, entries, 0) && take_peak(&h, c.name[rows.column]) &&
           channels_read(r, &rows);
}

const struct record_format record_afad = {
    .name = "afad",
    .doc = "AFAD (NSMN), Turkey, three channels side by side",
    .channels = true,
    .certain = true,
    .mark = "STRONG GROUND MOTION RECORDS OF TURKIYE",
    .mark_lines = 3,
    .read = afad_read,
};
