// SPDX-License-Identifier: GPL-3.0-or-later
// The deck language: text -> statements, words -> quantities in the deck's units. Knows no physics.
//
// A deck is read statement by statement, so that names and parameters must stand above their use:
// deck_next hands out the next statement after having carried out those of the language itself
// (title, units, gravity, param, sweep, include). Whatever is wrong is collected in `diagnostics`,
// and reading goes on, so that all errors of a deck come in one go.
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

// Lines of a file, and how many they are.
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
    struct deck_lines lines;    // that it takes
    const struct sweep *known;  // what it says but for its first words, which are all that is
                                // here; NULL: all words are
};

// A file that the deck names as input.
struct deck_path {
    const char *path;
    bool included;  // it is a deck
    const struct deck_path *next;
};

enum { STUDY_SWEEPS_MAX = 8, SWEEP_VALUES_MAX = 1000000, STUDY_RUNS_MAX = 10000000 };

// The values that a sweep gives to its parameter, in the order of the deck.
struct sweep {
    const char *name;
    int n;                        // values; 1 where -D fixes the parameter
    bool fixed;                   // by -D
    const double *number;         // (n) in the deck's units; NULL: texts
    const char *const *text;      // (n) what the parameter stands for; NULL: numbers
    const struct source *origin;  // that the texts name files beside
    const char *const *label;     // (n) text, or the shortest name of a file; NULL: numbers
    bool known;                   // numbers have a unit
    struct dimension dimension;   // of it
    const char *units;            // where it comes from a file; "" for texts
    struct deck_lines lines;      // that give the values; none where they use parameters
    // Of the numbers 1 ... n of sweeps that go together: the first of these, which take one of
    // their n values for each; of that the next. NULL: none.
    const struct sweep *along;
    bool random;  // its values are drawn
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
    long n_run;                     // of the study; 1 without sweeps
    bool varies;  // a word that names floors, links or laws, or a whole number, depends on a sweep
    bool torn;  // a statement, or a file of them, could not be read: others may seem to be missing
    struct reader *reader;
};

// Opens the deck at `path`. `define` holds `n_define` texts NAME=VALUE from the command line, which
// override the deck's params. Errors: STATUS_SYSTEM (cannot be read, no memory), STATUS_INPUT (does
// not exist, is a directory, contains 0 bytes, is larger than 64 MiB). *out must be given to
// deck_free; NULL after an error.
int deck_open(const char *path, const char *const *define, int n_define, struct deck **out,
              struct error *e);

// The same from `text`; `path` only names it and locates included files.
int deck_open_text(const char *path, const char *text, const char *const *define, int n_define,
                   struct deck **out, struct error *e);
void deck_free(struct deck *d);  // NULL is allowed

// The checksum of what a deck means: of its statements but the title, without comments and layout.
// Included decks count by the names that the deck has for them only. Errors: those of deck_open.
int deck_meaning(const char *text, struct checksum *out, struct error *e);
int deck_meaning_of_file(const char *path, struct checksum *out, struct error *e);

// Makes the deck that of one run of a study, before its first statement is read: a swept parameter
// takes value choice[k] of sweep number k of `first`, another reading of this deck that has come to
// its end; both are borrowed. Otherwise it takes the first value.
void deck_bind(struct deck *d, const struct deck *first, const int *choice);

// True if the deck that has been read has a sweep that -D does not fix.
bool deck_is_study(const struct deck *d);

// `s`, or the next along it, by whose values tables name a run: they are not drawn. NULL: none.
const struct sweep *sweep_named(const struct sweep *s);

// The next statement; false at the end of the deck, when -D names that no param took are reported
// too. Words live as long as the deck.
bool deck_next(struct deck *d, struct statement *out);

// To be asked at the end of the deck. True where a sweep gives values to a param that was used
// above the sweep, or a -D chooses among sweeps that go together: then the deck stands before its
// first statement again, what was read and reported is void, and the param gives the value of the
// first run, or the -D its choice.
bool deck_rewind(struct deck *d);

// What the user gave for one row.
struct argument {
    bool given;
    struct word key;          // the option word; for plain words, the first of them
    int n;                    // values (repeats expanded)
    double *number;           // (n) in the deck's units; NULL for text rows
    bool bare;                // given as numbers, the last of which has no unit
    const char **text;        // (n) with parameters replaced; NULL for number rows
    const struct word *word;  // (n) the word each value came from
};

// Reads the `n_word` words as the value of `row`: numbers are evaluated, checked against dimension
// and range, and converted. Reports what is wrong and then returns false. `power` is the
// exponent for rows whose dimension depends on one (ROW_PER_..._POWER).
bool deck_values(struct deck *d, const struct row *row, double power, const struct word *word,
                 int n_word, struct argument *out);

// Matches the options of `s` with rows: `set` holds `n_set` tables of rows, set[i].n_row each;
// argument[i] (length set[i].n_row) receives the values. Rows not given get their fallback,
// converted to the deck's units, with given = false and n = 1 (n = 0 where there is none). Reports
// unknown, repeated, missing and useless words; false if there were any.
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

// The same of a file's name, or a title, which do not decide what floors, links and laws there are.
const char *deck_text_of_file(struct deck *d, const struct word *w);

// A zeroed array from the deck's arena; NULL: no memory, which diagnostics.out_of_memory remembers.
void *deck_array(struct deck *d, size_t n, size_t size);

// The acceleration of gravity [m/s^2] for what a statement reads in units of g. From then on a
// gravity statement is an error, as it would come too late.
double deck_gravity(struct deck *d);

// `name`, which `w` says, as a path: relative to the deck file that `w` stands in, or, where `w` is
// a parameter, to that in which its value stands (the top file for a -D). NULL: no memory, which
// diagnostics.out_of_memory remembers.
const char *deck_file(struct deck *d, const struct word *w, const char *name);

// All parameters as "NAME = VALUE" lines, for the record in the result file.
const char *deck_parameters(struct deck *d);

// The texts of the included files in the order read, each once, after a line "# include PATH".
// NULL: no memory.
const char *deck_includes(struct deck *d);

// `value`, which the word `w` stands for, as messages quote it: 'elastik', and 'elastik' (from
// $law) where `w` takes the value from parameters.
struct deck_quote {
    char text[160];
};
const char *deck_quote(struct deck_quote *q, const struct word *w, const char *value);

// Report at a word (NULL: at the end of the deck, where what is missing could be added).
// deck_unknown quotes `value`, which `w` stands for. It adds the nearest of `known` (n texts),
// which it returns, or NULL and, if there are few of them, lists them: "unknown contact law 'herz';
// did you mean 'hertz'?".
void deck_error(struct deck *d, const struct word *w, const char *format, ...)
    __attribute__((format(printf, 3, 4)));
// The same with the message of `e`; diagnostics.system remembers that it was STATUS_SYSTEM.
void deck_error_of(struct deck *d, const struct word *w, const struct error *e);
void deck_warning(struct deck *d, const struct word *w, const char *format, ...)
    __attribute__((format(printf, 3, 4)));
const char *deck_unknown(struct deck *d, const struct word *w, const char *value, const char *what,
                         const char *const *known, int n);

// Which of the `known` keywords (n) the word is; -1 after deck_unknown.
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
