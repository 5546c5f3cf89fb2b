// SPDX-License-Identifier: GPL-3.0-or-later
#include "study/journal.h"

#include <fcntl.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "core/file.h"
#include "study/journal_entry.h"

static const char magic[JOURNAL_MAGIC] = "jostle7\n";
enum { MAGIC_VERSION = 6 };  // the place of its digit

off_t journal_first(const unsigned char *bytes) {
    return bytes && memcmp(bytes, magic, sizeof magic) == 0 ? (off_t)sizeof magic : 0;
}

void journal_close(struct journal *j) {
    if (j->file >= 0) {
        close(j->file);
    }
    free(j->path);
    free(j->offset);
    free(j->chain);
    free(j->found);
    free(j->buffer);
    free(j->head);
    *j = (struct journal){.file = -1};
}

bool journal_is_there(const struct journal *j) {
    return file_is_named(j->file, j->path);
}

void journal_remove(struct journal *j) {
    if (journal_is_there(j)) {
        unlink(j->path);
    }
    journal_close(j);
}

// Of a journal that this program does not read, the head has `n` = 0 bytes.
static int take_head(struct journal *j, size_t n, struct error *e) {
    j->head = calloc(n + 1, 1);
    if (!j->head) {
        return error_no_memory(e);
    }
    memcpy(j->head, journal_entry_content(j->buffer), n);
    return STATUS_OK;
}

// Reads the magic word and the head. A file that is neither is not ours, unless it was torn there.
// What another version has written, or a machine with another order of bytes, is nothing that this
// one reads: its head is empty.
static int load_head(struct journal *j, struct error *e) {
    char found[sizeof magic];
    enum entry_kind kind;
    size_t n;
    ssize_t got = file_read(j->file, found, sizeof found, 0);
    if (got < 0) {
        return journal_cannot(j, "read", e);
    }
    if (memcmp(found, magic, (size_t)got) != 0) {
        // Is it the magic word of another version?
        const char version = found[MAGIC_VERSION];
        if ((size_t)got == sizeof magic && memcmp(found, magic, MAGIC_VERSION) == 0 &&
            version >= '0' && version <= '9' &&
            found[MAGIC_VERSION + 1] == magic[MAGIC_VERSION + 1]) {
            return take_head(j, 0, e);
        }
        return error_set(e, STATUS_INPUT,
                         "%s is not the journal of a study; move it out of the way", j->path);
    }
    if (file_read(j->file, j->buffer, ENTRY_HEAD, sizeof magic) == ENTRY_HEAD &&
        journal_entry_is_foreign(j->buffer)) {
        return take_head(j, 0, e);
    }
    int status = journal_load_entry(j, sizeof magic, &kind, &n, e);
    if (status != 1 || kind != ENTRY_HEAD_TEXT) {
        return status < 0 ? status : STATUS_OK;
    }
    j->end = (off_t)(sizeof magic + ENTRY_HEAD + n + ENTRY_TAIL);
    return take_head(j, n, e);
}

// Between its opening and its lock the study that had it may end and remove it.
static int attempt(void *context, struct error *e) {
    struct journal *j = context;
    return file_claim(j->path, j->path, O_CREAT, &j->file, e);
}

int journal_open(struct journal *j, const char *path, const struct keys *keys, size_t n_value,
                 struct error *e) {
    *j = (struct journal){.file = -1, .keys = keys, .n_value = n_value};
    const size_t n = strlen(path) + 1;
    j->path = malloc(n);
    j->offset = calloc((size_t)keys->n + 1, sizeof *j->offset);
    const bool room = journal_reserve(j, ENTRY_HEAD + journal_entry_run_size(n_value) + ENTRY_TAIL);
    if (!j->path || !j->offset || !room) {
        journal_close(j);
        return error_no_memory(e);
    }
    memcpy(j->path, path, n);
    int status = file_retry(path, path, attempt, j, e);
    if (status == STATUS_OK) {
        // The name of the journal is on disk before anything is in it.
        const int folder = file_open_folder(path);
        const int synced = file_sync_folder(folder);
        if (folder >= 0) {
            close(folder);
        }
        status = synced == 0 ? load_head(j, e) : journal_cannot(j, "write", e);
    }
    if (status != STATUS_OK) {
        journal_close(j);
    }
    return status;
}

int journal_want_histories(struct journal *j, uint64_t shape, struct error *e) {
    j->chain = calloc((size_t)j->keys->n + 1, sizeof *j->chain);
    j->shape = shape;
    return j->chain ? STATUS_OK : error_no_memory(e);
}

void journal_begin_run(struct journal *j, long run) {
    if (j->chain) {
        j->chain[run] = (struct journal_chain){.number = run};
    }
}

