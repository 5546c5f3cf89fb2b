// SPDX-License-Identifier: GPL-3.0-or-later
// The deck language: text -> statements, words -> quantities in the deck's units. Knows no physics.
//
// A deck is read statement by statement, so names and parameters must be defined above their use.
// deck_next carries out the statements of the language itself (title, units, gravity, param, sweep,
// include) and returns the next other statement. Errors are collected in `diagnostics`, and reading
// goes on, so that all errors of a deck are reported together.
#ifndef JOSTLE_DECK_H
#define JOSTLE_DECK_H

#include "jostle/checksum.h"
#include "jostle/error.h"
#include "jostle/names.h"
#include "jostle/row.h"
#include "jostle/units.h"

JOSTLE_C_BEGIN

struct source;  // one file of the deck

// The place of a word.
struct place {
    const struct source *source;
    int line, column, width;  // line and column from 1, in characters
};

struct word {
    const char *text;  // without quotes; parameters not yet replaced
    bool quoted;
    struct place place;
};

// True for an option: an unquoted `-` followed by a letter.
bool deck_is_option(const struct word *w);

// Consecutive lines of a file.
struct deck_lines {
    const char *text;  // (size) borrowed from the deck; NULL: none
    size_t size;
    int n_line;
};

// A statement: word[0] is the command, then plain words up to n_plain, then options.
struct statement {
    struct word *word;
    int n_word;
    int n_plain;
    struct deck_lines lines;    // of the statement in its file
    const struct sweep *known;  // a sweep that an earlier reading has read: `word` then has the
                                // first words only; NULL: `word` has all words
};

// A file that the deck names as input.
struct deck_path {
    const char *path;
    bool absolute;  // the deck names it, or the included deck that does, by an absolute path; else
                    // `path` begins with the folder of the deck
    bool included;  // the file is an included deck
    const struct deck_path *next;
};

enum { STUDY_SWEEPS_MAX = 8, SWEEP_VALUES_MAX = 1000000, STUDY_RUNS_MAX = 10000000 };

struct random_values;

// The values that a sweep gives to its parameter, in the order of the deck.
struct sweep {
    const char *name;
    int n;                        // number of values; 1 if -D fixes the parameter
    bool fixed;                   // -D fixes the parameter
    const double *number;         // (n) values in the deck's units; NULL: texts
    const char *const *text;      // (n) values; NULL: numbers
    const struct source *origin;  // files named by the texts are relative to this source
    const char *const *label;     // (n) text, or the shortest name of a file; NULL: numbers
    bool known;                   // the numbers have a unit
    struct dimension dimension;   // of the numbers
    const char *units;            // of a sweep read from a result file; "" for texts
    struct deck_lines lines;      // of the statement; none if its values use parameters
    // The next of the paired sweeps, whose value i belongs to number i of this dimension. NULL:
    // none.
    const struct sweep *along;
    bool random;                      // the values are drawn
    const struct random_values *law;  // from this distribution, if the deck has been read
    const struct sweep *next;
};

struct deck {
    struct arena *arena;  // owns everything below
    struct diagnostics diagnostics;
    struct unit_system units;
    const char *path;               // as given
    const char *text;               // of the top file
    const char *title;              // "" if none
    const struct deck_path *files;  // included files, records and histories; not the deck itself
    const struct sweep *sweeps;     // in the order of the deck
    long n_run;                     // number of runs of the study; 1 without sweeps
    bool varies;  // a word that names floors, links or laws, or a whole number, depends on a sweep
    bool torn;  // a statement or an included file could not be read: do not report what is missing
    struct reader *reader;
};

// Opens the deck at `path`. `define` holds `n_define` texts NAME=VALUE from the command line, which
// override the deck's params. Errors: STATUS_SYSTEM (cannot be read, no memory), STATUS_INPUT (does
// not exist, is a directory, contains 0 bytes, is larger than 64 MiB). *out must be given to
// deck_free; NULL after an error.
int deck_open(const char *path, const char *const *define, int n_define, struct deck **out,
              struct error *e);

// Opens a deck from `text`. `path` is its name in messages; included files are relative to it.
// Errors and *out: as deck_open.
int deck_open_text(const char *path, const char *text, const char *const *define, int n_define,
                   struct deck **out, struct error *e);
void deck_free(struct deck *d);  // NULL is allowed

// The checksum of the statements of a deck, except the title, without comments and layout. Of
// included decks only the names in the deck count. Errors: those of deck_open.
int deck_meaning(const char *text, struct checksum *out, struct error *e);
int deck_meaning_of_file(const char *path, struct checksum *out, struct error *e);

// Reads the deck to its end and adds what it says to a checksum: its statements in their order with
// the values of their parameters, but not the title, comments, layout and parameters that nothing
// uses. Two readings that add the same build the same model from the same files. Files that the
// deck names are in deck.files afterwards; their contents are not added. False: the deck has an
// error that may depend on more than what was added.
struct checksum_sum;
bool deck_key(struct deck *d, struct checksum_sum *to);

// Selects one run of a study; call it before the first statement is read. `first` is another
// reading of this deck that has come to its end. A swept parameter takes value choice[k] of sweep
// number k of `first`. `first` and `choice` are borrowed. Without deck_bind a parameter takes its
// first value.
void deck_bind(struct deck *d, const struct deck *first, const int *choice);

