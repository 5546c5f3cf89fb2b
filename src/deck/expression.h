// SPDX-License-Identifier: GPL-3.0-or-later
// Words -> values: expressions, texts with parameters, values of parameters.
#ifndef JOSTLE_EXPRESSION_H
#define JOSTLE_EXPRESSION_H

#include "deck/reader.h"

// expression.c

// Evaluates the expression from `from` to `to` (at a `}`) inside the word `w`.
bool expression_evaluate(struct deck *d, const struct word *w, const char *from, const char *to,
                         struct quantity *out);
// Reads the rest of the word, from `from`, as a number: a literal, $name or ${expression}.
bool expression_number(struct deck *d, const struct word *w, const char *from,
                       struct quantity *out);

// replace.c, with deck_text and deck_file of jostle/deck.h

// Reads `w` as the value of `p`: a number or a text.
void parameter_read(struct deck *d, const struct word *w, struct parameter *p);
// Reads `w` as a text, even if it looks like a number.
void parameter_read_text(struct deck *d, const struct word *w, struct parameter *p);
// Adds a file to the list of the deck's files; the arguments and the path are those of deck_file.
struct deck_path *deck_path_enter(struct deck *d, const struct word *w, const char *name);

#endif
