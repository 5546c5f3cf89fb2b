// SPDX-License-Identifier: GPL-3.0-or-later
// All output of foreign texts. A text is foreign if it is not a literal of the program: titles,
// names, units, messages and paths of decks, records, result files and the command line. Such texts
// may be hostile.
#ifndef JOSTLE_SAFE_H
#define JOSTLE_SAFE_H

#include <stdio.h>

// Where a text is written. Valid UTF-8 without control characters is read back unchanged. Control
// characters are C0 (with line ends and tabs), DEL and C1. A stray byte is a byte that is not
// UTF-8.
enum safe {
    SAFE_TERMINAL,  // running text of one line: control characters and stray bytes become ?, a tab
                    // becomes a space
    SAFE_TSV,       // a cell: control characters become spaces, stray bytes ?
    SAFE_CSV,       // a cell, in quotes if RFC 4180 requires them; line feeds and tabs stay, other
                    // control characters become spaces, stray bytes ?
    SAFE_JSON,      // a string with its quotes: control characters are escaped, stray bytes become
                    // U+FFFD
    SAFE_GNUPLOT,   // a string with its quotes: control characters become spaces, stray bytes ?
    SAFE_TIC,       // SAFE_GNUPLOT for labels of tics, where % begins the format of a number
    SAFE_COMMENT,   // the rest of a line of a script or its data, as SAFE_TSV
    SAFE_SHELL,     // a word of sh, in quotes if it needs them; control characters and stray
                    // bytes become ?, so that the caller must refuse them
};

// Writes the text. Errors are those of the stream.
void safe_put(FILE *to, enum safe where, const char *text);

// Writes a name of a table, as SAFE_TERMINAL, left-aligned in `width` columns. Of a name that
// is too long the end is kept, because it has the floors.
void safe_cell(FILE *to, const char *name, int width);

// Writes a line of running text, composed as by printf, as SAFE_TERMINAL, and a line end. A line of
// more than 4000 bytes is cut and ends with "...".
void safe_line(FILE *to, const char *format, ...) __attribute__((format(printf, 2, 3)));

#endif
