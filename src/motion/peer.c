// SPDX-License-Identifier: GPL-3.0-or-later
// PEER AT2: lines of text, one of them with the unit. Then a line with the number of values and the
// time step. Then the values, any number in a line. The header has 4 lines (PEER) or more (7 in the
// El Centro record of OpenSees). Forms of its last line:
//
//     NPTS=  1559, DT= .02000 SEC          also with dt in small letters, without SEC, with text
//     NPTS =  5000 , DT =   .010 SEC ,     after it, and with spaces anywhere
//     4096    0.0100    NPTS, DT
//
// Forms of the unit: `ACCELERATION TIME SERIES IN UNITS OF G`, `The units are (g)`, `Acceleration
// in g`. VT2 and DT2 files look the same but hold velocities and displacements. They are refused.
#include <math.h>
#include <string.h>

#include "motion/header.h"
#include "motion/values.h"

enum { HEADER_LINES_MAX = 64 };

// Goes to the line with NPTS.
static bool find_npts(struct lines *l) {
    while (l->number < HEADER_LINES_MAX && lines_next(l)) {
        if (lines_word(l->line, "NPTS")) {
            return true;
        }
    }
    return false;
}

static bool is_series_title(struct piece line) {
    return lines_contain(line, "TIME SERIES") || lines_contain(line, "TIME HISTORY");
}

static bool peer_matches(const struct record_text *t) {
    struct lines l;
    lines_init(&l, t);
    while (l.number < HEADER_LINES_MAX && lines_next(&l)) {
        bool is_title = is_series_title(l.line) && lines_word(l.line, "UNITS");
        if (is_title || lines_word(l.line, "NPTS")) {
            return true;
        }
    }
    return false;
}

// Finds the texts of both values in the last line of the header. dt->n = 0 and dt->text = NULL:
// there is no time step.
static bool find_sizes(struct piece line, struct piece *npts, struct piece *dt) {
    *dt = (struct piece){0};
    if (lines_value(line, "NPTS", npts)) {
        lines_value(line, "DT", dt);
        return true;
    }
    struct piece rest = line;
    return lines_field(&rest, ",", npts) && lines_field(&rest, ",", dt) &&
           lines_number_like(*npts) && lines_number_like(*dt) && lines_word(rest, "NPTS") &&
           lines_word(rest, "DT");
}

// Goes to the next line with number and time step above the values; false: there is no such line.
static bool next_sizes(struct lines *l) {
    struct piece npts, dt, first;
    while (l->number < HEADER_LINES_MAX && lines_next(l)) {
        struct piece rest = l->line;
        if (find_sizes(l->line, &npts, &dt)) {
            return true;
        }
        if (lines_field(&rest, "", &first) && lines_number_like(first)) {
            return false;
        }
    }
    return false;
}

// Goes to the last line with number and time step. If NPTS occurs twice above the values or in this
// line, the other number goes to out->other_npts.
static void find_last_sizes(struct lines *l, struct record_content *out) {
    struct piece npts = {0}, dt, second;
    for (struct lines next = *l; next_sizes(&next); *l = next) {
        if (find_sizes(l->line, &npts, &dt)) {
            out->other_line = l->number;
        }
    }
    if (lines_value(lines_behind(l->line, "NPTS"), "NPTS", &second)) {
        npts = second;
        out->other_line = l->number;
    }
    if (lines_number(npts, &out->other_npts) != NUMBER_OK) {
        out->other_line = 0;
    }
}

// The number of values in the header. If the header has two numbers, the one that the file agrees
// with.
static double choose_npts(const struct lines *l, double npts, struct record_content *out) {
    int last_line;
    out->npts = npts;
    out->count_line = l->number;
    const bool is_other =
        out->other_line > 0 && (double)values_count(*l, "", &last_line) == out->other_npts;
    return is_other ? out->other_npts : npts;
}

static bool check_npts(const struct record_reader *r, int line, struct piece text, double *npts) {
    const struct excerpt shown = lines_excerpt(text);
    if (lines_number(text, npts) != NUMBER_OK) {
        return record_fail(r, line, "NPTS '%s' is not a number", shown.text);
    }
    if (*npts != floor(*npts)) {
        return record_fail(r, line, "NPTS is %s; it must be a whole number", shown.text);
    }
    return *npts >= 2 || record_fail(r, line, "NPTS is %s; it must be at least 2", shown.text);
}

