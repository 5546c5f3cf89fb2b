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

static const struct header_row entries[] = {
    {.kind = HEADER_RATE, .key = "VEL. DE MUESTREO, C1-C6 (muestras/s)", .channels = true},
    {.kind = HEADER_STEP, .key = "INTERVALO DE MUESTREO, C1-C6 (s)", .channels = true},
    {.kind = HEADER_COUNT, .key = "NUM. TOTAL DE MUESTRAS, C1-C6", .channels = true},
    {.kind = HEADER_UNIT, .key = "UNIDADES DE LOS DATOS", .until = "("},
    {.kind = HEADER_PEAK, .key = "ACEL. MAX.(Gal), C1-C6", .channels = true},
    {.key = NULL},
};

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
    if (!header_text(h, "NUMERO DE CANALES", &entry) || !header_positive(h->reading, &entry, &n)) {
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

// An error if the entry is not `wanted`: the values would then have another meaning.
static bool check_entry(const struct header *h, const char *key, double wanted) {
    struct header_entry entry;
    double value;
    return header_text(h, key, &entry) && header_positive(h->reading, &entry, &value) &&
           (value == wanted || record_fail(h->reading, entry.line, "%s is %s; only %g can be read",
                                           key, lines_excerpt(entry.value).text, wanted));
}

// The header gives the time step twice, as rate and as step.
static bool check_step(const struct record_reader *r) {
    const struct record_content *out = r->out;
    return fabs(out->rate * out->dt - 1) <= ROUNDING ||
           record_fail(r, out->dt_line, "a time step of %g s; %g samples a second make it %g s",
                       out->dt, out->rate, 1 / out->rate);
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
    return header_rows(&h, entries, rows.column) && check_step(r) && channels_read(r, &rows);
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
