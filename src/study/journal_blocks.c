// SPDX-License-Identifier: GPL-3.0-or-later
// The histories of runs in the journal.
#include <stdlib.h>

#include "core/file.h"
#include "study/entry.h"
#include "study/journal_parts.h"

int journal_want_histories(struct journal *j, uint64_t shape, struct error *e) {
    j->chain = calloc((size_t)j->n_run, sizeof *j->chain);
    j->shape = shape;
    return j->chain ? STATUS_OK : error_no_memory(e);
}

void journal_begin_run(struct journal *j, long run) {
    if (j->chain) {
        j->chain[run] = (struct journal_chain){0};
    }
}

void journal_link_block(struct journal *j, const struct entry_block *b) {
    if (!j->chain || b->run < 0 || b->run >= j->n_run) {
        return;
    }
    struct journal_chain *chain = &j->chain[b->run];
    if (b->index == 0) {
        journal_begin_run(j, (long)b->run);
    }
    if (b->index == chain->n && b->previous == chain->last) {
        *chain = (struct journal_chain){chain->n + 1, j->end};
    }
}

bool journal_has_blocks(const struct journal *j, const struct entry_run *run, int status) {
    const struct journal_chain *chain = j->chain ? &j->chain[run->number] : NULL;
    return status == STUDY_FAILED ||
           (run->shape == j->shape &&
            (!chain || (run->n_block == chain->n && run->last == chain->last)));
}

int journal_add_block(struct journal *j, long run, const void *bytes, size_t n, struct error *e) {
    const struct journal_chain *chain = &j->chain[run];
    const struct entry_block block = {run, chain->n, chain->last};
    const off_t at = j->end;
    if (!journal_reserve(j, ENTRY_HEAD + sizeof block + n + ENTRY_TAIL)) {
        return error_no_memory(e);
    }
    const int status =
        journal_append(j, ENTRY_BLOCK, entry_put_block(j->buffer, block, bytes, n), e);
    if (status == STATUS_OK) {
        j->chain[run] = (struct journal_chain){block.index + 1, at};
    }
    return status;
}

int journal_find_blocks(struct journal *j, long run, int64_t **offset, struct error *e) {
    const long n = j->chain[run].n;
    int64_t at = j->chain[run].last, *to = malloc(((size_t)n + 1) * sizeof *to);
    int status = STATUS_OK;
    if (!to) {
        return error_no_memory(e);
    }
    for (long i = n - 1; i >= 0 && status == STATUS_OK; i--) {
        unsigned char start[ENTRY_HEAD + sizeof(struct entry_block)];
        struct entry_block block = {.index = -1};
        to[i] = at;
        if (file_read(j->file, start, sizeof start, (off_t)at) == (ssize_t)sizeof start) {
            entry_get_block(start, sizeof block, &block);
        }
        at = block.previous;
        status = block.run == run && block.index == i ? STATUS_OK : journal_lost(j, run, e);
    }
    if (status != STATUS_OK) {
        free(to);
        return status;
    }
    *offset = to;
    return STATUS_OK;
}

int journal_read_block(struct journal *j, long run, int64_t offset, const unsigned char **bytes,
                       size_t *n, struct error *e) {
    enum entry_kind kind = ENTRY_FILE;
    struct entry_block block = {.run = -1};
    const int sound = journal_load_entry(j, (off_t)offset, &kind, n, e);
    if (sound < 0) {
        return sound;
    }
    *bytes = sound == 1 && kind == ENTRY_BLOCK ? entry_get_block(j->buffer, *n, &block) : NULL;
    *n -= sizeof block;
    return *bytes && block.run == run ? STATUS_OK : journal_lost(j, run, e);
}
