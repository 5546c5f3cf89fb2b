// SPDX-License-Identifier: GPL-3.0-or-later
// The state of reading a deck, its files, and messages at its words. The other files of src/deck
// include each other in this order only:
//
//     reader.h, quantity.h, parameter.h, expression.h, definition.h, sweep.h, statement.h, deck.c
#ifndef JOSTLE_READER_H
#define JOSTLE_READER_H

#include <sys/stat.h>

#include "jostle/deck.h"

enum {
    DECK_BYTES_MAX = 64 << 20,  // of a deck with all its includes
    INCLUDE_DEPTH_MAX = 20,
    LIST_MAX = 1000000,         // values of one list
    REPEATED_MAX = 4000000,     // values of all lists of a deck that came from repeats
    TEXT_MAX = 4096,            // bytes of a word after its parameters are replaced
    TEXT_TOTAL_MAX = 64 << 20,  // bytes of all such words of a deck
};

// A number in the deck's units. If `known` is false, the number fits any dimension.
struct quantity {
    double value;
    bool known;
    struct dimension dimension;
};

// The text of a deck file or of a -D.
struct source {
    const char *name;  // as messages show it
    const char *text;  // (size) with a final 0
    size_t size;
    char *cell;     // a copy of text in which a 0 ends each word
    bool absolute;  // as of a deck_path
    bool on_disk;
    dev_t device;  // together with inode: identifies a file on disk
    ino_t inode;
    struct source *next;  // read before this one; NULL: this is the top file
};

// A source being read.
struct frame {
    struct source *source;
    size_t offset;  // of the line to read next
    int line;       // its number, from 1
};

enum parameter_kind {
    PARAMETER_NUMBER,
    PARAMETER_TEXT,
    PARAMETER_WRONG,  // the value had an error: uses fail without another message
};

struct parameter {
    const char *name;
    enum parameter_kind kind;
    struct quantity number;
    const char *text;
    const struct source *origin;  // of the text: a file of that name is relative to this source
    struct place param, sweep;    // its statements; source NULL: there is no such statement
    bool used;
    bool swept;    // its value depends on a sweep
    bool derived;  // the value of its param depends on a sweep
    struct parameter *next_in_bucket;
    struct parameter *next;  // in the order of the deck
};

// A -D NAME=VALUE.
struct define {
    const char *name;
    struct word value;            // at line 0 of `source`
    struct source source;         // named "-D NAME=VALUE"
    bool taken;                   // used, or reported as an error
    const struct source *beside;  // the file of a label is relative to it; NULL: not a label
};

struct reader {
    struct source *source;  // the last one read, linked to all earlier ones
    struct frame frame[INCLUDE_DEPTH_MAX];
    int n_frame;
    size_t bytes;  // read so far; a source that is included twice counts twice

    struct word *word;  // (word_capacity) of the current statement; malloc'd
    int n_word, word_capacity;

    struct parameter **bucket;  // (n_bucket) hash table by names
    size_t n_bucket;
    struct parameter *first, *last;
    int n_parameter;
    struct define *define;  // (n_define)
    int n_define;

    // Places of these statements; source NULL: not read yet. `other` is the first statement that
    // must be below units.
    struct place title, units, gravity, other;
    bool gravity_used;  // the unit g was used

    const struct deck *first_reading;  // of a study, of which this is one run; NULL: none
    const struct sweep *bound;         // sweeps of the first reading; NULL: none
    const int *choice;                 // number of the value of each sweep in this run
    struct sweep *last_sweep;
    struct bundle *bundles;  // dimensions of paired sweeps; NULL: none
    struct law *laws;        // distributions of random sweeps, the last first; NULL: none
    int n_sweep;
    bool swept;   // a parameter was read whose value depends on a sweep
    bool late;    // a sweep replaces the value of a parameter that was used above the sweep
    bool turned;  // deck_define_turn changed a -D: the deck must be read again
    bool ended;
    size_t n_repeated;  // values from repeats so far
    size_t n_replaced;  // bytes of words with replaced parameters so far
};

// Adds a source with the 0-terminated `text`, which is borrowed. NULL: no memory.
struct source *source_add(struct deck *d, const char *name, const char *text, size_t size);
// `name` as a path relative to the directory of `s`; NULL: no memory.
const char *source_path(struct deck *d, const struct source *s, const char *name);
// Starts reading `s`, unless it has a 0 byte, which is reported. The caller has checked that a
// frame is free.
void source_enter(struct deck *d, struct source *s);
// "line 3", or "line 3 of other.deck" if `p` is in another file than `from`.
const char *source_mention(struct deck *d, const struct place *p, const struct place *from);

// The part of `w` from `from` to `to` as a word of its own, for messages.
struct word deck_report_part(struct deck *d, const struct word *w, const char *from,
                             const char *to);
// Reports an error at this part of `w`; returns false.
bool deck_report_false(struct deck *d, const struct word *w, const char *from, const char *to,
                       const char *format, ...) __attribute__((format(printf, 5, 6)));

// Whether a word depends on a sweep is noted in deck.varies. Call reader_note_sweeps before the
// word is read and give its result to reader_noted_sweeps afterwards.
static inline bool reader_note_sweeps(struct deck *d) {
    const bool before = d->reader->swept;
    d->reader->swept = false;
    return before;
}

static inline void reader_noted_sweeps(struct deck *d, bool before) {
    d->varies = d->varies || d->reader->swept;
    d->reader->swept = d->reader->swept || before;
}

// Statements: how they are split into words, and how those of the language itself are carried out.

// The next statement of the file in `f`; false at its end. Wrong lines are reported and left out.
bool scan_statement(struct deck *d, struct frame *f, struct statement *out);
// Carries out a statement of the language itself; false: `s` is another statement.
bool statement_run(struct deck *d, const struct statement *s);

#endif
