// SPDX-License-Identifier: GPL-3.0-or-later
// One part of a study: what its file says of it, and whether that file is there already.
#ifndef JOSTLE_PORTION_H
#define JOSTLE_PORTION_H

#include "study/ledger.h"
#include "study/plan.h"

// Of the part that the plan runs, when its runs have been made; `study` is its identity. From the
// arena of the ledger. Errors: STATUS_SYSTEM (no memory).
int portion_describe(const struct plan *p, const struct ledger *l, const char *study,
                     struct study_part *out, struct error *e);

// Is the file of the request the finished part that it asks for? Then *found is set, and *n_failed
// of its runs. Otherwise it is not there, or an error: STATUS_INPUT (it is something else, or the
// study has changed since).
int portion_find(const struct study_request *q, struct ledger *l, const char *study, bool *found,
                 long *n_failed, struct error *e);

#endif
