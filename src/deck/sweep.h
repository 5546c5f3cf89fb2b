// SPDX-License-Identifier: GPL-3.0-or-later
// sweep NAME ...: a parameter that takes one value after another. A file below uses only the
// functions of the files above it.
#ifndef JOSTLE_DECK_SWEEP_H
#define JOSTLE_DECK_SWEEP_H

#include "deck/reader.h"

// sweep_values.c

// Reads `w` as a value of the same kind and dimension as `first` (NULL: any value); false after
// having reported that it differs. Bare numbers are in the deck's units and fit any dimension. If
// `first` is bare, it takes the dimension of `w`.
bool sweep_value(struct deck *d, const struct word *w, struct parameter *first,
                 struct parameter *p);
// Stores the values `p` (n) in the sweep; false: no memory.
bool sweep_take(struct deck *d, struct sweep *s, const struct parameter *p, int n);
// Replaces the values by the value `p` of a -D.
void sweep_fix(struct deck *d, const struct parameter *p, struct sweep *s);

// Reads the values of the statement sweep NAME values LIST, or sweep NAME range FROM TO N. False
// after having reported an error.
enum repeats { VALUES_DIFFER, VALUES_MAY_REPEAT };
bool sweep_list(struct deck *d, const struct statement *s, enum repeats repeats,
                struct sweep *sweep);
enum spacing { SPACING_LINEAR, SPACING_LOG };
bool sweep_range(struct deck *d, const struct statement *s, enum spacing spacing,
                 struct sweep *sweep);

// Finds the files that match `pattern`, sorted by the bytes of their names. `pattern` and the paths
// found are relative to the deck file of `w`. A label is the shortest name that differs for all
// files: without folder and extension, without folder, or the whole path. A later reading takes the
// files of the first one. A -D with a label is changed into the path. False after having reported
// an error.
bool sweep_files(struct deck *d, const struct word *w, const char *pattern, struct sweep *out);
// Changes a -D that gives the short name of a listed file (without folder or extension) into the
// listed text. Other texts stay as they are.
void sweep_take_short_name(struct deck *d, const struct sweep *s);

// bundle.c: paired sweeps. Value i of each sweep belongs to number i of their dimension, which is a
// sweep over the numbers 1 ... N.

// The part of a sweep statement that concerns pairing.
struct bundle_request {
    struct word name;          // of the dimension, and where its messages point; text NULL: none
    const struct word *count;  // where messages about the number of values point
    const char *noun;          // "value" or "file"
};

// Adds a dimension to the study; messages point at `w`. False after having reported too many
// sweeps or runs.
bool sweep_append(struct deck *d, const struct word *w, struct sweep *s);
// Sets the name of the dimension: the argument `as` of -as or, without -as, `fallback` (NULL: no
// pairing) at the word `at`. False after having reported that the sweep itself has this name.
bool bundle_name(struct deck *d, const struct argument *as, const struct word *at,
                 const char *fallback, const struct sweep *own, struct bundle_request *q);
// If a -D gives a text of the sweep `own`, changes it into a -D of the number of this text. The
// deck must then be read again. A text that occurs more than once is reported. False: no such -D.
bool bundle_choose(struct deck *d, const struct bundle_request *q, const struct sweep *own);
// Adds `own` to its dimension, which is created for its first sweep. Sets *p to the value of this
// run. If a -D fixes the number, `own` keeps one value. False after having reported an error.
bool bundle_join(struct deck *d, const struct bundle_request *q, struct sweep *own,
                 struct parameter *p);

// sweep_random.c

// Reads sweep NAME random ...: draws the values, or takes those of the first reading. If a -D gives
// the parameter, the only value is the first argument of the distribution. False after having
// reported an error.
bool sweep_random(struct deck *d, const struct statement *s, struct sweep *own,
                  struct bundle_request *q);
// Notes the distribution of a random sweep that has been read, for -correlated of those below it.
// False: no memory.
bool sweep_note_law(struct deck *d, const struct sweep *own);

// sweep.c

extern const char sweep_usage[];
// Carries out a sweep statement of any kind.
void sweep_run(struct deck *d, const struct statement *s);

#endif
