// SPDX-License-Identifier: GPL-3.0-or-later
// Numbers directly followed by a unit, and what is wrong after a number.
#include <math.h>
#include <string.h>

#include "core/text.h"
#include "deck/reader.h"

// Notes that the unit g is used: the statement gravity must precede its uses.
static void note_gravity(struct deck *d, const char *unit, double size) {
    const char *end;
    struct dimension dimension;
    double other;
    if (!d->reader->gravity_used &&
        unit_parse(unit, 2 * d->units.gravity, &end, &dimension, &other) && other != size) {
        d->reader->gravity_used = true;
    }
}

static bool starts_unit(char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '%';
}

// The end of the run of letters at `at`, of at least one character.
static const char *letters_end(const char *at) {
    do {
        at++;
    } while (starts_unit(*at));
    return at;
}

bool literal_is_unit(const struct deck *d, const char *text, size_t n) {
    const char *end;
    struct dimension dimension;
    double si;
    return unit_parse(text, d->units.gravity, &end, &dimension, &si) && end == text + n;
}

// Reports the unit at `at`; it is a known one only where it follows rad or deg.
static bool unknown_unit(struct deck *d, const struct word *w, const char *at) {
    int n = 0;
    double si;
    const char *end;
    struct dimension dimension;
    if (unit_parse(at, d->units.gravity, &end, &dimension, &si)) {
        deck_error(d, w, "rad and deg do not join with other units; f = omega / (2 pi) in Hz");
        return false;
    }
    while (unit_names[n]) {
        n++;
    }
    struct word part = report_part(d, w, at, letters_end(at));
    deck_unknown(d, &part, part.text, "unit", unit_names, n);
    return false;
}

static bool literal_unit(struct deck *d, const struct word *w, const char **at,
                         struct quantity *out) {
    const char *unit = *at;
    double size;
    if (!unit_parse(unit, d->units.gravity, at, &out->dimension, &size)) {
        return !starts_unit(*unit) || unknown_unit(d, w, unit);
    }
    note_gravity(d, unit, size);
    if (**at == '^') {
        return report_false(
            d, w, *at, *at + 1,
            "this is not a power of a unit, as in m^1.5; put the quantity in brackets to "
            "raise it");
    }
    out->known = true;
    out->value = unit_convert(out->value, size, unit_size(&d->units, out->dimension));
    if (!isfinite(out->value) || !isfinite(size) || !(size > 0)) {
        return report_false(d, w, unit, *at, "the value is too large in this unit");
    }
    return true;
}

bool literal_read(struct deck *d, const struct word *w, const char **at, struct quantity *out) {
    const char *start = *at;
    *out = (struct quantity){0};
    enum text_number found = text_number(start, at, &out->value);
    if (found == TEXT_NUMBER_RANGE) {
        return report_false(d, w, start, *at,
                            "the number is too large; at most 1.8e308 is possible");
    }
    if (found == TEXT_NUMBER_NONE) {
        struct word part = report_part(d, w, start, w->text + strlen(w->text));
        struct text_short t;
        deck_error(d, &part, "'%s' is not a number", text_short(&t, part.text));
        return false;
    }
    return literal_unit(d, w, at, out);
}

// What to write instead where the number `q` is followed by `rest`.
static const char *advice(const struct quantity *q, const char *rest) {
    if (*rest == ',' || *rest == ';') {
        return "write decimals with a point, and separate the values of a list by spaces";
    }
    if ((*rest == '*' || *rest == '/') && starts_unit(rest[1])) {
        return "write a unit directly after its number";
    }
    if ((unsigned char)*rest >= 0x80 || (q->known && !strchr("+-*/", *rest))) {
        return "units are written as in kN*s/m or N/m^1.5";
    }
    return "write expressions as ${...} and texts in quotes";
}

bool literal_end(struct deck *d, const struct word *w, const char *at,
                 const struct quantity *number) {
    struct text_short t;
    if (number->known && (*at == '*' || *at == '/') && starts_unit(at[1])) {
        return unknown_unit(d, w, at + 1);
    }
    return report_false(d, w, at, at + strlen(at), "unexpected '%s' after the number; %s",
                        text_short(&t, at), advice(number, at));
}