// True if a time step in milliseconds is meant: a word like MSEC follows it.
static bool is_milliseconds(struct piece line, struct piece dt) {
    const char *end = dt.text + dt.n;
    struct piece rest = {end, (size_t)(line.text + line.n - end)};
    struct piece word;
    return lines_field(&rest, ",", &word) && (word.text[0] == 'M' || word.text[0] == 'm');
}

static bool check_dt(const struct record_reader *r, const struct lines *l, struct piece text) {
    const struct excerpt shown = lines_excerpt(text);
    double *dt = &r->out->dt;
    if (lines_number(text, dt) != NUMBER_OK) {
        return record_fail(r, l->number, "DT '%s' is not a number", shown.text);
    }
    if (*dt <= 0) {
        return record_fail(r, l->number, "DT is %s s; it must be > 0", shown.text);
    }
    return !is_milliseconds(l->line, text) || record_fail(r, l->number, "DT is not in seconds");
}

// True for the words between UNITS and the unit.
static bool is_filler(struct piece field) {
    static const char *const words[] = {"OF", "ARE", "IS", "IN"};
    for (size_t i = 0; i < sizeof words / sizeof words[0]; i++) {
        if (field.n == strlen(words[i]) && lines_contain(field, words[i])) {
            return true;
        }
    }
    return field.n == 0;
}

// The unit of `UNITS OF G.`, `units are (g)`, `UNITS: CM/SEC/SEC`, `Acceleration in g`.
static bool find_unit(struct piece line, struct piece *unit) {
    const char *key = lines_word(line, "UNITS") ? "UNITS" : "ACCELERATION IN";
    const char *at = lines_word(line, key);
    if (!at) {
        return false;
    }
    at += strlen(key);
    struct piece rest = {at, (size_t)(line.text + line.n - at)};
    struct piece field;
    while (lines_field(&rest, ",:=()[]", &field)) {
        if (!is_filler(field)) {
            field.n -= field.text[field.n - 1] == '.';
            *unit = field;
            return true;
        }
    }
    return false;
}

// Reads the unit from a line of the header, unless an earlier line had it.
static bool read_unit(const struct record_reader *r, const struct lines *l) {
    bool other = lines_word(l->line, "VELOCITY") || lines_word(l->line, "DISPLACEMENT");
    bool is_title = is_series_title(l->line) || lines_word(l->line, "UNITS");
    if (is_title && other && !lines_word(l->line, "ACCELERATION")) {
        return record_fail(r, l->number, "this is not an acceleration: '%s'",
                           lines_excerpt(l->line).text);
    }
    struct header_entry unit = {"unit", {0}, l->number};
    if (r->out->unit == 0 && find_unit(l->line, &unit.value)) {
        header_take(r, HEADER_UNIT, &unit);
    }
    return true;
}

// Reads the lines above line `end`.
static bool read_titles(const struct record_reader *r, int end) {
    struct lines l;
    lines_init(&l, r->text);
    while (lines_next(&l) && l.number < end) {
        if (!read_unit(r, &l)) {
            return false;
        }
    }
    return true;
}

static bool peer_read(const struct record_reader *r) {
    struct lines l;
    lines_init(&l, r->text);
    struct piece npts_text, dt_text;
    double npts;
    if (!find_npts(&l)) {
        return record_fail(r, 0,
                           "the file has no NPTS in the first %d lines; a PEER header says "
                           "'NPTS= n, DT= dt SEC' or 'n dt NPTS, DT'",
                           HEADER_LINES_MAX);
    }
    find_last_sizes(&l, r->out);
    if (!find_sizes(l.line, &npts_text, &dt_text)) {
        return record_fail(r, l.number, "neither 'NPTS= n, DT= dt SEC' nor 'n dt NPTS, DT'");
    }
    if (!check_npts(r, l.number, npts_text, &npts) || (dt_text.text && !check_dt(r, &l, dt_text))) {
        return false;
    }
    r->out->dt_line = l.number;
    return read_titles(r, l.number) &&
           values_read_stated(r, l, choose_npts(&l, npts, r->out), l.number);
}

const struct record_format record_peer = {
    .name = "peer",
    .doc = "PEER AT2, with 4 or more header lines, the last with NPTS and DT",
    .matches = peer_matches,
    .read = peer_read,
};
