// SPDX-License-Identifier: GPL-3.0-or-later
// Texts that somebody else has written, to do harm where one trusts them, and commands that are
// tried on files with such texts: no command in them is executed, no control character is printed.
#ifndef JOSTLE_TEST_HOSTILE_H
#define JOSTLE_TEST_HOSTILE_H

#include <stdbool.h>

#include "support/support.h"

enum { N_HOSTILE = 23, N_HOSTILE_FILE = 3 };
extern const char *const hostile_text[N_HOSTILE];

// The files that hostile_make_files makes, with commands for all that each has, and for one field.
struct hostile_file {
    const char *file, *commands, *some;
};
extern const struct hostile_file hostile_file[N_HOSTILE_FILE];

// A PEER record of a few values.
extern const char hostile_record[];

// Makes run.h5, study.h5, its two parts one.h5 and two.h5, their decks and two records in the
// folder of the test, where commands run; sets JOSTLE to the path of the program. A set-up of
// cmocka.
int hostile_make_files(void **state);

// Under sanitizers (JOSTLE_SANITIZED), where the program is slow, a selection is tried.
bool hostile_is_short(void);

// Runs the line in the folder of the test, where it must neither execute nor print `text`.
struct support_result hostile_tried(const char *line, const char *where, const char *text);

// Draws the scripts that the commands have left and removes them. Under sanitizers they are only
// removed: gnuplot is not built with them, and the ordinary tests draw the same scripts.
struct support_result hostile_draw(const char *where, const char *text);

// The same, and gnuplot must have nothing to say.
void hostile_drawn(const char *where, const char *text);

#endif
