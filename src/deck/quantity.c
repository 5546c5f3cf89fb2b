// SPDX-License-Identifier: GPL-3.0-or-later
// Numbers that may carry a dimension: their arithmetic, and reading them with their unit.
// Values are in the deck's units.
#include "deck/quantity.h"

#include <assert.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "core/text.h"

const char *quantity_describe(const struct unit_system *u, struct dimension dimension,
                              struct quantity_text *t) {
    char unit[64];
    unit_text(u, dimension, unit, sizeof unit);
    const char *noun = dimension_noun(dimension);
    if (!noun) {
        snprintf(t->text, sizeof t->text, "a quantity in %s", unit);
    } else if (dimension_equal(dimension, dimension_none)) {
        snprintf(t->text, sizeof t->text, "%s", noun);
    } else {
        snprintf(t->text, sizeof t->text, "%s (%s)", noun, unit);
    }
    return t->text;
}

// Checks that *a and *b have equal dimensions, as sums, min and max need; *a gets the dimension.
static int unify(const struct unit_system *u, const char *verb, struct quantity *a,
                 const struct quantity *b, struct error *e) {
    if (a->known && b->known && !dimension_equal(a->dimension, b->dimension)) {
        struct quantity_text left, right;
        return error_set(e, STATUS_INPUT, "%s and %s cannot be %s",
                         quantity_describe(u, a->dimension, &left),
                         quantity_describe(u, b->dimension, &right), verb);
    }
    if (!a->known) {
        a->known = b->known;
        a->dimension = b->dimension;
    }
    return STATUS_OK;
}

static void scale_dimension(struct quantity *a, double power) {
    a->dimension.force *= power;
    a->dimension.length *= power;
    a->dimension.time *= power;
}

// Sets the dimension of a * b (sign 1) or a / b (sign -1) in *a.
static void multiply_dimension(struct quantity *a, const struct quantity *b, double sign) {
    if (!a->known || !b->known) {
        a->known = false;
        a->dimension = dimension_none;
        return;
    }
    a->dimension.force += sign * b->dimension.force;
    a->dimension.length += sign * b->dimension.length;
    a->dimension.time += sign * b->dimension.time;
}

static int need_pure(const struct unit_system *u, const char *what, const struct quantity *a,
                     struct error *e) {
    if (a->known && !dimension_equal(a->dimension, dimension_none)) {
        struct quantity_text t;
        return error_set(e, STATUS_INPUT, "%s is %s; a pure number is needed", what,
                         quantity_describe(u, a->dimension, &t));
    }
    return STATUS_OK;
}

static int raise(const struct unit_system *u, struct quantity *a, const struct quantity *b,
                 struct error *e) {
    if (need_pure(u, "the exponent", b, e) != STATUS_OK) {
        return e->status;
    }
    if (a->value < 0 && b->value != floor(b->value)) {
        return error_set(e, STATUS_INPUT,
                         "the negative number %.6g cannot be raised to the power %.6g", a->value,
                         b->value);
    }
    if (a->value == 0 && b->value < 0) {
        return error_set(e, STATUS_INPUT, "division by zero: 0 to the power %.6g", b->value);
    }
    a->value = pow(a->value, b->value);
    scale_dimension(a, b->value);
    return STATUS_OK;
}

static int check_finite(const struct quantity *a, struct error *e) {
    const struct dimension *x = &a->dimension;
    if (!isfinite(a->value) || !isfinite(x->force) || !isfinite(x->length) || !isfinite(x->time)) {
        return error_set(e, STATUS_INPUT, "the result is too large for a number");
    }
    return STATUS_OK;
}

int quantity_combine(const struct unit_system *u, char op, struct quantity *a,
                     const struct quantity *b, struct error *e) {
    if (op == '+' || op == '-') {
        if (unify(u, op == '+' ? "added" : "subtracted", a, b, e) != STATUS_OK) {
            return e->status;
        }
        a->value = op == '+' ? a->value + b->value : a->value - b->value;
    } else if (op == '*') {
        multiply_dimension(a, b, 1);
        a->value *= b->value;
    } else if (op == '/') {
        if (b->value == 0) {
            return error_set(e, STATUS_INPUT, "division by zero");
        }
        multiply_dimension(a, b, -1);
        a->value /= b->value;
    } else if (raise(u, a, b, e) != STATUS_OK) {
        return e->status;
    }
    return check_finite(a, e);
}

int quantity_choose(const struct unit_system *u, int sign, struct quantity *a,
                    const struct quantity *b, struct error *e) {
    if (unify(u, "compared", a, b, e) != STATUS_OK) {
        return e->status;
    }
    if (sign * b->value > sign * a->value) {
        a->value = b->value;
    }
    return STATUS_OK;
}

