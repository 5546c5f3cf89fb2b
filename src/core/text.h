// SPDX-License-Identifier: GPL-3.0-or-later
// Small helpers for text: characters and file names, numbers (text_number.c), near words
// (text_nearest.c), whole files (text_file.c).
#ifndef JOSTLE_TEXT_H
#define JOSTLE_TEXT_H

#include <stdarg.h>
#include <stdbool.h>
#include <stddef.h>

#include "jostle/error.h"

struct arena;

// How reading a number ended.
enum text_number { TEXT_NUMBER_OK, TEXT_NUMBER_NONE, TEXT_NUMBER_RANGE };

// Reads a decimal number (sign, digits, point, exponent; no hex, inf or nan) at `text`; *end is the
// first character not used. TEXT_NUMBER_RANGE: too large for a double. Numbers that are too
// small become denormal or 0 without an error. The decimal point does not depend on the locale.
enum text_number text_number(const char *text, const char **end, double *value);

// The nearest of the `n` texts in `known`; NULL: none is near. Edits are insertion, removal and
// replacement of a letter and the swap of two neighbours, at most a third of the word's length (at
// least 1), and fewer than its letters, without the dash of an option. Upper and lower case are
// equal, except to break ties. If no text is so near, the result is the only text that begins with
// `word`
// (`kelvin`), or with which `word` begins, if no letter follows (`-mass=300t`).
const char *text_nearest(const char *word, const char *const *known, int n);

enum { TEXT_LISTED_MAX = 32 };  // texts that a message lists at most

// The `n` texts of `known` as a list, "one, two", in `to` of `size` bytes. Each text is clean
// and short; "..." replaces the texts that do not fit. Returns `to`.
const char *text_list(char *to, size_t size, const char *const *known, int n);

// Equal texts, or none both times; NULL: there is none.
bool text_same(const char *a, const char *b);

// The name of a file, without its folder; *n is its length without the extension. A dot at the
// start of the name does not begin an extension.
const char *text_stem(const char *path, size_t *n);

// Reads a whole regular file into the arena with a final 0. Errors name the path: STATUS_INPUT
// (does not exist, a directory, not a regular file, larger than `limit` bytes; empty is allowed),
// STATUS_SYSTEM (cannot open or read, no memory).
int text_file(struct arena *a, const char *path, size_t limit, char **text, size_t *size,
              struct error *e);

// Characters (not bytes) of the first `n` bytes of UTF-8 text; stray bytes count as one each.
int text_columns(const char *text, size_t n);

// Bytes of the character that starts the `n` >= 1 bytes of UTF-8 text; 0: it is not valid.
size_t text_character(const char *text, size_t n);

// True if the character of `size` bytes at `text` is a control character (a tab is one).
bool text_is_control(const char *text, size_t size);

// The first control character (a tab is one) or stray byte of a text; NULL: the text has none.
const char *text_not_plain(const char *text);

// True if a building can have the name, which is also that of a group of the result file. It has 1
// to 64 bytes: letters, digits, _, - and characters beyond ASCII. It does not begin with -, as
// options do.
bool text_is_name(const char *name);

// The largest length up to `n` at which `text` can be cut without splitting a character.
size_t text_cut(const char *text, size_t n);

// Copies the first `n` bytes of `text` to `to` (of `size` bytes, cut to fit, with a final 0) for
// a terminal: a tab becomes a space, other control characters and stray bytes become `?`. `to` may
// be `text`.
void text_clean(char *to, size_t size, const char *text, size_t n);

// Formats a line as vsnprintf does, cleans it as text_clean does and cuts it to fit without
// splitting a character. True if it was cut.
bool text_compose(char *to, size_t size, const char *format, va_list list)
    __attribute__((format(printf, 3, 0)));

// The shortest text, of 15 to 17 digits, that is read back as this number: 0.1, not
// 0.10000000000000001.
struct text_exact {
    char text[32];
};
const char *text_exact(struct text_exact *t, double value);

// `value` rounded to `digits` digits, without an exponent if it is large: 1030, not 1.03e+03.
const char *text_rounded(struct text_exact *t, double value, int digits);

// The end of a message about the first of n items: " (and 2 more)", or nothing if n is 1.
struct text_more {
    char text[32];
};
const char *text_more(struct text_more *t, int n);

// A word as it is quoted in a message: clean, and cut with `...` if it is long.
struct text_short {
    char text[64];
};
const char *text_short(struct text_short *s, const char *text);

#endif
