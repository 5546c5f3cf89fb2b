// SPDX-License-Identifier: GPL-3.0-or-later
// Numbers that may carry a dimension: arithmetic, literals, descriptions.
#ifndef JOSTLE_QUANTITY_H
#define JOSTLE_QUANTITY_H

#include "deck/reader.h"

// Arithmetic. Errors: STATUS_INPUT with the cause.

// *a becomes *a op *b for the operators + - * / ^.
int quantity_combine(const struct unit_system *u, char op, struct quantity *a,
                     const struct quantity *b, struct error *e);
// *a becomes the smaller (sign -1) or larger (+1) of the two.
int quantity_choose(const struct unit_system *u, int sign, struct quantity *a,
                    const struct quantity *b, struct error *e);
// The function called `name` (n bytes) of *a. STATUS_RETRY: there is none.
int quantity_function(const struct unit_system *u, const char *name, size_t n, struct quantity *a,
                      struct error *e);
extern const struct function {
    const char *name;
    double (*value)(double);
} quantity_functions[];
extern const int n_quantity_function;

// "a mass (t)", "a pure number", "a quantity in kN/m^1.5".
struct quantity_text {
    char text[96];
};
const char *quantity_describe(const struct unit_system *u, struct dimension dimension,
                              struct quantity_text *t);

// True if `name` (n bytes) is a function or a constant of expressions.
bool quantity_is_reserved(const char *name, size_t n);

// Are the n characters of `text` a unit?
bool quantity_is_unit(const struct deck *d, const char *text, size_t n);
// A literal with its unit at *at, which moves past it.
bool quantity_read(struct deck *d, const struct word *w, const char **at, struct quantity *out);
// The `*` after the count of a repeat, as in 3*250t; NULL: the word is not a repeat.
const char *deck_repeat_mark(const struct word *w);
// Reports what is at `at`, after the `number`, where the word should end; false.
bool quantity_end(struct deck *d, const struct word *w, const char *at,
                  const struct quantity *number);

#endif