// Room for the blocks of the run of this number.
static bool find_chain(struct journal *j, int64_t number) {
    if (number < j->n_found) {
        return true;
    }
    const size_t n = 2 * (size_t)number + 64;
    struct journal_chain *more = realloc(j->found, n * sizeof *more);
    if (!more) {
        return false;
    }
    memset(more + j->n_found, 0, (n - (size_t)j->n_found) * sizeof *more);
    j->found = more;
    j->n_found = (long)n;
    return true;
}

// The block at j->end is another one of its run, if it stands behind those that there are.
static int link_block(struct journal *j, const struct entry_block *b, struct error *e) {
    if (!j->chain || b->run < 0 || b->run >= STUDY_RUNS_MAX) {
        return STATUS_OK;
    }
    if (!find_chain(j, b->run)) {
        return error_no_memory(e);
    }
    struct journal_chain *chain = &j->found[b->run];
    if (b->index == 0) {
        *chain = (struct journal_chain){.number = b->run};
    }
    if (b->index == chain->n && b->previous == chain->last) {
        *chain = (struct journal_chain){chain->n + 1, j->end, b->run};
    }
    return STATUS_OK;
}

// Notes the place of the runs of a key that are not there yet, from run `first` on; how many.
static long enter(struct journal *j, long first, int64_t offset, int status, bool collapsed,
                  const struct journal_chain *chain) {
    long n = 0;
    for (long i = first; i >= 0 && j->offset[i] == 0; i = j->keys->twin[i], n++) {
        j->offset[i] = offset;
        if (j->chain) {
            j->chain[i] = *chain;
        }
    }
    j->n_done += n;
    j->n_failed += status == STUDY_FAILED ? n : 0;
    j->n_collapsed += collapsed ? n : 0;
    return n;
}

bool journal_take(struct journal *j, const struct study_key *key, int64_t place, int status,
                  bool collapsed) {
    static const struct journal_chain none;
    const long first = keys_find(j->keys, key);
    if (first >= 0) {
        enter(j, first, -place, status, collapsed, &none);
    }
    return first >= 0;
}

// Takes the entry of a run in the buffer, unless its histories are not there as they are wanted.
static int take_run(struct journal *j, size_t n) {
    static const struct journal_chain none;
    struct entry_run run;
    struct study_outcome outcome;
    if (!journal_entry_get_run(j->buffer, n, j->n_value, &run, &outcome, NULL)) {
        return 0;
    }
    const long first = keys_find(j->keys, &run.key);
    j->n_foreign += first < 0 && keys_is_known(&run.key);
    const bool done = outcome.status == STUDY_DONE;
    const struct journal_chain *chain = &none;
    if (first < 0 || (done && run.shape != j->shape) || (!done && j->retry)) {
        return 1;
    }
    if (done && run.n_block > 0) {
        if (run.number < 0 || run.number >= j->n_found) {
            return 0;
        }
        chain = &j->found[run.number];
    }
    if (done && (run.n_block != chain->n || run.last != chain->last)) {
        return 0;
    }
    enter(j, first, j->end, outcome.status, run.collapsed != 0, chain);
    return 1;
}

// Takes the entry in the buffer; 0 if it is not one of a journal, or lacks histories.
static int take(struct journal *j, enum entry_kind kind, size_t n, struct error *e) {
    struct entry_block block;
    if (kind == ENTRY_RUN) {
        return take_run(j, n);
    }
    if (kind == ENTRY_BLOCK && journal_entry_get_block(j->buffer, n, &block)) {
        const int status = link_block(j, &block, e);
        return status == STATUS_OK ? 1 : status;
    }
    return kind == ENTRY_STATE;
}

int journal_load(struct journal *j, struct error *e) {
    enum entry_kind kind = ENTRY_RUN;
    size_t n = 0;
    off_t at = j->end;
    int sound;
    while ((sound = journal_find_entry(j, &at, &kind, &n, e)) == 1) {
        j->n_damaged += at > j->end;
        j->end = at;
        const int taken = take(j, kind, n, e);
        if (taken < 0) {
            return taken;
        }
        at = j->end += (off_t)(ENTRY_HEAD + n + ENTRY_TAIL);
    }
    free(j->found);
    j->found = NULL;
    j->n_found = 0;
    if (sound < 0) {
        return sound;
    }
    j->n_damaged += !journal_is_torn(j, j->end);
    return STATUS_OK;
}

int journal_go_on(struct journal *j, struct error *e) {
    return file_cut(j->file, j->end) == 0 ? STATUS_OK : journal_cannot(j, "write", e);
}

