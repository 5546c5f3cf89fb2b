// SPDX-License-Identifier: GPL-3.0-or-later
// One part of a study: what its file says of it, and whether that file is there already.
#ifndef JOSTLE_PORTION_H
#define JOSTLE_PORTION_H

#include "study/ledger.h"
#include "study/plan.h"

// Describes the part that the plan runs, once its runs are done; `study` is its identity. Arrays
// are from the arena of the ledger. Errors: STATUS_SYSTEM (no memory).
int portion_describe(const struct plan *p, const struct ledger *l, const char *study,
                     struct study_part *out, struct error *e);

// Sets *found where the file of the request is the finished part that it asks for, and *n_failed,
// the number of its failed runs. Errors: STATUS_INPUT (the file is something else, or the study has
// changed since), STATUS_SYSTEM (no memory).
int portion_find(const struct study_request *q, struct ledger *l, const char *study, bool *found,
                 long *n_failed, struct error *e);

#endif
