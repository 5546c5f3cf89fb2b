// SPDX-License-Identifier: GPL-3.0-or-later
// The table of parameters, and the -D NAME=VALUE of the command line.
#ifndef JOSTLE_PARAMETER_H
#define JOSTLE_PARAMETER_H

#include "deck/reader.h"

// The end of the name at `text`; `text` itself if no name starts there.
const char *parameter_name_end(const char *text);
// False after having reported that `w` cannot name a parameter.
bool parameter_check_name(struct deck *d, const struct word *w);
// The parameter called `name` (n bytes); NULL: there is none.
struct parameter *parameter_find(const struct deck *d, const char *name, size_t n);
// Finds the parameter whose name is the part of `w` from `from` to `to`, and notes that the deck
// uses it. NULL after having reported that there is none.
struct parameter *parameter_get(struct deck *d, const struct word *w, const char *from,
                                const char *to);
// Adds a copy of `value` to the table and returns it; NULL: no memory.
struct parameter *parameter_add(struct deck *d, const struct parameter *value);
// Call it at the end of the deck. Reports each -D without a parameter of its name. If the deck has
// no errors, it also reports unused parameters: an error if a -D or a sweep sets the parameter,
// else a warning.
void parameter_close(struct deck *d);

// Splits the texts NAME=VALUE of the command line; false: no memory.
bool deck_define_open(struct deck *d, const char *const *define, int n_define);
// Reports each -D with a wrong name or value.
void deck_define_check(struct deck *d);
// Takes over the -D of `first`, an earlier reading of the same deck, as that reading changed them.
// Their texts are borrowed.
void deck_define_bind(struct deck *d, const struct deck *first);
// Changes `define` into -D NAME=NUMBER. The change acts when the deck is read again.
void deck_define_turn(struct deck *d, struct define *define, const char *name, int number);
// The texts NAME=VALUE as the deck takes them, in the order of their bytes: a short name of a file
// is its path, and a text of paired sweeps its number. NULL: no memory.
const char *const *deck_define_texts(const struct deck *d, struct arena *a);
// The -D of the parameter; NULL: there is none.
struct define *deck_define_find(const struct deck *d, const char *name);

#endif
