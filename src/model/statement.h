// SPDX-License-Identifier: GPL-3.0-or-later
// A statement is one file in src/model/statement/ with a const descriptor, and one line in
// statement_list.inc. Parsing, `--help` and the deck reference come from the descriptor.
#ifndef JOSTLE_STATEMENT_H
#define JOSTLE_STATEMENT_H

#include "model/builder.h"

struct statement_kind {
    const char *name;
    const char *usage;    // without the name
    const char *summary;  // one line
    const char *example;  // a line of a deck
    const struct row *row;  // its own options; those of a law it names come on top
    int n_row;
    // Reads the statement into the builder; reports what is wrong in the deck's diagnostics.
    void (*build)(struct builder *b, const struct statement *s);
};

#define STATEMENT(descriptor) extern const struct statement_kind descriptor;
#include "model/statement_list.inc"
#undef STATEMENT

#endif
