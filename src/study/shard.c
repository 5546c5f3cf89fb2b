// SPDX-License-Identifier: GPL-3.0-or-later
#include "jostle/study_merge.h"

long study_shard_run(const struct study_shard *s, long i) {
    if (s->n == 0) {
        return i;
    }
    return i * s->n + (s->number - 1 - i % s->n + s->n) % s->n;
}

long study_shard_size(const struct study_shard *s, long n_run) {
    if (s->n == 0) {
        return n_run;
    }
    const long rows = n_run / s->n;  // complete ones
    return rows + (study_shard_run(s, rows) < n_run);
}
