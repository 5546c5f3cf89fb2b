// SPDX-License-Identifier: GPL-3.0-or-later
// Names of result files.
#ifndef JOSTLE_OUTPUT_NAME_H
#define JOSTLE_OUTPUT_NAME_H

#include "core/arena.h"
#include "jostle/study_file.h"

struct model;

// The result of a part of the study whose result is `path`: gap.h5, 3/16: gap.3-of-16.h5. NULL: no
// memory.
const char *output_part_name(struct arena *a, const char *path, const struct study_shard *s);

// The name that the user gave, else the deck, else that of the deck file; parts have theirs. NULL:
// no memory.
const char *output_choose(const struct model *m, const char *given, const struct study_shard *s);

// True if both exist and are the same file.
bool output_is_same_file(const char *a, const char *b);

// "K/N" with 1 <= K <= N; false: it is not.
bool output_parse_shard(const char *text, struct study_shard *s);

#endif
