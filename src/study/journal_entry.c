// SPDX-License-Identifier: GPL-3.0-or-later
// Entries as bytes, and how they go into the file of a journal and come out of it.
#include "study/journal_entry.h"

#include <errno.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "core/checksum.h"
#include "core/file.h"

enum { CONTENT_MAX = 1 << 30 };  // bytes

unsigned char *journal_entry_content(unsigned char *entry) {
    return entry + ENTRY_HEAD;
}

// Completes an entry with `n` bytes of content; returns its size.
static size_t seal(unsigned char *entry, enum entry_kind kind, size_t n) {
    const uint32_t head[2] = {(uint32_t)kind, (uint32_t)n};
    _Static_assert(sizeof head == ENTRY_HEAD, "as written");
    memcpy(entry, head, sizeof head);
    const uint64_t sum = checksum_short(entry, ENTRY_HEAD + n);
    memcpy(entry + ENTRY_HEAD + n, &sum, sizeof sum);
    return ENTRY_HEAD + n + ENTRY_TAIL;
}

bool journal_entry_size(const unsigned char *entry, enum entry_kind *kind, size_t *n) {
    uint32_t head[2];
    memcpy(head, entry, sizeof head);
    *kind = (enum entry_kind)head[0];
    *n = head[1];
    return (*kind == ENTRY_HEAD_TEXT || *kind == ENTRY_STATE || *kind == ENTRY_BLOCK ||
            *kind == ENTRY_RUN) &&
           *n <= CONTENT_MAX;
}

bool journal_entry_is_foreign(const unsigned char *entry) {
    const uint32_t kind = ENTRY_HEAD_TEXT;
    unsigned char here[sizeof kind];
    memcpy(here, &kind, sizeof kind);
    for (size_t i = 0; i < sizeof kind; i++) {
        if (entry[i] != here[sizeof kind - 1 - i]) {
            return false;
        }
    }
    return true;
}

// True if the checksum after the `n` bytes of content is right.
static bool is_sound(const unsigned char *entry, size_t n) {
    uint64_t sum;
    memcpy(&sum, entry + ENTRY_HEAD + n, sizeof sum);
    return sum == checksum_short(entry, ENTRY_HEAD + n);
}

size_t journal_entry_run_size(size_t n_value) {
    return sizeof(struct journal_run_head) + STUDY_MESSAGE_MAX + n_value * sizeof(double);
}

size_t journal_entry_put_run(unsigned char *entry, struct entry_run run,
                             const struct study_outcome *outcome, const double *value,
                             size_t n_value) {
    const size_t n_message = strlen(outcome->message);
    const struct journal_run_head head = {
        .run = run, .status = outcome->status, .n_message = (int32_t)n_message};
    unsigned char *to = journal_entry_content(entry);
    memcpy(to, &head, sizeof head);
    memcpy(to + sizeof head, outcome->message, n_message);
    size_t n = sizeof head + n_message;
    if (outcome->status == STUDY_DONE) {
        memcpy(to + n, value, n_value * sizeof *value);
        n += n_value * sizeof *value;
    }
    return n;
}

bool journal_entry_get_run(const unsigned char *entry, size_t n, size_t n_value,
                           struct entry_run *run, struct study_outcome *outcome, double *value) {
    struct journal_run_head head;
    const unsigned char *from = entry + ENTRY_HEAD;
    if (n < sizeof head) {
        return false;
    }
    memcpy(&head, from, sizeof head);
    const bool done = head.status == STUDY_DONE;
    const size_t n_bytes = done ? n_value * sizeof *value : 0;
    if ((!done && head.status != STUDY_FAILED) || head.n_message < 0 ||
        head.n_message >= STUDY_MESSAGE_MAX ||
        n != sizeof head + (size_t)head.n_message + n_bytes) {
        return false;
    }
    *run = head.run;
    *outcome = (struct study_outcome){.status = head.status};
    memcpy(outcome->message, from + sizeof head, (size_t)head.n_message);
    if (value && done) {
        memcpy(value, from + sizeof head + (size_t)head.n_message, n_bytes);
    }
    for (size_t i = 0; value && !done && i < n_value; i++) {
        value[i] = NAN;
    }
    return true;
}

size_t journal_entry_put_block(unsigned char *entry, struct entry_block block, const void *bytes,
                               size_t n) {
    unsigned char *to = journal_entry_content(entry);
    memcpy(to, &block, sizeof block);
    memcpy(to + sizeof block, bytes, n);
    return sizeof block + n;
}

const unsigned char *journal_entry_get_block(const unsigned char *entry, size_t n,
                                             struct entry_block *block) {
    if (n < sizeof *block) {
        return NULL;
    }
    memcpy(block, entry + ENTRY_HEAD, sizeof *block);
    return entry + ENTRY_HEAD + sizeof *block;
}

int journal_cannot(const struct journal *j, const char *what, struct error *e) {
    return error_set(e, STATUS_SYSTEM, "cannot %s %s: %s", what, j->path, strerror(errno));
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
    const size_t size = seal(j->buffer, kind, n);
    if (file_write(j->file, j->buffer, size, j->end) != 0) {
        const int cause = errno;
        (void)file_cut(j->file, j->end);  // else whoever reads the torn entry drops it
        errno = cause;
        return journal_cannot(j, "write", e);
    }
    j->end += (off_t)size;
    return STATUS_OK;
}

int journal_load_entry(struct journal *j, off_t at, enum entry_kind *kind, size_t *n,
                       struct error *e) {
    ssize_t got = file_read(j->file, j->buffer, ENTRY_HEAD, at);
    if (got < 0) {
        return journal_cannot(j, "read", e);
    }
    if (got < ENTRY_HEAD || !journal_entry_size(j->buffer, kind, n)) {
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
        return journal_cannot(j, "read", e);
    }
    return (size_t)got == size && is_sound(j->buffer, *n) ? 1 : 0;
}

// Reads the head of an entry after the first one: no more bytes than such a one can have are
// looked at for it.
static bool is_head(const struct journal *j, const unsigned char *entry, enum entry_kind *kind,
                    size_t *n) {
    const size_t run = journal_entry_run_size(j->n_value);
    const size_t block = sizeof(struct entry_block) + ENTRY_BLOCK_BYTES;
    return journal_entry_size(entry, kind, n) && *n <= (*kind == ENTRY_BLOCK ? block : run);
}

int journal_find_entry(struct journal *j, off_t *at, enum entry_kind *kind, size_t *n,
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
    return got < 0 ? journal_cannot(j, "read", e) : 0;
}

bool journal_is_torn(const struct journal *j, off_t at) {
    unsigned char start[ENTRY_HEAD];
    enum entry_kind kind;
    size_t n;
    const off_t left = lseek(j->file, 0, SEEK_END) - at;
    return left < ENTRY_HEAD ||
           (file_read(j->file, start, ENTRY_HEAD, at) == ENTRY_HEAD &&
            is_head(j, start, &kind, &n) && left < (off_t)(ENTRY_HEAD + n + ENTRY_TAIL));
}
