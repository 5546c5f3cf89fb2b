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
#include <string.h>

#include "motion/channels.h"
#include "motion/header.h"

enum { HEADER_LINES_MAX = 64 };

static bool cwa_matches(const struct record_text *t) {
    struct lines l;
    lines_init(&l, t);
    return lines_next(&l) && lines_contain(l.line, "#EARTHQUAKE INFORMATION");
}

// Goes to the last line of the header.
static bool find_data(struct lines *l) {
    while (l->number < HEADER_LINES_MAX && lines_next(l)) {
        if (l->line.n >= 6 && memcmp(l->line.text, "#Data:", 6) == 0) {
            return true;
        }
    }
    return false;
}

// The names of the channels, `Time U(+); N(+); E(+)` without time and polarities.
static int read_names(const struct header *h, struct channels *c, struct error *e) {
    struct header_entry entry;
    struct piece time, name;
    const int status = header_text(h, "#DataSequence", &entry, e);
    if (status != STATUS_OK) {
        return status;
    }
    struct piece rest = entry.value;
    bool good = lines_field(&rest, "", &time) && lines_word(time, "TIME");
    for (c->n = 0; good && c->n < CHANNELS_MAX && lines_field(&rest, ";", &name); c->n++) {
        lines_field(&name, "(", &c->name[c->n]);
        good = c->name[c->n].n > 0;
    }
    return good && c->n > 0
               ? STATUS_OK
               : lines_error(e, h->text->path, entry.line,
                             "#DataSequence '%s' is not of the form Time U(+); N(+); E(+)",
                             lines_excerpt(entry.value).text);
}

// The larger of the two stated peaks of the channel, `0.658~   -0.837`.
static int read_peak(const struct header *h, struct piece name, struct record_content *out,
                     struct error *e) {
    enum { SIDES = 2 };
    char key[64];
    struct header_entry entry;
    snprintf(key, sizeof key, "#AmplitudeMAX. %.*s", (int)(name.n < 8 ? name.n : 8), name.text);
    if (!header_find(h, key, &entry)) {
        return STATUS_OK;
    }
    struct record_content side[SIDES] = {0};
    struct piece rest = entry.value;
    for (int i = 0; i < SIDES; i++) {
        struct piece value;
        lines_field(&rest, "~", &value);
        const int status = header_read_peak(h, &entry, value, &side[i], e);
        if (status != STATUS_OK) {
            return status;
        }
    }
    const struct record_content *larger = &side[side[1].stated_peak > side[0].stated_peak];
    out->stated_peak = larger->stated_peak;
    out->stated_rounding = larger->stated_rounding;
    out->stated_line = larger->stated_line;
    return STATUS_OK;
}

static int read_sizes(const struct record_request *request, const struct header *h,
                      struct channel_rows *rows, struct record_content *out, struct error *e) {
    struct header_entry entry;
    double rate;
    int status = header_positive(h, "#SampleRate(Hz)", &entry, &rate, e);
    if (status != STATUS_OK) {
        return status;
    }
    out->dt = 1 / rate;
    out->dt_line = entry.line;
    status = header_duration(h, "#RecordLength(sec)", rate, &entry, &rows->stated, e);
    if (status != STATUS_OK) {
        return status;
    }
    rows->stated_line = entry.line;
    status = header_text(h, "#AmplitudeUnit", &entry, e);
    if (status == STATUS_OK) {
        struct piece unit;
        lines_field(&entry.value, ".", &unit);
        header_read_unit(request, &entry, unit, out);
    }
    return status;
}

static int cwa_read(struct arena *a, const struct record_request *request,
                    const struct record_text *t, struct record_content *out, struct error *e) {
    struct channels c;
    struct channel_rows rows = {.timed = true};
    lines_init(&rows.from, t);
    if (!find_data(&rows.from)) {
        return lines_error(
            e, t->path, 0,
            "the file has no '#Data:' in the first %d lines; it ends the header of a CWA file",
            HEADER_LINES_MAX);
    }
    const struct header h = {t, rows.from.number};
    int channel;
    int status = read_names(&h, &c, e);
    if (status == STATUS_OK) {
        status = channels_choose(request, t, &c, &channel, out, e);
    }
    if (status == STATUS_OK) {
        rows.n_column = c.n + 1;
        rows.column = channel + 1;
        status = read_sizes(request, &h, &rows, out, e);
    }
    if (status == STATUS_OK) {
        status = read_peak(&h, c.name[channel], out, e);
    }
    return status == STATUS_OK ? channels_read(a, t, &rows, out, e) : status;
}

const struct record_format record_cwa = {
    .name = "cwa",
    .doc = "CWA, Taiwan, time and three channels side by side",
    .channels = true,
    .certain = true,
    .matches = cwa_matches,
    .read = cwa_read,
};
