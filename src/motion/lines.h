// SPDX-License-Identifier: GPL-3.0-or-later
// Lines, fields and numbers of a record file, and messages that point into it.
#ifndef JOSTLE_MOTION_LINES_H
#define JOSTLE_MOTION_LINES_H

#include <stdbool.h>
#include <stddef.h>

#include "jostle/error.h"

struct record_text;

// A piece of the text; not 0-terminated.
struct piece {
    const char *text;
    size_t n;
};

// A text read line by line. `line` is the current line, without spaces and carriage returns at
// either end.
struct lines {
    const char *at, *end;  // the rest of the text, after the current line
    char terminator;       // '\n', or '\r' in a file that has no '\n'
    struct piece line;
    struct piece whole;  // the current line with its spaces, for fields of a fixed width
    int number;          // number of the current line, from 1; 0 before the first
};

void lines_init(struct lines *l, const struct record_text *t);

// Goes to the next line; false at the end of the text.
bool lines_next(struct lines *l);

// Line `number`, from 1, of the lines that begin with the current line of `from`; the last line if
// the text ends before.
struct lines lines_at(struct lines from, int number);

// The piece without spaces and carriage returns at either end.
struct piece lines_trim(struct piece s);

// Takes the first field off `rest`. Spaces separate fields, or one character of `separators` (""
// or ",;") with spaces around it. A separator at the end of the line is allowed. Two separators in
// a row make an empty field. False: no field is left.
bool lines_field(struct piece *rest, const char *separators, struct piece *field);

// The number of fields in the line.
size_t lines_count(struct piece line, const char *separators);

// Takes the text in the next brackets, round or square, off `rest`; false: no brackets are left.
bool lines_bracket(struct piece *rest, struct piece *inside);

// True if a field of the line is stars and all others are numbers. Fortran writes stars for a value
// that does not fit its field. The stars may touch a number.
bool lines_overflow(struct piece line);

// The line without its comment, which begins with a single # before a space. A line that begins
// with # % ! * or // is a comment as a whole, unless it is a line of overflow.
struct piece lines_without_comment(struct piece line);

// The place of `word` (upper case) in the line, in any case and not as part of a longer word; NULL:
// the line does not have it.
const char *lines_word(struct piece line, const char *word);

// The text after `word` in the line; empty if the line does not have the word.
struct piece lines_behind(struct piece line, const char *word);

// The field after `word` and an equals sign, separated by spaces or a comma; it may be empty.
// False: the line does not have the word with an equals sign.
bool lines_value(struct piece line, const char *word, struct piece *value);

// True if the line contains `text` (upper case), in any case.
bool lines_contain(struct piece line, const char *text);

// How reading a field as a number ended.
enum number { NUMBER_OK, NUMBER_BAD, NUMBER_RANGE };

// Reads the whole field as a decimal number of C or Fortran: also 1.5D-3, .5E+00, 1.234567-105
// (Fortran drops the E before an exponent of three digits).
enum number lines_number(struct piece field, double *value);

// True if the field begins like a number, or is nan or inf. So a number with a typing error does
// not count as a word.
bool lines_number_like(struct piece field);

// `field` for a message: at most 40 bytes. Control characters and stray bytes become `?`.
struct excerpt {
    char text[48];
};
struct excerpt lines_excerpt(struct piece field);

// Sets an error of STATUS_INPUT whose message begins with "path:line: ", or "path: " if line is 0.
int lines_error(struct error *e, const char *path, int line, const char *format, ...)
    __attribute__((format(printf, 4, 5)));

// "path:line" for a message. A path over 200 bytes loses its beginning, to leave room for the
// cause.
struct line_place {
    char text[240];
};
struct line_place lines_place(const char *path, int line);

// "path:line:column" of a field of the text; columns are characters, from 1.
struct line_place lines_place_field(const struct record_text *t, int line, struct piece field);

// A field that should be a number: `what` ("value", "time") and `index`, from 1, name it in
// messages.
struct number_field {
    const struct record_text *text;
    int line;
    const char *what;
    size_t index;
    struct piece field;
};

// Sets an error of STATUS_INPUT about the stars of an overflow, with `what` before and `where`
// after them.
int lines_overflow_error(struct error *e, const struct record_text *t, int line, const char *what,
                         struct piece stars, const char *where);

// Reads the field as lines_number does; STATUS_INPUT with the reason if it is not a number.
int lines_read_number(const struct number_field *f, double *value, struct error *e);

// Fields of Fortran output that hold several values: repeat counts, 60*0.0, and numbers that touch,
// 1.2345E-01-2.3456E-02.

enum compound_kind {
    COMPOUND_ONE,        // one value, or not a number
    COMPOUND_REPEATED,   // one value, n times
    COMPOUND_TOUCHING,   // n values
    COMPOUND_AMBIGUOUS,  // numbers that touch and can be separated in two ways
    COMPOUND_NO_LETTER   // not a number: an exponent without a letter has other than three digits
};

struct compound {
    enum compound_kind kind;
    struct piece rest;  // the part of the field that has not been taken
    size_t n;           // number of values in the field; 1 if the kind is COMPOUND_ONE
};

// The values in a field between separators. Each of several numbers that touch has a decimal point,
// and the sign of the next number ends it. 1.234-103 is one number, with an exponent of three
// digits. So 1.234-103.5 is ambiguous.
struct compound compound_of(struct piece field);

// Takes the next value off `c`. If the kind is not COMPOUND_TOUCHING, the result is the whole
// value.
struct piece compound_next(struct compound *c);

#endif
