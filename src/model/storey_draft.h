// SPDX-License-Identifier: GPL-3.0-or-later
// The law of a storey in the draft of its building, from the statements storey and isolator.
#ifndef JOSTLE_STOREY_DRAFT_H
#define JOSTLE_STOREY_DRAFT_H

#include "model/builder.h"

// Marks that storey i (from 0) has a law from statement `s`; false after a report if it had one.
bool storey_draft_take(struct builder *b, struct building_draft *d, int i,
                       const struct statement *s);

// Marks storey i (from 0) as an isolator; false after a report at `w` if another one of the
// building is.
bool storey_draft_isolate(struct builder *b, struct building_draft *d, int i, const struct word *w);

#endif