bool journal_is_new(const struct journal *j, const char *head) {
    const size_t whole = sizeof magic + ENTRY_HEAD + strlen(head) + ENTRY_TAIL;
    return !j->head && lseek(j->file, 0, SEEK_END) < (off_t)whole;
}

int journal_reset(struct journal *j, const char *head, struct error *e) {
    const size_t n = strlen(head);
    j->end = sizeof magic;
    if (!journal_reserve(j, ENTRY_HEAD + n + ENTRY_TAIL)) {
        return error_no_memory(e);
    }
    if (file_cut(j->file, 0) != 0 || file_write(j->file, magic, sizeof magic, 0) != 0) {
        return journal_cannot(j, "write", e);
    }
    memcpy(journal_entry_content(j->buffer), head, n);
    return journal_append(j, ENTRY_HEAD_TEXT, n, e);
}

int journal_add_state(struct journal *j, const struct journal_state *state, struct error *e) {
    memcpy(journal_entry_content(j->buffer), state, sizeof *state);
    return journal_append(j, ENTRY_STATE, sizeof *state, e);
}

int journal_add_run(struct journal *j, long run, const struct study_outcome *outcome,
                    bool collapsed, const double *value, struct error *e) {
    static const struct journal_chain none;
    const off_t at = j->end;
    const struct study_key *key = &j->keys->key[run];
    const long twin = keys_find(j->keys, key), first = twin < 0 ? run : twin;
    struct entry_run entry = {.key = *key, .number = run, .collapsed = collapsed};
    const bool has_rows = j->chain && outcome->status == STUDY_DONE;
    const struct journal_chain chain = has_rows ? j->chain[run] : none;
    for (long i = first; i >= 0; i = j->keys->twin[i]) {
        entry.count += j->offset[i] == 0;
    }
    entry.shape = has_rows ? j->shape : 0;
    entry.n_block = chain.n;
    entry.last = chain.last;
    const size_t n = journal_entry_put_run(j->buffer, entry, outcome, value, j->n_value);
    int status = journal_append(j, ENTRY_RUN, n, e);
    if (status == STATUS_OK) {
        enter(j, first, at, outcome->status, collapsed, &chain);
    }
    return status;
}

// The error of a run that was there and is not.
static int lost(const struct journal *j, long run, struct error *e) {
    return error_set(e, STATUS_SYSTEM, "%s was damaged while the study ran: run %ld is lost",
                     j->path, run + 1);
}

int journal_read(struct journal *j, long run, struct study_outcome *outcome, double *value,
                 struct error *e) {
    enum entry_kind kind = ENTRY_STATE;
    size_t n = 0;
    struct entry_run found;
    int sound = journal_load_entry(j, (off_t)j->offset[run], &kind, &n, e);
    if (sound < 0) {
        return sound;
    }
    if (sound == 0 || kind != ENTRY_RUN ||
        !journal_entry_get_run(j->buffer, n, j->n_value, &found, outcome, value) ||
        memcmp(&found.key, &j->keys->key[run], sizeof found.key) != 0) {
        return lost(j, run, e);
    }
    return STATUS_OK;
}

int journal_add_block(struct journal *j, long run, const void *bytes, size_t n, struct error *e) {
    const struct journal_chain *chain = &j->chain[run];
    const struct entry_block block = {chain->number, chain->n, chain->last};
    const off_t at = j->end;
    if (!journal_reserve(j, ENTRY_HEAD + sizeof block + n + ENTRY_TAIL)) {
        return error_no_memory(e);
    }
    const int status =
        journal_append(j, ENTRY_BLOCK, journal_entry_put_block(j->buffer, block, bytes, n), e);
    if (status == STATUS_OK) {
        j->chain[run] = (struct journal_chain){block.index + 1, at, block.run};
    }
    return status;
}

int journal_find_blocks(struct journal *j, long run, int64_t **offset, struct error *e) {
    const long n = (long)j->chain[run].n;
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
            journal_entry_get_block(start, sizeof block, &block);
        }
        at = block.previous;
        status =
            block.run == j->chain[run].number && block.index == i ? STATUS_OK : lost(j, run, e);
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
    enum entry_kind kind = ENTRY_STATE;
    struct entry_block block = {.run = -1};
    const int sound = journal_load_entry(j, (off_t)offset, &kind, n, e);
    if (sound < 0) {
        return sound;
    }
    *bytes =
        sound == 1 && kind == ENTRY_BLOCK ? journal_entry_get_block(j->buffer, *n, &block) : NULL;
    *n -= sizeof block;
    return *bytes && block.run == j->chain[run].number ? STATUS_OK : lost(j, run, e);
}

int journal_sync(const struct journal *j, struct error *e) {
    return file_sync(j->file) == 0 ? STATUS_OK : journal_cannot(j, "write", e);
}