// True if the deck that has been read has a sweep that -D does not fix.
bool deck_is_study(const struct deck *d);

// The first sweep that is not random among `s` and the sweeps paired with it. Tables name runs by
// its values. NULL: all are random.
const struct sweep *sweep_named(const struct sweep *s);

// The next statement; false at the end of the deck, where each -D without a parameter of its name
// is reported. Words live as long as the deck.
bool deck_next(struct deck *d, struct statement *out);

// Call it at the end of the deck. True if the deck must be read again: a sweep replaces a param
// that was used above the sweep, or a -D chooses a number of paired sweeps. The deck is then reset
// to its first statement, without messages. In the second reading the param has the value of the
// first run, and the -D acts on all paired sweeps.
bool deck_rewind(struct deck *d);

// What the user gave for one row.
struct argument {
    bool given;
    struct word key;          // the option word; for plain words, the first word
    int n;                    // number of values (repeats expanded)
    double *number;           // (n) in the deck's units; NULL for text rows
    bool bare;                // the last number has no unit
    const char **text;        // (n) with parameters replaced; NULL for number rows
    const struct word *word;  // (n) the word each value came from
};

// Reads the `n_word` words as the value of `row`: numbers are evaluated, checked against dimension
// and range, and converted. False after having reported an error. `power` is the
// exponent for rows whose dimension depends on one (ROW_PER_..._POWER).
bool deck_values(struct deck *d, const struct row *row, double power, const struct word *word,
                 int n_word, struct argument *out);

// Matches the options of `s` with rows: `set` holds `n_set` tables of rows, set[i].n_row each;
// argument[i] (length set[i].n_row) receives the values. Rows not given get their fallback,
// converted to the deck's units, with given = false and n = 1 (n = 0 without a fallback). False
// after having reported unknown, repeated, missing or unexpected words.
struct row_set {
    const struct row *row;
    int n_row;
    struct argument *argument;  // (n_row) out
};
bool deck_options(struct deck *d, const struct statement *s, struct row_set *set, int n_set);

// The words given after option `key`, without evaluating them; NULL if it is not given. For
// options that decide which others are allowed (-law).
const struct word *deck_option(const struct statement *s, const char *key, int *n_word);

// The text of one word with parameters replaced; NULL after having reported an error.
const char *deck_text(struct deck *d, const struct word *w);

// The text of one word that is the name of a file or a title: unlike deck_text it does not set
// deck.varies, because such texts do not change floors, links and laws.
const char *deck_text_of_file(struct deck *d, const struct word *w);

// A zeroed array from the deck's arena; NULL: no memory, which diagnostics.out_of_memory remembers.
void *deck_array(struct deck *d, size_t n, size_t size);

// The acceleration of gravity [m/s^2], for a statement that reads values in units of g. A gravity
// statement after this call is an error, because it would come too late.
double deck_gravity(struct deck *d);

// The path of the file `name`, which the word `w` gives. The path is relative to the deck file of
// `w` or, if `w` is a parameter, to the deck file of its value (the top file for a -D). NULL: no
// memory, which diagnostics.out_of_memory remembers.
const char *deck_file(struct deck *d, const struct word *w, const char *name);

// All parameters as "NAME = VALUE" lines, for the record in the result file.
const char *deck_parameters(struct deck *d);

// The texts of the included files in the order read, each once, after a line "# include PATH".
// NULL: no memory.
const char *deck_includes(struct deck *d);

// Quotes `value`, which the word `w` gives, for a message: 'elastik', or 'elastik' (from $law) if
// `w` has parameters.
struct deck_quote {
    char text[160];
};
const char *deck_quote(struct deck_quote *q, const struct word *w, const char *value);

// Report at the word `w`; NULL: at the end of the deck, where a missing statement could be added.
// deck_unknown quotes `value`, which `w` gives, and suggests the nearest of `known` (n texts),
// which it returns: "unknown contact law 'herz'; did you mean 'hertz'?". If none is near, it lists
// `known`, unless they are many, and returns NULL.
//
// deck_error returns false.
bool deck_error(struct deck *d, const struct word *w, const char *format, ...)
    __attribute__((format(printf, 3, 4)));
// Reports the message of `e` at `w`; diagnostics.system remembers a STATUS_SYSTEM.
void deck_error_of(struct deck *d, const struct word *w, const struct error *e);
void deck_warning(struct deck *d, const struct word *w, const char *format, ...)
    __attribute__((format(printf, 3, 4)));
const char *deck_unknown(struct deck *d, const struct word *w, const char *value, const char *what,
                         const char *const *known, int n);

// The number of the word in the `known` keywords (n), from 0; -1 after having reported that it is
// not one of them.
int deck_keyword(struct deck *d, const struct word *w, const char *what, const char *const *known,
                 int n);

// The statements that the language itself carries out, for help texts: name, usage, meaning.
struct deck_statement {
    const char *name, *usage, *doc;
};
extern const struct deck_statement deck_statements[];
extern const int n_deck_statement;

JOSTLE_C_END

#endif
