// SPDX-License-Identifier: GPL-3.0-or-later
// What the runs of a study come from: which study it is, the files that they read, and which part
// of the study they are.
//
// Which study it is, is a text with a line for each thing that must not change. A line starts with
// what a message calls the thing and a tab. Equal texts mean the same runs, except for the files
// that they read, which the manifest holds. The build of the program does not count: the version of
// the numerics does.
#ifndef JOSTLE_ORIGIN_H
#define JOSTLE_ORIGIN_H

#include "study/manifest.h"
#include "study/plan.h"

// The text that says which study it is. It is the same wherever the deck lies, as parts may come
// from several machines. A run has `n_value` results. Errors: STATUS_SYSTEM (no memory).
int origin_study(struct arena *a, const struct study_request *q, size_t n_value, const char **out,
                 struct error *e);

// The head of a journal: which values a run has. NULL: no memory.
const char *origin_journal(struct arena *a, const struct study_table *t);

// Appends to the text `to` those lines of another that it does not have; NULL: no memory.
const char *origin_join_lines(struct arena *a, const char *to, const char *lines);

// What a message calls the first difference between two such texts: *length bytes.
const char *origin_difference(const char *old, const char *new, int *length);

// What the runs come from, once they are done, without the members `study` and `key`. The program
// is added to `programs`. Texts and arrays are from the arena of the manifest. Errors:
// STATUS_SYSTEM (no memory).
int origin_describe(const struct study_request *q, const struct manifest *m,
                    struct study_origin *out, struct error *e);

// Describes the part that the plan runs, without the number of failed runs. The array is from the
// arena of the manifest. Errors: STATUS_SYSTEM (no memory).
int origin_part(const struct plan *p, const struct manifest *m, struct study_part *out,
                struct error *e);

// The deck of the plan must be that of the study of a file, and so must the files that its runs
// have read. Errors: STATUS_INPUT (something has changed, or the file does not tell),
// STATUS_SYSTEM.
int origin_check(struct manifest *m, const struct plan *p, const struct study_view *v,
                 struct error *e);

#endif
