// SPDX-License-Identifier: GPL-3.0-or-later
#include "study/status.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "core/file.h"
#include "core/wall.h"
#include "study/journal_entry.h"

enum { WINDOW = 1 << 20 };

// The part of a journal that is in memory.
struct window {
    int file;
    off_t at;
    size_t n;
    unsigned char *byte;  // (WINDOW)
};

// `n` bytes at `at`, valid until the next call; NULL: the file ends before, or cannot be read.
static const unsigned char *look(struct window *w, off_t at, size_t n) {
    if (at < w->at || at + (off_t)n > w->at + (off_t)w->n) {
        const ssize_t got = file_read(w->file, w->byte, WINDOW, at);
        w->at = at;
        w->n = got > 0 ? (size_t)got : 0;
    }
    return n <= w->n ? w->byte + (at - w->at) : NULL;
}

static void add_run(struct journal_state *s, const unsigned char *content) {
    struct journal_run_head head;
    memcpy(&head, content, sizeof head);
    s->n_done += head.run.count;
    s->n_failed += head.status == STUDY_FAILED ? head.run.count : 0;
    s->n_collapsed += head.run.collapsed ? head.run.count : 0;
}

// Goes from entry to entry by their sizes.
static void count(struct window *w, off_t at, struct journal_state *s) {
    const unsigned char *entry;
    while ((entry = look(w, at, ENTRY_HEAD))) {
        enum entry_kind kind;
        size_t n;
        if (!journal_entry_size(entry, &kind, &n)) {
            return;
        }
        const size_t wanted = kind == ENTRY_RUN     ? sizeof(struct journal_run_head)
                              : kind == ENTRY_STATE ? sizeof *s
                                                    : 0;
        if (wanted > n || !look(w, at + (off_t)(ENTRY_HEAD + n), ENTRY_TAIL)) {
            return;
        }
        entry = look(w, at, ENTRY_HEAD + wanted);
        if (!entry) {
            return;
        }
        if (kind == ENTRY_STATE) {
            memcpy(s, entry + ENTRY_HEAD, sizeof *s);
        } else if (kind == ENTRY_RUN) {
            add_run(s, entry + ENTRY_HEAD);
        }
        at += (off_t)(ENTRY_HEAD + n + ENTRY_TAIL);
    }
}

int status_of_journal(const char *path, struct status_found *out, struct error *e) {
    struct window w = {.byte = malloc(WINDOW)};
    struct journal_state *s = &out->state;
    int status = w.byte ? file_open(path, &w.file, e) : error_no_memory(e);
    *out = (struct status_found){.stage = STAGE_STOPPED};
    if (status != STATUS_OK) {
        free(w.byte);
        return status;
    }
    const off_t first = journal_first(look(&w, 0, JOURNAL_MAGIC));
    if (first > 0) {
        count(&w, first, s);
    } else {
        status = error_set(e, STATUS_INPUT,
                           "%s is not the journal of a study, or of another "
                           "version of jostle",
                           path);
    }
    close(w.file);
    free(w.byte);
    const double age = wall_date() - s->time;
    const bool runs = !s->ended && age < STATUS_AGE;
    out->stage = runs ? STAGE_RUNNING : STAGE_STOPPED;
    if (s->seconds_left > 0.0) {
        s->seconds_left = runs ? fmax(0.0, s->seconds_left - age) : s->seconds_left;
    } else {
        s->seconds_left = s->n_done == s->n_run ? 0.0 : NAN;
    }
    return status;
}

int status_of_file(const char *path, struct status_found *out, struct error *e) {
    struct study_file *f;
    int *ending = NULL;
    int status = study_file_open(path, &f, e);
    if (status != STATUS_OK) {
        return status;
    }
    *out = (struct status_found){.stage = STAGE_COMPLETE};
    struct journal_state *s = &out->state;
    s->n_run = study_file_view(f)->n_run;
    status = study_file_endings(f, &ending, e);
    for (long i = 0; i < s->n_run && status == STATUS_OK; i++) {
        const int how = ending[i] & STUDY_STATUS;
        s->n_done += how != STUDY_MISSING;
        s->n_failed += how == STUDY_FAILED;
        s->n_collapsed += (ending[i] & STUDY_COLLAPSED) != 0;
    }
    free(ending);
    study_file_close(f);
    return status;
}
