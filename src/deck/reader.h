// SPDX-License-Identifier: GPL-3.0-or-later
// What the files of src/deck/ share: sources, parameters, and the state of reading.
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

// A number in the deck's units. Where `known` is false, its dimension is whatever is needed.
struct quantity {
    double value;
    bool known;
    struct dimension dimension;
};

struct source {
    const char *name;  // as messages show it
    const char *text;  // (size) with a final 0
    size_t size;
    char *cell;  // a copy of text in which the ends of words are set to 0
    bool on_disk;
    dev_t device;  // of a file on disk: what tells files apart
    ino_t inode;
    struct source *next;
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
    PARAMETER_WRONG,  // its value was in error: uses fail without another message
};

struct parameter {
    const char *name;
    enum parameter_kind kind;
    struct quantity number;
    const char *text;
    const struct source *origin;  // of the text: a file of that name is looked for beside it
    struct place param, sweep;    // its statements; source NULL: there is none of that kind
    bool used;
    bool swept;    // its value depends on a sweep
    bool derived;  // that of its param does
    struct parameter *next_in_bucket;
    struct parameter *next;  // in the order of the deck
};

// A -D NAME=VALUE.
struct define {
    const char *name;
    struct word value;            // its place is `source`, line 0
    struct source source;         // named "-D NAME=VALUE"
    bool taken;                   // or in error: nothing more to say
    const struct source *beside;  // a label's file is looked for beside it; NULL: it is no label
};

struct reader {
    struct source *source;  // all that were read
    struct frame frame[INCLUDE_DEPTH_MAX];
    int n_frame;
    size_t bytes;  // read so far, a source that is included twice counting twice

    struct word *word;  // of the statement being read; malloc'd
    int n_word, word_capacity;

    struct parameter **bucket;  // (n_bucket) by the hashes of their names
    size_t n_bucket;
    struct parameter *first, *last;
    int n_parameter;
    struct define *define;  // (n_define)
    int n_define;

    // The places of these statements; source NULL: not read yet. `other` is the first statement
    // that units must precede.
    struct place title, units, gravity, other;
    bool gravity_used;  // the unit g

    const struct deck *first_reading;  // that this one is bound to; NULL: none
    const struct sweep *bound;  // sweeps of another reading that give their values; NULL: none
    const int *choice;
    struct sweep *last_sweep;
    struct bundle *bundles;  // of sweeps that go together; NULL: none
    int n_sweep;
    bool swept;   // a parameter was read whose value depends on a sweep
    bool late;    // a sweep gives values to a parameter that was used above it
    bool turned;  // a -D was turned to another parameter
    bool ended;
    size_t n_repeated;  // values from repeats so far
    size_t n_replaced;  // bytes of words with replaced parameters so far
};

// source.c

// Adds a source with the 0-terminated `text`, which stays where it is. NULL: no memory.
struct source *source_add(struct deck *d, const char *name, const char *text, size_t size);
// The text of line `line` (from 1).
const char *source_line(const struct source *s, int line);
// Behind the last word of the deck.
struct place source_end(const struct deck *d);
// `name` as a path relative to the directory of `s`; NULL: no memory.
const char *source_path(struct deck *d, const struct source *s, const char *name);
// Starts reading `s`; the caller has checked that a frame is free.
void source_enter(struct deck *d, struct source *s);
// The entry of deck_file in the list of the deck's files.
struct deck_path *deck_path_enter(struct deck *d, const struct word *w, const char *name);
// "line 3", or "line 3 of other.deck" where `p` is in another file than `from`.
const char *source_mention(struct deck *d, const struct place *p, const struct place *from);

// scan.c

// The next statement of the frame; false at its end. Wrong lines are reported and left out.
bool scan_statement(struct deck *d, struct frame *f, struct statement *out);

// statement.c

// Carries out a statement of the language itself; false: `s` is another one.
bool statement_run(struct deck *d, const struct statement *s);

// Whether what is read between the two depends on a sweep is noted in deck.varies; *before is that
// of the statement so far.
static inline bool reader_note_sweeps(struct deck *d) {
    const bool before = d->reader->swept;
    d->reader->swept = false;
    return before;
}

static inline void reader_noted_sweeps(struct deck *d, bool before) {
    d->varies = d->varies || d->reader->swept;
    d->reader->swept = d->reader->swept || before;
}

// sweep.c

extern const char sweep_usage[];
void sweep_run(struct deck *d, const struct statement *s);
// Adds a sweep to those of the deck; `w` is its place. False after having reported that there
// are too many of them, or of their runs.
bool sweep_append(struct deck *d, const struct word *w, struct sweep *s);
// What -D gives in place of the values.
void sweep_fix(struct deck *d, const struct parameter *p, struct sweep *s);
// The sweep over `name` of the reading that this one is bound to, and in *choice which of its
// values this run takes; NULL: there is none.
const struct sweep *sweep_bound(const struct deck *d, const char *name, int *choice);
// The sweep that the reading that this one is bound to has read from the lines at `f`, and whose
// values are the same here; NULL: none.
const struct sweep *sweep_known(const struct deck *d, const struct frame *f);
// Sets the value of `p` to number `choice` of `s`.
void sweep_choose(const struct sweep *s, int choice, struct parameter *p);

