// SPDX-License-Identifier: GPL-3.0-or-later
// Sweeps that go together: value i of each belongs to number i of their bundle, which is one
// dimension of the study, a sweep over the numbers 1 ... N.
#ifndef JOSTLE_BUNDLE_H
#define JOSTLE_BUNDLE_H

#include "deck/reader.h"

struct bundle;

// What a statement says of the bundle of its sweep.
struct bundle_request {
    struct word name;          // where messages about it point, too; text NULL: there is none
    const struct word *count;  // where those about the number of values point
    const char *noun;          // "value" or "file"
};

// Names the bundle: `as` is the argument of -as; where it is not given, `fallback` (NULL: none) at
// the word `at`. False after having reported that it is the name of the sweep itself.
bool bundle_name(struct deck *d, const struct argument *as, const struct word *at,
                 const char *fallback, const struct sweep *own, struct bundle_request *q);

// A -D that gives a text of `own` chooses the number of its bundle: it becomes a -D of that, and
// the deck is to be read again. False: there is no such -D. A text that stands more than once is an
// error.
bool bundle_choose(struct deck *d, const struct bundle_request *q, const struct sweep *own);

// Adds `own`, with all its values, to its bundle, which is begun if there is none of the name, and
// sets *p to its value in this run; where -D chooses one number, `own` keeps that value only. False
// after having reported an error.
bool bundle_join(struct deck *d, const struct bundle_request *q, struct sweep *own,
                 struct parameter *p);

#endif
