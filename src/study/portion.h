// SPDX-License-Identifier: GPL-3.0-or-later
// What a study file says of its runs: what they come from, which part they are, and whether the
// file of a part is there already.
#ifndef JOSTLE_PORTION_H
#define JOSTLE_PORTION_H

#include "study/ledger.h"
#include "study/plan.h"

// What the runs come from, once they are done, without the members `study` and `accepted`. Texts
// and arrays are from the arena of the ledger. Errors: STATUS_SYSTEM (no memory).
int portion_origin(const struct study_request *q, const struct plan *p, const struct ledger *l,
                   struct study_origin *out, struct error *e);

// Describes the part that the plan runs, without the number of failed runs. The array is from the
// arena of the ledger. Errors: STATUS_SYSTEM (no memory).
int portion_describe(const struct plan *p, const struct ledger *l, struct study_part *out,
                     struct error *e);

// Compares what runs come from with the study `study` of the request. Errors: STATUS_INPUT with the
// name of the first difference, STATUS_SYSTEM (no memory).
int portion_compare(const struct study_request *q, struct ledger *l, const char *study,
                    const struct study_origin *o, struct error *e);

// Sets *found where the file of the request is the finished part that it asks for, and *n_failed,
// the number of its failed runs. Errors: STATUS_INPUT (the file is something else, or the study has
// changed since), STATUS_SYSTEM (no memory).
int portion_find(const struct study_request *q, struct ledger *l, const char *study, bool *found,
                 long *n_failed, struct error *e);

#endif