// define.c

// Splits the texts NAME=VALUE; false: no memory.
bool define_open(struct deck *d, const char *const *define, int n_define);
// Reports what is wrong with them.
void define_check(struct deck *d);
// The files that another reading has found for labels; borrowed.
void define_bind(struct deck *d, const struct deck *first);
// Makes it -D NAME=NUMBER from the next reading on, which begins when this one has ended.
void define_turn(struct deck *d, struct define *define, const char *name, int number);
// What -D gives for the parameter; NULL: nothing.
struct define *define_find(const struct deck *d, const char *name);

// parameter.c

// param NAME VALUE. A sweep over the same parameter, above or below, or a -D, gives its values in
// place of this one.
void parameter_define(struct deck *d, const struct word *name, const struct word *value);
// What defines a parameter: a param, a sweep, or both; the number of a bundle is neither's to take.
enum definition { BY_PARAM = 1, BY_SWEEP = 2, BY_BUNDLE = BY_PARAM | BY_SWEEP };
// The steps of a definition: false after having reported that `name` cannot be defined `by` this;
// reads `w`; adds the parameter with `value` or that of a -D, in which case it returns true.
bool parameter_is_free(struct deck *d, const struct word *name, enum definition by);
void parameter_read(struct deck *d, const struct word *w, struct parameter *p);
bool parameter_keep(struct deck *d, const struct word *name, enum definition by,
                    struct parameter *value);
// The source of the text of `w`: that of the parameter which it is, or its own.
const struct source *parameter_origin(const struct deck *d, const struct word *w);
// False after having reported that `w` cannot name a parameter.
bool parameter_check_name(struct deck *d, const struct word *w);
struct parameter *parameter_find(const struct deck *d, const char *name, size_t n);
// The parameter called from `from` to `to` in `w`; NULL after having reported an error.
struct parameter *parameter_get(struct deck *d, const struct word *w, const char *from,
                                const char *to);
// Reports the -D that no param took, and, in a deck without errors, parameters that nothing uses:
// an error if -D sets one, else a warning.
void parameter_close(struct deck *d);
// The end of the name at `text`; `text` itself if there is none.
const char *parameter_name_end(const char *text);

// expression.c

// Evaluates the expression from `from` to `to` (at a `}`) inside the word `w`.
bool expression_evaluate(struct deck *d, const struct word *w, const char *from, const char *to,
                         struct quantity *out);
// Reads the rest of the word, from `from`, as a number: a literal, $name or ${expression}.
bool expression_number(struct deck *d, const struct word *w, const char *from,
                       struct quantity *out);
// True if `name` (n bytes) means something in expressions and cannot be a parameter.
bool expression_is_reserved(const char *name, size_t n);

// literal.c

// Are the n characters of `text` a unit?
bool literal_is_unit(const struct deck *d, const char *text, size_t n);
// A literal with its unit at *at, which moves past it.
bool literal_read(struct deck *d, const struct word *w, const char **at, struct quantity *out);
// Reports what is at `at`, after the `number`, where the word should end; false.
bool literal_end(struct deck *d, const struct word *w, const char *at,
                 const struct quantity *number);

// quantity.c: arithmetic with dimensions; STATUS_INPUT with the cause

// *a becomes *a op *b for the operators + - * / ^.
int quantity_combine(const struct unit_system *u, char op, struct quantity *a,
                     const struct quantity *b, struct error *e);
// *a becomes the smaller (sign -1) or larger (+1) of the two.
int quantity_choose(const struct unit_system *u, int sign, struct quantity *a,
                    const struct quantity *b, struct error *e);
// The function called `name` (n bytes) of *a. STATUS_RETRY: there is none.
int quantity_function(const struct unit_system *u, const char *name, size_t n, struct quantity *a,
                      struct error *e);
extern const struct function {
    const char *name;
    double (*value)(double);
} quantity_functions[];
extern const int n_quantity_function;

// "a mass (t)", "a pure number", "a quantity in kN/m^1.5".
struct quantity_text {
    char text[96];
};
const char *quantity_describe(const struct unit_system *u, struct dimension dimension,
                              struct quantity_text *t);

// report.c

// The part of `w` from `from` to `to` as a word of its own, for messages.
struct word report_part(struct deck *d, const struct word *w, const char *from, const char *to);
// Reports an error at that part; false.
bool report_false(struct deck *d, const struct word *w, const char *from, const char *to,
                  const char *format, ...) __attribute__((format(printf, 5, 6)));

#endif
