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

// The line last read, without blanks and carriage returns at either end.
struct lines {
    const char *at, *end;  // what is still to come
    char terminator;       // '\n', or '\r' in a file that has no '\n'
    struct piece line;
    struct piece whole;  // the same with its blanks, for fields of a fixed width
    int number;          // of the line, from 1; 0 before the first
};

void lines_init(struct lines *l, const struct record_text *t);

// Goes to the next line; false at the end of the text.
bool lines_next(struct lines *l);

// The piece without blanks and carriage returns at either end.
struct piece lines_trim(struct piece s);

// Takes the first field off `rest`. Fields are separated by blanks, or by one character of
// `separators` ("" or ",;") with blanks around it; a separator at the end of the line is allowed,
// two in a row make an empty field. False: none is left.
bool lines_field(struct piece *rest, const char *separators, struct piece *field);

// Fields of the whole line.
size_t lines_count(struct piece line, const char *separators);

// Takes the text in the next brackets, round or square, off `rest`; false: none is left.
bool lines_bracket(struct piece *rest, struct piece *inside);

// True if a field of the line, and nothing but numbers beside it, is stars: what Fortran writes for
// a value that does not fit its field. The stars may touch a number.
bool lines_overflow(struct piece line);

// The line up to a single # that a blank follows; nothing of a line that begins with # % ! * or //.
// A line of overflow is not a comment.
struct piece lines_without_comment(struct piece line);

// The character at which `word` (upper case) stands in the line, whatever its case and not as part
// of a longer word; NULL: nowhere.
const char *lines_word(struct piece line, const char *word);

// What stands behind `word` in the line; empty: the word does not.
struct piece lines_behind(struct piece line, const char *word);

// The field, separated by blanks or a comma, that stands behind `word` and an equals sign; it may
// be empty. False: there is no such thing.
bool lines_value(struct piece line, const char *word, struct piece *value);

// True if `text` (upper case) stands anywhere in the line, whatever its case.
bool lines_contain(struct piece line, const char *text);

// How reading a field as a number ended.
enum number { NUMBER_OK, NUMBER_BAD, NUMBER_RANGE };

// A decimal number as C or Fortran writes it, and nothing else: also 1.5D-3, .5E+00, 1.234567-105
// (an exponent of three digits has driven out its E).
enum number lines_number(struct piece field, double *value);

// True if the field begins like a number, or is one of the words nan and inf: a typing error in a
// number must not make it a word.
bool lines_number_like(struct piece field);

// `field` for a message: at most 40 bytes, control characters and stray bytes as \xNN.
struct excerpt {
    char text[4 * 40 + 4];
};
struct excerpt lines_excerpt(struct piece field);

// error_set with STATUS_INPUT and "path:line: " in front; no line if it is 0.
int lines_error(struct error *e, const char *path, int line, const char *format, ...)
    __attribute__((format(printf, 4, 5)));

// "path:line" for a message; a path over 200 bytes loses its beginning, so that the cause is seen.
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

// Refuses the stars of an overflow; the message has `what` and `where` around them.
int lines_overflow_error(struct error *e, const struct record_text *t, int line, const char *what,
                         struct piece stars, const char *where);

// lines_number, with STATUS_INPUT and the reason if it is none.
int lines_read_number(const struct number_field *f, double *value, struct error *e);

#endif
