// SPDX-License-Identifier: GPL-3.0-or-later
#include "study/journal.h"

#include <errno.h>
#include <fcntl.h>
#include <limits.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "core/file.h"
#include "study/entry.h"
#include "study/journal_parts.h"

static const char magic[8] = "jostle5\n";
enum { MAGIC_VERSION = 6, HEAD_MAX = 1 << 16 };  // the place of its digit; bytes of a later head

static int cannot(const struct journal *j, const char *what, struct error *e) {
    return error_set(e, STATUS_SYSTEM, "cannot %s %s: %s", what, j->path, strerror(errno));
}

void journal_close(struct journal *j) {
    if (j->file >= 0) {
        close(j->file);
    }
    free(j->path);
    free(j->offset);
    free(j->chain);
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

bool journal_reserve(struct journal *j, size_t n) {
    if (n > j->capacity) {
        unsigned char *more = realloc(j->buffer, n);
        if (!more) {
            return false;
        }
        j->buffer = more;
        j->capacity = n;
    }
    return true;
}

int journal_append(struct journal *j, enum entry_kind kind, size_t n, struct error *e) {
    const size_t size = entry_seal(j->buffer, kind, n);
    if (file_write(j->file, j->buffer, size, j->end) != 0) {
        const int cause = errno;
        if (file_cut(j->file, j->end) != 0) {
            errno = cause;  // the torn entry is dropped by whoever reads it
        }
        errno = cause;
        return cannot(j, "write", e);
    }
    j->end += (off_t)size;
    return STATUS_OK;
}

int journal_load_entry(struct journal *j, off_t at, enum entry_kind *kind, size_t *n,
                       struct error *e) {
    ssize_t got = file_read(j->file, j->buffer, ENTRY_HEAD, at);
    if (got < 0) {
        return cannot(j, "read", e);
    }
    if (got < ENTRY_HEAD || !entry_size(j->buffer, kind, n)) {
        return 0;
    }
    const size_t size = ENTRY_HEAD + *n + ENTRY_TAIL;
    if (lseek(j->file, 0, SEEK_END) - at < (off_t)size) {
        return 0;
    }
    if (!journal_reserve(j, size)) {
        return error_no_memory(e);
    }
    got = file_read(j->file, j->buffer, size, at);
    if (got < 0) {
        return cannot(j, "read", e);
    }
    return (size_t)got == size && entry_is_sound(j->buffer, *n) ? 1 : 0;
}

static int take_foreign(struct journal *j, struct error *e) {
    j->head = calloc(1, 1);
    j->accepted = j->head;
    return j->head ? STATUS_OK : error_no_memory(e);
}

// The head in the buffer, and after a 0 what was accepted with it.
static int take_head(struct journal *j, size_t n, struct error *e) {
    char *head = calloc(n + 2, 1);
    if (!head) {
        return error_no_memory(e);
    }
    memcpy(head, entry_content(j->buffer), n);
    free(j->head);
    j->head = head;
    j->accepted = head + strlen(head) + (strlen(head) < n);
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
        return cannot(j, "read", e);
    }
    if (memcmp(found, magic, (size_t)got) != 0) {
        // Is it the magic word of another version?
        const char version = found[MAGIC_VERSION];
        if ((size_t)got == sizeof magic && memcmp(found, magic, MAGIC_VERSION) == 0 &&
            version >= '0' && version <= '9' &&
            found[MAGIC_VERSION + 1] == magic[MAGIC_VERSION + 1]) {
            return take_foreign(j, e);
        }
        return error_set(e, STATUS_INPUT,
                         "%s is not the journal of a study; move it out of the way", j->path);
    }
    if (file_read(j->file, j->buffer, ENTRY_HEAD, sizeof magic) == ENTRY_HEAD &&
        entry_is_foreign(j->buffer)) {
        return take_foreign(j, e);
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

int journal_open(struct journal *j, const char *path, long n_run, size_t n_value, struct error *e) {
    *j = (struct journal){.file = -1, .n_run = n_run, .n_value = n_value};
    const size_t n = strlen(path) + 1;
    j->path = malloc(n);
    j->offset = calloc((size_t)n_run, sizeof *j->offset);
    const bool room = journal_reserve(j, ENTRY_HEAD + entry_run_size(n_value) + ENTRY_TAIL);
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
        status = synced == 0 ? load_head(j, e) : cannot(j, "write", e);
    }
    if (status != STATUS_OK) {
        journal_close(j);
    }
    return status;
}

// Takes the entry in the buffer; 0 if it is not one of this study, or lacks a file or histories.
static int take(struct journal *j, enum entry_kind kind, size_t n, journal_file_function *file,
                void *context, struct error *e) {
    struct entry_run run;
    struct entry_block block;
    struct study_outcome outcome;
    const char *path = NULL;
    struct checksum sum;
    if (kind == ENTRY_RUN && entry_get_run(j->buffer, n, j->n_value, &run, &outcome, NULL) &&
        run.number >= 0 && run.number < j->n_run && run.n_file <= j->n_file &&
        journal_has_blocks(j, &run, outcome.status)) {
        int64_t *offset = &j->offset[run.number];
        j->n_done += *offset == 0;
        j->n_failed += *offset == 0 && outcome.status == STUDY_FAILED;
        *offset = j->end;
        if (outcome.status == STUDY_FAILED) {
            journal_begin_run(j, run.number);  // rows before the failure are not kept
        }
        return 1;
    }
    if (kind == ENTRY_BLOCK && entry_get_block(j->buffer, n, &block)) {
        journal_link_block(j, &block);
        return 1;
    }
    if (kind == ENTRY_FILE && entry_get_file(j->buffer, n, &path, &sum)) {
        int status = file(context, path, &sum, e);
        j->n_file++;
        return status == STATUS_OK ? 1 : status;
    }
    if (kind == ENTRY_HEAD_TEXT) {
        int status = take_head(j, n, e);
        return status == STATUS_OK ? 1 : status;
    }
    return 0;
}

// Reads the head of an entry after the first one: no more bytes than such a one can have are
// looked at for it.
static bool is_head(const struct journal *j, const unsigned char *entry, enum entry_kind *kind,
                    size_t *n) {
    const size_t run = entry_run_size(j->n_value), file = entry_file_size("") + PATH_MAX;
    const size_t block = sizeof(struct entry_block) + ENTRY_BLOCK_BYTES;
    return entry_size(entry, kind, n) && *n <= (*kind == ENTRY_BLOCK       ? block
                                                : *kind == ENTRY_HEAD_TEXT ? HEAD_MAX
                                                : run > file               ? run
                                                                           : file);
}

// Loads the next sound entry from *at on as journal_load_entry does; *at is where it starts.
static int find_entry(struct journal *j, off_t *at, enum entry_kind *kind, size_t *n,
                      struct error *e) {
    enum { BLOCK = 1 << 14 };
    unsigned char block[BLOCK];
    ssize_t got;
    while ((got = file_read(j->file, block, BLOCK, *at)) >= ENTRY_HEAD) {
        for (ssize_t i = 0; i + ENTRY_HEAD <= got; i++, ++*at) {
            const int sound =
                is_head(j, block + i, kind, n) ? journal_load_entry(j, *at, kind, n, e) : 0;
            if (sound != 0) {
                return sound;
            }
        }
    }
    return got < 0 ? cannot(j, "read", e) : 0;
}

// Does the file end amid an entry, as where the program was killed as it wrote?
static bool is_torn(const struct journal *j, off_t at) {
    unsigned char start[ENTRY_HEAD];
    enum entry_kind kind;
    size_t n;
    const off_t left = lseek(j->file, 0, SEEK_END) - at;
    return left < ENTRY_HEAD ||
           (file_read(j->file, start, ENTRY_HEAD, at) == ENTRY_HEAD &&
            is_head(j, start, &kind, &n) && left < (off_t)(ENTRY_HEAD + n + ENTRY_TAIL));
}

int journal_load(struct journal *j, journal_file_function *file, void *context, struct error *e) {
    enum entry_kind kind = ENTRY_RUN;
    size_t n = 0;
    off_t at = j->end;
    int sound;
    while ((sound = find_entry(j, &at, &kind, &n, e)) == 1) {
        j->n_damaged += at > j->end;
        j->end = at;
        const int taken = take(j, kind, n, file, context, e);
        if (taken < 0) {
            return taken;
        }
        at = j->end += (off_t)(ENTRY_HEAD + n + ENTRY_TAIL);
    }
    if (sound < 0) {
        return sound;
    }
    j->n_damaged += !is_torn(j, j->end);
    return STATUS_OK;
}

int journal_go_on(struct journal *j, struct error *e) {
    return file_cut(j->file, j->end) == 0 ? STATUS_OK : cannot(j, "write", e);
}

int journal_accept(struct journal *j, const char *head, const char *accepted, struct error *e) {
    const size_t n_head = strlen(head) + 1, n = n_head + strlen(accepted);
    if (!journal_reserve(j, ENTRY_HEAD + n + ENTRY_TAIL)) {
        return error_no_memory(e);
    }
    memcpy(entry_content(j->buffer), head, n_head);
    memcpy(entry_content(j->buffer) + n_head, accepted, n - n_head);
    return journal_append(j, ENTRY_HEAD_TEXT, n, e);
}

bool journal_is_new(const struct journal *j, const char *head) {
    const size_t whole = sizeof magic + ENTRY_HEAD + strlen(head) + ENTRY_TAIL;
    return !j->head && lseek(j->file, 0, SEEK_END) < (off_t)whole;
}

int journal_reset(struct journal *j, const char *head, struct error *e) {
    const size_t n = strlen(head);
    memset(j->offset, 0, (size_t)j->n_run * sizeof *j->offset);
    for (long run = 0; run < j->n_run; run++) {
        journal_begin_run(j, run);
    }
    j->n_done = 0;
    j->n_failed = 0;
    j->n_file = 0;
    j->end = sizeof magic;
    if (!journal_reserve(j, ENTRY_HEAD + n + ENTRY_TAIL)) {
        return error_no_memory(e);
    }
    if (file_cut(j->file, 0) != 0 || file_write(j->file, magic, sizeof magic, 0) != 0) {
        return cannot(j, "write", e);
    }
    memcpy(entry_content(j->buffer), head, n);
    return journal_append(j, ENTRY_HEAD_TEXT, n, e);
}

int journal_add_file(struct journal *j, const char *path, const struct checksum *sum,
                     struct error *e) {
    if (!journal_reserve(j, ENTRY_HEAD + entry_file_size(path) + ENTRY_TAIL)) {
        return error_no_memory(e);
    }
    const int status = journal_append(j, ENTRY_FILE, entry_put_file(j->buffer, path, sum), e);
    j->n_file += status == STATUS_OK;
    return status;
}

int journal_add_run(struct journal *j, long run, const struct study_outcome *outcome,
                    const double *value, struct error *e) {
    const off_t at = j->end;
    struct entry_run entry = {.number = run, .n_file = j->n_file};
    if (j->chain && outcome->status == STUDY_DONE) {
        entry.shape = j->shape;
        entry.n_block = j->chain[run].n;
        entry.last = j->chain[run].last;
    }
    const size_t n = entry_put_run(j->buffer, entry, outcome, value, j->n_value);
    int status = journal_append(j, ENTRY_RUN, n, e);
    if (status == STATUS_OK) {
        j->offset[run] = at;
        j->n_done++;
        j->n_failed += outcome->status == STUDY_FAILED;
    }
    return status;
}

// Failed ones have no histories, and are not forgotten for them.
void journal_forget(struct journal *j, long run) {
    j->offset[run] = 0;
    j->n_done--;
}

int journal_lost(const struct journal *j, long run, struct error *e) {
    return error_set(e, STATUS_SYSTEM, "%s was damaged while the study ran: run %ld is lost",
                     j->path, run + 1);
}

int journal_read(struct journal *j, long run, struct study_outcome *outcome, double *value,
                 struct error *e) {
    enum entry_kind kind = ENTRY_FILE;
    size_t n = 0;
    struct entry_run found = {.number = -1};
    int sound = journal_load_entry(j, (off_t)j->offset[run], &kind, &n, e);
    if (sound < 0) {
        return sound;
    }
    if (sound == 0 || kind != ENTRY_RUN ||
        !entry_get_run(j->buffer, n, j->n_value, &found, outcome, value) || found.number != run) {
        return journal_lost(j, run, e);
    }
    return STATUS_OK;
}

int journal_sync(const struct journal *j, struct error *e) {
    return file_sync(j->file) == 0 ? STATUS_OK : cannot(j, "write", e);
}
