// SPDX-License-Identifier: GPL-3.0-or-later
// The one way on which foreign texts leave the program. Foreign is every text that is not a literal
// of the program: titles, names, units, messages and paths, of decks, records, result files and the
// command line. Somebody else may have written them.
#ifndef JOSTLE_SAFE_H
#define JOSTLE_SAFE_H

#include <stdio.h>

// Where a text goes. Valid UTF-8 without control characters is read there as what it is. A control
// character is one of C0 (line ends and tabs are among them), DEL or C1; a stray byte is not UTF-8.
enum safe {
    SAFE_TERMINAL,  // running text of one line: control characters and stray bytes become ?, a tab
                    // a blank
    SAFE_TSV,       // a cell: control characters become blanks, stray bytes ?
    SAFE_CSV,       // a cell, in quotes where RFC 4180 wants them; line feeds and tabs stay, other
                    // control characters become blanks, stray bytes ?
    SAFE_JSON,      // a string with its quotes: control characters are escaped, stray bytes become
                    // U+FFFD
    SAFE_GNUPLOT,   // a string with its quotes: control characters become blanks, stray bytes ?
    SAFE_TIC,       // the same for labels of tics, which gnuplot takes for formats of numbers
    SAFE_COMMENT,   // the rest of a line of a script or its data, as SAFE_TSV
    SAFE_SHELL,     // a word of sh, in quotes where it needs them; control characters and stray
                    // bytes become ?, so that the caller must refuse them
};

// Writes the text. Errors are those of the stream.
void safe_put(FILE *to, enum safe where, const char *text);

// Writes a name of a table, as SAFE_TERMINAL, left-aligned in `width` columns. Where it is too
// long, its end is kept, which names the floors.
void safe_cell(FILE *to, const char *name, int width);

// Writes a line of running text, composed as by printf, as SAFE_TERMINAL, and a line end. A line of
// more than 4000 bytes is cut and ends with "...".
void safe_line(FILE *to, const char *format, ...) __attribute__((format(printf, 2, 3)));

#endif
