// SPDX-License-Identifier: GPL-3.0-or-later
#include "study/identity.h"

#include <inttypes.h>
#include <string.h>

#include "core/checksum.h"

static uint64_t sum_text(uint64_t sum, const char *text) {
    return checksum_add(sum, text, strlen(text) + 1);
}

static uint64_t sum_sweep(const struct sweep *s) {
    uint64_t sum = checksum_start;
    for (; s; s = s->along) {
        sum = sum_text(sum, s->name);
        for (int i = 0; i < s->n; i++) {
            sum = s->number ? checksum_add(sum, &s->number[i], sizeof s->number[i])
                            : sum_text(sum, s->text[i]);
        }
    }
    return sum;
}

const char *identity_study(struct arena *a, const struct study_request *q, size_t n_value) {
    const struct deck *deck = q->first->deck;
    uint64_t define = checksum_start;
    for (int i = 0; i < q->n_define; i++) {
        define = sum_text(define, q->define[i]);
    }
    const char *text = arena_format(
        a, "the program\t%s %016" PRIx64 "\nthe deck\t%016" PRIx64 "\n-D\t%016" PRIx64 "\n",
        q->result.version, q->program, sum_text(checksum_start, deck->text), define);
    for (const struct sweep *w = deck->sweeps; w && text; w = w->next) {
        text = arena_format(a, "%sthe list of values of '%s'\t%d %016" PRIx64 "\n", text, w->name,
                            w->n, sum_sweep(w));
    }
    return text ? arena_format(a, "%sthe number of results\t%zu\n", text, n_value) : NULL;
}

const char *identity_journal(struct arena *a, const struct study_request *q, const char *study) {
    const char *text =
        arena_format(a, "%sthe folder of the deck\t%s\n", study, q->first->deck->path);
    return text && q->shard.n > 0
               ? arena_format(a, "%sthe part\t%ld/%ld\n", text, q->shard.number, q->shard.n)
               : text;
}

const char *identity_difference(const char *old, const char *new, int *length) {
    size_t line = 0;
    for (size_t i = 0; old[i] == new[i] && old[i]; i++) {
        line = old[i] == '\n' ? i + 1 : line;
    }
    const char *from = new[line] ? new + line : old + line;
    *length = (int)strcspn(from, "\t\n");
    return from;
}

size_t identity_folder(const char *path) {
    const char *slash = strrchr(path, '/');
    return slash ? (size_t)(slash - path) + 1 : 0;
}
