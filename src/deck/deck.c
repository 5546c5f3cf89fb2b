// SPDX-License-Identifier: GPL-3.0-or-later
// Opens a deck and returns its statements one by one, those of included files too.
#include <assert.h>
#include <stdlib.h>
#include <string.h>

#include "core/arena.h"
#include "core/checksum.h"
#include "core/text.h"
#include "deck/parameter.h"
#include "deck/reader.h"

void deck_free(struct deck *d) {
    if (!d) {
        return;
    }
    if (d->reader) {
        free(d->reader->word);
    }
    arena_free(d->arena);
}

// An empty deck; NULL: no memory.
static struct deck *deck_create(const char *path) {
    struct arena *a = arena_create();
    if (!a) {
        return NULL;
    }
    struct deck *d = arena_alloc(a, 1, sizeof *d);
    struct reader *reader = arena_alloc(a, 1, sizeof *reader);
    char *name = arena_text(a, path, strlen(path));
    if (!d || !reader || !name) {
        arena_free(a);
        return NULL;
    }
    *d = (struct deck){.arena = a, .path = name, .text = "", .reader = reader};
    return d;
}

// Resets the deck to its first statement.
static void begin(struct deck *d, struct source *top) {
    d->title = "";
    d->files = NULL;
    d->sweeps = NULL;
    d->n_run = 1;
    d->torn = false;
    diagnostics_init(&d->diagnostics, d->arena);
    unit_system_init(&d->units);
    deck_define_check(d);
    source_enter(d, top);
}

// Sets the text of the top file and starts reading it.
static int deck_start(struct deck *d, const char *text, size_t size, const char *const *define,
                      int n_define, struct error *e) {
    if (size > DECK_BYTES_MAX) {
        return error_set(e, STATUS_INPUT, "%s has %zu bytes; at most %d are read", d->path, size,
                         DECK_BYTES_MAX);
    }
    d->text = text;
    struct source *source = source_add(d, d->path, text, size);
    if (!source || !deck_define_open(d, define, n_define)) {
        return error_no_memory(e);
    }
    begin(d, source);
    return d->diagnostics.out_of_memory ? error_no_memory(e) : STATUS_OK;
}

int deck_open(const char *path, const char *const *define, int n_define, struct deck **out,
              struct error *e) {
    *out = NULL;
    struct deck *d = deck_create(path);
    if (!d) {
        return error_no_memory(e);
    }
    char *text;
    size_t size;
    int status = text_file(d->arena, d->path, DECK_BYTES_MAX, &text, &size, e);
    if (status == STATUS_OK) {
        status = deck_start(d, text, size, define, n_define, e);
    }
    if (status != STATUS_OK) {
        deck_free(d);
        return status;
    }
    *out = d;
    return STATUS_OK;
}

int deck_open_text(const char *path, const char *text, const char *const *define, int n_define,
                   struct deck **out, struct error *e) {
    *out = NULL;
    struct deck *d = deck_create(path);
    if (!d) {
        return error_no_memory(e);
    }
    size_t size = strlen(text);
    char *copy = arena_text(d->arena, text, size);
    int status = copy ? deck_start(d, copy, size, define, n_define, e) : error_no_memory(e);
    if (status != STATUS_OK) {
        deck_free(d);
        return status;
    }
    *out = d;
    return STATUS_OK;
}

void deck_bind(struct deck *d, const struct deck *first, const int *choice) {
    assert(first && choice);
    d->reader->first_reading = first;
    d->reader->bound = first->sweeps;
    d->reader->choice = choice;
    deck_define_bind(d, first);
}

bool deck_next(struct deck *d, struct statement *out) {
    struct reader *r = d->reader;
    while (r->n_frame > 0 && !d->diagnostics.out_of_memory) {
        if (!scan_statement(d, &r->frame[r->n_frame - 1], out)) {
            r->n_frame--;
        } else if (!statement_run(d, out)) {
            return true;
        }
    }
    if (!r->ended) {
        r->ended = true;
        parameter_close(d);
    }
    return false;
}

bool deck_rewind(struct deck *d) {
    static const int first[STUDY_SWEEPS_MAX] = {0};
    struct reader *r = d->reader;
    struct source *top = r->frame[0].source;
    const bool failed = d->diagnostics.system || d->diagnostics.out_of_memory;
    const bool late = r->late && !r->bound && d->sweeps;
    if (failed || !(r->turned || late)) {
        return false;
    }
    *r = (struct reader){.source = r->source,
                         .word = r->word,
                         .word_capacity = r->word_capacity,
                         .define = r->define,
                         .n_define = r->n_define,
                         .bound = r->turned ? NULL : d->sweeps,
                         .choice = first};
    begin(d, top);
    return true;
}

bool deck_is_study(const struct deck *d) {
    const struct sweep *s = d->sweeps;
    while (s && s->fixed) {
        s = s->next;
    }
    return s != NULL;
}

double deck_gravity(struct deck *d) {
    d->reader->gravity_used = true;
    return d->units.gravity;
}

// The checksum of an open deck, which is then freed. If some lines cannot be split into statements,
// the whole text counts.
static int checksum_statements(struct deck *d, struct checksum *out, struct error *e) {
    struct checksum_sum sum;
    struct statement s;
    if (d->reader->n_frame == 0) {
        deck_free(d);
        return error_set(e, STATUS_INPUT, "it is not text");
    }
    checksum_start(&sum);
    while (scan_statement(d, &d->reader->frame[0], &s)) {
        if (strcmp(s.word[0].text, "title") != 0) {
            checksum_add_number(&sum, (uint64_t)s.n_word);
            for (int i = 0; i < s.n_word; i++) {
                checksum_add_number(&sum, s.word[i].quoted);
                checksum_add_text(&sum, s.word[i].text);
            }
        }
    }
    if (d->torn) {
        checksum_add_text(&sum, d->text);
    }
    checksum_end(&sum, out);
    const bool no_memory = d->diagnostics.out_of_memory;
    deck_free(d);
    return no_memory ? error_no_memory(e) : STATUS_OK;
}

int deck_meaning(const char *text, struct checksum *out, struct error *e) {
    struct deck *d;
    const int status = deck_open_text("", text, NULL, 0, &d, e);
    return d ? checksum_statements(d, out, e) : status;
}

int deck_meaning_of_file(const char *path, struct checksum *out, struct error *e) {
    struct deck *d;
    const int status = deck_open(path, NULL, 0, &d, e);
    return d ? checksum_statements(d, out, e) : status;
}
