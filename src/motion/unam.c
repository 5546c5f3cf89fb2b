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

static bool unam_matches(const struct record_text *t) {
    struct lines l;
    lines_init(&l, t);
    while (l.number < MARK_LINES && lines_next(&l)) {
        if (lines_contain(l.line, "ARCHIVO ESTANDAR DE ACELERACION")) {
            return true;
        }
    }
    return false;
}

// Goes to the last line of the header, and reads the names of the channels above it.
static bool find_data(struct lines *l, struct piece *names) {
    while (l->number < HEADER_LINES_MAX && lines_next(l)) {
        if (!lines_contain(l->line, "DATOS DE ACELERACION:")) {
            continue;
        }
        for (int i = 1; i <= RULE && lines_next(l); i++) {
            *names = i == NAMES ? l->line : *names;
        }
        return l->line.n > 2 && memcmp(l->line.text, "---", 3) == 0;
    }
    return false;
}

static int read_names(const struct header *h, struct piece names, struct channels *c,
                      struct error *e) {
    struct header_entry entry;
    double n;
    const int status = header_positive(h, "NUMERO DE CANALES", &entry, &n, e);
    if (status != STATUS_OK) {
        return status;
    }
    const size_t named = lines_count(names, "");
    if (n > CHANNELS || n != (double)named) {
        return lines_error(e, h->text->path, entry.line,
                           "%s is %s; it must be at most %d, and %zu are named above the values",
                           entry.key, lines_excerpt(entry.value).text, CHANNELS, named);
    }
    for (c->n = 0; lines_field(&names, "", &c->name[c->n]); c->n++) {
    }
    return STATUS_OK;
}

// The entry of this key. Its value is the text after the slash of the channel.
static int find_entry(const struct header *h, const char *key, int channel,
                      struct header_entry *out, struct error *e) {
    const int status = header_text(h, key, out, e);
    if (status != STATUS_OK) {
        return status;
    }
    struct piece rest = out->value;
    struct piece field;
    bool found = lines_field(&rest, "/", &field) && field.n == 0;
    for (int i = 0; found && i <= channel; i++) {
        found = lines_field(&rest, "/", &field) && field.n > 0;
    }
    if (!found) {
        return lines_error(e, h->text->path, out->line, "%s '%s' has no value of channel %d", key,
                           lines_excerpt(out->value).text, channel + 1);
    }
    out->value = field;
    return STATUS_OK;
}

// An error if the entry is not `wanted`: the values would then have another meaning.
static int check_entry(const struct header *h, const char *key, double wanted, struct error *e) {
    struct header_entry entry;
    double value;
    const int status = header_positive(h, key, &entry, &value, e);
    return status != STATUS_OK || value == wanted
               ? status
               : lines_error(e, h->text->path, entry.line, "%s is %s; only %g can be read", key,
                             lines_excerpt(entry.value).text, wanted);
}

// The time step. The header gives it twice, as rate and as step.
static int read_step(const struct header *h, int channel, struct record_content *out,
                     struct error *e) {
    struct header_entry entry;
    double rate;
    int status = find_entry(h, "VEL. DE MUESTREO, C1-C6 (muestras/s)", channel, &entry, e);
    if (status == STATUS_OK) {
        status = header_read_positive(h, &entry, entry.value, &rate, e);
    }
    if (status == STATUS_OK) {
        status = find_entry(h, "INTERVALO DE MUESTREO, C1-C6 (s)", channel, &entry, e);
    }
    if (status == STATUS_OK) {
        status = header_read_positive(h, &entry, entry.value, &out->dt, e);
    }
    if (status != STATUS_OK) {
        return status;
    }
    out->dt_line = entry.line;
    return fabs(rate * out->dt - 1) <= ROUNDING ? STATUS_OK
                                                : lines_error(e, h->text->path, entry.line,
                                                              "a time step of %g s; %g samples a "
                                                              "second make it %g s",
                                                              out->dt, rate, 1 / rate);
}

static int read_channel(const struct record_request *request, const struct header *h, int channel,
                        struct channel_rows *rows, struct record_content *out, struct error *e) {
    struct header_entry entry;
    struct piece unit;
    int status = find_entry(h, "NUM. TOTAL DE MUESTRAS, C1-C6", channel, &entry, e);
    if (status == STATUS_OK) {
        rows->stated_line = entry.line;
        status = header_read_count(h, &entry, &rows->stated, e);
    }
    if (status == STATUS_OK) {
        status = header_text(h, "UNIDADES DE LOS DATOS", &entry, e);
    }
    if (status == STATUS_OK) {
        lines_field(&entry.value, "(", &unit);
        header_read_unit(request, &entry, unit, out);
        status = find_entry(h, "ACEL. MAX.(Gal), C1-C6", channel, &entry, e);
    }
    return status == STATUS_OK ? header_read_peak(h, &entry, entry.value, out, e) : status;
}

static int unam_read(struct arena *a, const struct record_request *request,
                     const struct record_text *t, struct record_content *out, struct error *e) {
    struct channels c = {0};
    struct channel_rows rows = {0};
    struct piece names = {0};
    lines_init(&rows.from, t);
    if (!find_data(&rows.from, &names)) {
        return lines_error(
            e, t->path, 0,
            "the file has no 'DATOS DE ACELERACION:' with four lines, the last a rule, in the "
            "first %d lines; it ends the header of a UNAM file",
            HEADER_LINES_MAX);
    }
    const struct header h = {t, rows.from.number};
    int status = check_entry(&h, "VERSION DEL FORMATO", 2, e);
    if (status == STATUS_OK) {
        status = check_entry(&h, "FACTOR DE DECIMACION", 1, e);
    }
    if (status == STATUS_OK) {
        status = read_names(&h, names, &c, e);
    }
    if (status == STATUS_OK) {
        status = channels_choose(request, t, &c, &rows.column, out, e);
    }
    if (status == STATUS_OK) {
        rows.n_column = c.n;
        status = read_step(&h, rows.column, out, e);
    }
    if (status == STATUS_OK) {
        status = read_channel(request, &h, rows.column, &rows, out, e);
    }
    return status == STATUS_OK ? channels_read(a, t, &rows, out, e) : status;
}

const struct record_format record_unam = {
    .name = "unam",
    .doc = "UNAM, Mexico, standard acceleration file 2.0, channels side by side",
    .certain = true,
    .channels = true,
    .matches = unam_matches,
    .read = unam_read,
};
