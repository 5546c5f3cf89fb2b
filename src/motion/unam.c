// SPDX-License-Identifier: GPL-3.0-or-later
// Archivo estandar de aceleracion 2.0 of the Instituto de Ingenieria, UNAM, and other networks of
// Mexico: channels side by side. The header has lines `KEY : value`. Slashes stand before the
// values of the channels. These lines are read:
//
//     ARCHIVO ESTANDAR DE ACELERACION:              in one of the first lines
//     VERSION DEL FORMATO                    : 2.0
//     NUMERO DE CANALES                      : 3
//     VEL. DE MUESTREO, C1-C6 (muestras/s)   : /250/250/250
//     INTERVALO DE MUESTREO, C1-C6 (s)       : /0.004/0.004/0.004
//     NUM. TOTAL DE MUESTRAS, C1-C6          : /17500/17500/17500
//     ACEL. MAX.(Gal), C1-C6                 : /0.47/-1.19/1.22
//     UNIDADES DE LOS DATOS                  : Gal (cm/s/s)
//     FACTOR DE DECIMACION                   : 1
//     DATOS DE ACELERACION:                         then four lines, the third with the names,
//
// A row of values for each time follows, as many as samples. Files of 2004 repeat the last row.
// jostle refuses files with a factor other than 1, files with more than 6 channels, which have
// other keys, and files with values that touch, of 1000 gal and more.
//
// Source: files of UNAM; the reader of gmprocess (USGS) for them.
#include <math.h>
#include <string.h>

#include "motion/channels.h"
#include "motion/header.h"

enum { MARK_LINES = 16, HEADER_LINES_MAX = 200, CHANNELS = 6, NAMES = 3, RULE = 4 };

static const double ROUNDING = 1e-6;  // of rate times step, which should be 1

// Goes to the last line of the header, and reads the names of the channels above it.
static bool find_data(const struct record_reader *r, struct lines *l, struct piece *names) {
    lines_init(l, r->text);
    while (l->number < HEADER_LINES_MAX && lines_next(l)) {
        if (!lines_contain(l->line, "DATOS DE ACELERACION:")) {
            continue;
        }
        for (int i = 1; i <= RULE && lines_next(l); i++) {
            *names = i == NAMES ? l->line : *names;
        }
        if (l->line.n > 2 && memcmp(l->line.text, "---", 3) == 0) {
            return true;
        }
        break;
    }
    return record_fail(r, 0,
                       "the file has no 'DATOS DE ACELERACION:' with four lines, the last a rule, "
                       "in the first %d lines; it ends the header of a UNAM file",
                       HEADER_LINES_MAX);
}

static bool read_names(const struct header *h, struct piece names, struct channels *c) {
    struct header_entry entry;
    double n;
    if (!header_positive(h, "NUMERO DE CANALES", &entry, &n)) {
        return false;
    }
    const size_t named = lines_count(names, "");
    if (n > CHANNELS || n != (double)named) {
        return record_fail(h->reading, entry.line,
                           "%s is %s; it must be at most %d, and %zu are named above the values",
                           entry.key, lines_excerpt(entry.value).text, CHANNELS, named);
    }
    for (c->n = 0; lines_field(&names, "", &c->name[c->n]); c->n++) {
    }
    return true;
}

// The entry of this key. Its value is the text after the slash of the channel.
static bool find_entry(const struct header *h, const char *key, int channel,
                       struct header_entry *out) {
    if (!header_text(h, key, out)) {
        return false;
    }
    struct piece rest = out->value;
    struct piece field;
    bool found = lines_field(&rest, "/", &field) && field.n == 0;
    for (int i = 0; found && i <= channel; i++) {
        found = lines_field(&rest, "/", &field) && field.n > 0;
    }
    if (!found) {
        return record_fail(h->reading, out->line, "%s '%s' has no value of channel %d", key,
                           lines_excerpt(out->value).text, channel + 1);
    }
    out->value = field;
    return true;
}

// An error if the entry is not `wanted`: the values would then have another meaning.
static bool check_entry(const struct header *h, const char *key, double wanted) {
    struct header_entry entry;
    double value;
    return header_positive(h, key, &entry, &value) &&
           (value == wanted || record_fail(h->reading, entry.line, "%s is %s; only %g can be read",
                                           key, lines_excerpt(entry.value).text, wanted));
}

// The time step. The header gives it twice, as rate and as step.
static bool read_step(const struct header *h, int channel) {
    const struct record_reader *r = h->reading;
    struct header_entry speed, interval;
    double rate;
    if (!find_entry(h, "VEL. DE MUESTREO, C1-C6 (muestras/s)", channel, &speed) ||
        !header_read_positive(r, &speed, speed.value, &rate) ||
        !find_entry(h, "INTERVALO DE MUESTREO, C1-C6 (s)", channel, &interval) ||
        !header_read_positive(r, &interval, interval.value, &r->out->dt)) {
        return false;
    }
    r->out->dt_line = interval.line;
    return fabs(rate * r->out->dt - 1) <= ROUNDING ||
           record_fail(r, interval.line, "a time step of %g s; %g samples a second make it %g s",
                       r->out->dt, rate, 1 / rate);
}

static bool read_channel(const struct header *h, int channel, struct channel_rows *rows) {
    struct header_entry count, unit, peak;
    struct piece name;
    if (!find_entry(h, "NUM. TOTAL DE MUESTRAS, C1-C6", channel, &count) ||
        !header_read_count(h->reading, &count, &rows->stated) ||
        !header_text(h, "UNIDADES DE LOS DATOS", &unit)) {
        return false;
    }
    rows->stated_line = count.line;
    lines_field(&unit.value, "(", &name);
    header_read_unit(h->reading, unit.line, name);
    return find_entry(h, "ACEL. MAX.(Gal), C1-C6", channel, &peak) &&
           header_read_peak(h->reading, &peak, peak.value, 0);
}

static bool unam_read(const struct record_reader *r) {
    struct channels c = {0};
    struct channel_rows rows = {0};
    struct piece names = {0};
    if (!find_data(r, &rows.from, &names)) {
        return false;
    }
    const struct header h = {r, rows.from.number};
    if (!check_entry(&h, "VERSION DEL FORMATO", 2) || !check_entry(&h, "FACTOR DE DECIMACION", 1) ||
        !read_names(&h, names, &c) || !channels_choose(r, &c, &rows.column)) {
        return false;
    }
    rows.n_column = c.n;
    return read_step(&h, rows.column) && read_channel(&h, rows.column, &rows) &&
           channels_read(r, &rows);
}

const struct record_format record_unam = {
    .name = "unam",
    .doc = "UNAM, Mexico, standard acceleration file 2.0, channels side by side",
    .certain = true,
    .channels = true,
    .mark = "ARCHIVO ESTANDAR DE ACELERACION",
    .mark_lines = MARK_LINES,
    .read = unam_read,
};
