// SPDX-License-Identifier: GPL-3.0-or-later
// Central Weather Administration (CWA, formerly CWB), Taiwan: time and three channels side by side.
// The header has lines `#KEY: value`. These lines are read:
//
//     #Earthquake Information                    the first line
//     #RecordLength(sec): 120
//     #SampleRate(Hz): 50
//     #AmplitudeUnit:  gal. DCoffset(corr)
//     #AmplitudeMAX. U:    0.658~   -0.837       of each channel
//     #DataSequence: Time U(+); N(+); E(+)
//     #Data: 4F10.3                              the last line
//
// Rows of time and values follow. Their number is rate times length.
//
// Source: files of https://gdms.cwa.gov.tw; the reader of gmprocess (USGS) for CWA.
#include <stdio.h>

#include "motion/channels.h"
#include "motion/header.h"

enum { HEADER_LINES_MAX = 64 };

static const struct header_row entries[] = {
    {.kind = HEADER_RATE, .key = "#SampleRate(Hz)"},
    {.kind = HEADER_DURATION, .key = "#RecordLength(sec)"},
    {.kind = HEADER_UNIT, .key = "#AmplitudeUnit", .until = "."},
    {.key = NULL},
};

// The names of the channels, `Time U(+); N(+); E(+)` without time and polarities.
static bool read_names(const struct header *h, struct channels *c) {
    struct header_entry entry;
    struct piece time, name;
    if (!header_text(h, "#DataSequence", &entry)) {
        return false;
    }
    struct piece rest = entry.value;
    bool good = lines_field(&rest, "", &time) && lines_word(time, "TIME");
    for (c->n = 0; good && c->n < CHANNELS_MAX && lines_field(&rest, ";", &name); c->n++) {
        lines_field(&name, "(", &c->name[c->n]);
        good = c->name[c->n].n > 0;
    }
    return (good && c->n > 0) ||
           record_fail(h->reading, entry.line,
                       "#DataSequence '%s' is not of the form Time U(+); N(+); E(+)",
                       lines_excerpt(entry.value).text);
}

// The larger of the two stated peaks of the channel, `0.658~   -0.837`.
static bool take_peak(const struct header *h, struct piece name) {
    char key[64];
    struct header_entry entry;
    snprintf(key, sizeof key, "#AmplitudeMAX. %.*s", (int)(name.n < 8 ? name.n : 8), name.text);
    if (!header_find(h, key, &entry)) {
        return true;
    }
    bool good = true;
    struct piece rest = entry.value;
    for (int i = 0; i < 2 && good; i++) {
        lines_field(&rest, "~", &entry.value);
        good = header_take(h->reading, HEADER_PEAK, &entry);
    }
    return good;
}

static bool cwa_read(const struct record_reader *r) {
    struct channels c;
    struct channel_rows rows = {.timed = true};
    int channel;
    if (!header_end(r, "#Data:", HEADER_LINES_MAX, "CWA", &rows.from)) {
        return false;
    }
    const struct header h = {r, rows.from.number};
    if (!read_names(&h, &c) || !channels_choose(r, &c, &channel)) {
        return false;
    }
    rows.n_column = c.n + 1;
    rows.column = channel + 1;
    return header_rows(&h, entries, 0) && take_peak(&h, c.name[channel]) && channels_read(r, &rows);
}

const struct record_format record_cwa = {
    .name = "cwa",
    .doc = "CWA, Taiwan, time and three channels side by side",
    .channels = true,
    .certain = true,
    .mark = "#EARTHQUAKE INFORMATION",
    .mark_lines = 1,
    .read = cwa_read,
};
