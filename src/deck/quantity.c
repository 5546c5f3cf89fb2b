// SPDX-License-Identifier: GPL-3.0-or-later
// Arithmetic of numbers that may carry a dimension. Values are in the deck's units.
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "deck/reader.h"

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

// Sums, min and max need equal dimensions; the result has them.
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

// a op b where op is * (sign 1) or / (sign -1).
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
        return error_set(e, STATUS_INPUT, "the negative number %.6g has no power %.6g", a->value,
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

int quantity_function(const struct unit_system *u, const char *name, size_t n, struct quantity *a,
                      struct error *e) {
    const struct function *f = quantity_functions, *end = f + n_quantity_function;
    while (f < end && !(strlen(f->name) == n && strncmp(f->name, name, n) == 0)) {
        f++;
    }
    if (f == end) {
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
