// SPDX-License-Identifier: GPL-3.0-or-later
// The threads of a study. Each takes the next runs that are not in the journal, as many as can go
// in lockstep, runs them, and enters them; nothing but the journal, the manifest and the counts is
// shared.
#ifndef JOSTLE_POOL_H
#define JOSTLE_POOL_H

#include "jostle/study.h"
#include "study/journal.h"
#include "study/manifest.h"
#include "study/plan.h"

// Runs until all runs are in the journal. Errors as of study_run; what is finished is in the
// journal.
int pool_run(const struct study_request *q, const struct plan *plan, struct journal *journal,
             struct keys *keys, struct manifest *manifest, struct study_progress *p,
             struct error *e);

#endif
