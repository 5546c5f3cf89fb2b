// SPDX-License-Identifier: GPL-3.0-or-later
// The files of a sweep.
#ifndef JOSTLE_SWEEP_FILES_H
#define JOSTLE_SWEEP_FILES_H

#include "deck/reader.h"

// The files that `pattern` matches, relative to the deck that `w` stands in, in the order of their
// bytes: paths relative to that deck as texts, and as labels the shortest names that tell them
// apart: without folder and ending, without folder, or the whole path. In a bound deck the files
// found by the other reading. A -D of the sweep that is one of the labels becomes its path. False
// after having reported that there is none.
bool sweep_files(struct deck *d, const struct word *w, const char *pattern, struct sweep *out);

// A -D of the sweep `s` over texts may give a listed file by its short name, without folder or
// ending; it becomes the text of the list. Other texts stay as they are.
void sweep_take_short_name(struct deck *d, const struct sweep *s);

#endif
