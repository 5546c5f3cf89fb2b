// SPDX-License-Identifier: GPL-3.0-or-later
// A statement is one file in src/model/statement/ with a const descriptor, and one line in
// statement_list.inc. Parsing, `jostle deck` and the deck reference come from the descriptor, which
// jostle/model.h describes.
#ifndef JOSTLE_STATEMENT_H
#define JOSTLE_STATEMENT_H

#include "model/builder.h"

#define STATEMENT(descriptor) extern const struct statement_kind descriptor;
#include "model/statement_list.inc"
#undef STATEMENT

#endif
