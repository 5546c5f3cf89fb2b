// SPDX-License-Identifier: GPL-3.0-or-later
// Statements: how they are split into words, and how those of the language itself are carried out.
#ifndef JOSTLE_DECK_STATEMENT_H
#define JOSTLE_DECK_STATEMENT_H

#include "deck/reader.h"

// The next statement of the file in `f`; false at its end. Wrong lines are reported and left out.
bool scan_statement(struct deck *d, struct frame *f, struct statement *out);
// Carries out a statement of the language itself; false: `s` is another statement.
bool statement_run(struct deck *d, const struct statement *s);

#endif