const struct function quantity_functions[] = {
    {"sqrt", sqrt}, {"abs", fabs}, {"sin", sin},     {"cos", cos},     {"tan", tan},
    {"exp", exp},   {"log", log},  {"log10", log10}, {"floor", floor}, {"ceil", ceil},
};
const int n_quantity_function = sizeof quantity_functions / sizeof quantity_functions[0];

// The function called `name` (n bytes); NULL: there is none.
static const struct function *find_function(const char *name, size_t n) {
    for (int i = 0; i < n_quantity_function; i++) {
        const struct function *f = &quantity_functions[i];
        if (strlen(f->name) == n && strncmp(f->name, name, n) == 0) {
            return f;
        }
    }
    return NULL;
}

bool quantity_is_reserved(const char *name, size_t n) {
    static const char *const others[] = {"pi", "min", "max"};
    for (size_t i = 0; i < sizeof others / sizeof others[0]; i++) {
        if (strlen(others[i]) == n && strncmp(name, others[i], n) == 0) {
            return true;
        }
    }
    return find_function(name, n) != NULL;
}

int quantity_function(const struct unit_system *u, const char *name, size_t n, struct quantity *a,
                      struct error *e) {
    const struct function *f = find_function(name, n);
    if (!f) {
        return STATUS_RETRY;
    }
    double (*const value)(double) = f->value;
    if (value == sqrt && a->value < 0) {
        return error_set(e, STATUS_INPUT, "sqrt of %.6g; it must be >= 0", a->value);
    }
    if ((value == log || value == log10) && a->value <= 0) {
        return error_set(e, STATUS_INPUT, "%s of %.6g; it must be > 0", f->name, a->value);
    }
    if (value == sqrt) {
        scale_dimension(a, 0.5);
    } else if (value != fabs) {
        char what[32];
        snprintf(what, sizeof what, "the argument of %s", f->name);
        if (need_pure(u, what, a, e) != STATUS_OK) {
            return e->status;
        }
    }
    a->value = value(a->value);
    return check_finite(a, e);
}

static bool starts_unit(char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '%';
}

// The end of the letters that start at `at`; at least one character is passed.
static const char *letters_end(const char *at) {
    do {
        at++;
    } while (starts_unit(*at));
    return at;
}

bool quantity_is_unit(const struct deck *d, const char *text, size_t n) {
    const char *end;
    struct dimension dimension;
    double si;
    return unit_parse(text, d->units.gravity, &end, &dimension, &si) && end == text + n;
}

// Reports a wrong unit at `at`. An existing unit is wrong only after rad or deg.
static bool unknown_unit(struct deck *d, const struct word *w, const char *at) {
    int n = 0;
    double si;
    const char *end;
    struct dimension dimension;
    if (unit_parse(at, d->units.gravity, &end, &dimension, &si)) {
        return deck_error(d, w,
                          "rad and deg do not join with other units; f = omega / (2 pi) in Hz");
    }
    while (unit_names[n]) {
        n++;
    }
    struct word part = deck_report_part(d, w, at, letters_end(at));
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
    // Notes that the unit g is used, because the statement gravity must be above all uses of g.
    const char *end;
    struct dimension dimension;
    double other;
    if (!d->reader->gravity_used &&
        unit_parse(unit, 2 * d->units.gravity, &end, &dimension, &other) && other != size) {
        d->reader->gravity_used = true;
    }
    if (**at == '^') {
        return deck_report_false(
            d, w, *at, *at + 1,
            "this is not a power of a unit, as in m^1.5; put the quantity in brackets to "
            "raise it");
    }
    out->known = true;
    out->value = unit_convert(out->value, size, unit_size(&d->units, out->dimension));
    if (!isfinite(out->value) || !isfinite(size) || !(size > 0)) {
        return deck_report_false(d, w, unit, *at, "the value is too large in this unit");
    }
    return true;
}

bool quantity_read(struct deck *d, const struct word *w, const char **at, struct quantity *out) {
    assert(at && *at && out);
    const char *start = *at;
    *out = (struct quantity){0};
    enum text_number found = text_number(start, at, &out->value);
    if (found == TEXT_NUMBER_RANGE) {
        return deck_report_false(d, w, start, *at,
                                 "the number is too large; at most 1.8e308 is possible");
    }
    if (found == TEXT_NUMBER_NONE) {
        struct word part = deck_report_part(d, w, start, w->text + strlen(w->text));
        struct text_short t;
        return deck_error(d, &part, "'%s' is not a number", text_short(&t, part.text));
    }
    return literal_unit(d, w, at, out);
}

// The end of a message: what to write instead of `rest`, which follows the number `q`.
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

bool quantity_end(struct deck *d, const struct word *w, const char *at,
                  const struct quantity *number) {
    struct text_short t;
    if (number->known && (*at == '*' || *at == '/') && starts_unit(at[1])) {
        return unknown_unit(d, w, at + 1);
    }
    return deck_report_false(d, w, at, at + strlen(at), "unexpected '%s' after the number; %s",
                             text_short(&t, at), advice(number, at));
}
