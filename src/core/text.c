// SPDX-License-Identifier: GPL-3.0-or-later
// Numbers, characters, near words and file names.
#include "core/text.h"

#include <ctype.h>
#include <float.h>
#include <langinfo.h>
#include <locale.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

static bool is_digit(char c) {
    return c >= '0' && c <= '9';
}

// A decimal number as it is written: whole * 10^scale. Numbers from LONG_NUMBER on stay there.
struct decimal {
    long long whole, scale;
};
static const long long LONG_NUMBER = 1000000000000000;  // of more than 15 digits

// Appends the digits at `at` to *whole; their end.
static const char *take_digits(const char *at, long long *whole) {
    for (; is_digit(*at); at++) {
        *whole = *whole < LONG_NUMBER ? 10 * *whole + (*at - '0') : LONG_NUMBER;
    }
    return at;
}

// The end of the exponent at `at`, where there is one; otherwise `at`.
static const char *take_exponent(const char *at, struct decimal *d) {
    if (*at != 'e' && *at != 'E') {
        return at;
    }
    const char *digits = at + 1 + (at[1] == '+' || at[1] == '-');
    long long power = 0;
    const char *end = take_digits(digits, &power);
    d->scale += at[1] == '-' ? -power : power;
    return end > digits ? end : at;
}

// The end of the decimal number at `text`; NULL: none stands there.
static const char *take_decimal(const char *text, struct decimal *d) {
    const char *start = text + (*text == '+' || *text == '-');
    const char *at = take_digits(start, &d->whole);
    long n_digit = at - start;
    if (*at == '.') {
        const char *fraction = at + 1;
        at = take_digits(fraction, &d->whole);
        d->scale = fraction - at;
        n_digit += at - fraction;
    }
    if (n_digit == 0) {
        return NULL;
    }
    return take_exponent(at, d);
}

// The number where one operation gives it, and so the double nearest to it: at most 15 digits are a
// whole number that doubles hold, and so are powers of ten up to 22 (Clinger 1990, How to read
// floating point numbers accurately, section 3). NAN: it takes more.
static double short_number(const struct decimal *d) {
    static const double power[] = {1e0,  1e1,  1e2,  1e3,  1e4,  1e5,  1e6,  1e7,
                                   1e8,  1e9,  1e10, 1e11, 1e12, 1e13, 1e14, 1e15,
                                   1e16, 1e17, 1e18, 1e19, 1e20, 1e21, 1e22};
    enum { POWER_MAX = sizeof power / sizeof power[0] - 1 };
    if (FLT_EVAL_METHOD != 0 || d->whole >= LONG_NUMBER || d->scale > POWER_MAX ||
        d->scale < -POWER_MAX) {
        return NAN;
    }
    const double whole = (double)d->whole;
    return d->scale < 0 ? whole / power[-d->scale] : whole * power[d->scale];
}

// strtod in the C locale, whatever the locale of the thread is.
static double number_value(const char *text, char **stop) {
    if (strcmp(nl_langinfo(RADIXCHAR), ".") == 0) {
        return strtod(text, stop);
    }
    locale_t plain = newlocale(LC_ALL_MASK, "C", (locale_t)0);
    if (plain == (locale_t)0) {
        *stop = NULL;
        return NAN;
    }
    locale_t before = uselocale(plain);
    double value = strtod(text, stop);
    uselocale(before);
    freelocale(plain);
    return value;
}

enum text_number text_number(const char *text, const char **end, double *value) {
    *end = text;
    *value = NAN;
    struct decimal decimal = {0, 0};
    const char *last = take_decimal(text, &decimal);
    if (!last) {
        return TEXT_NUMBER_NONE;
    }
    *end = last;
    const double size = short_number(&decimal);
    if (!isnan(size)) {
        *value = *text == '-' ? -size : size;
        return TEXT_NUMBER_OK;
    }
    char *stop;
    double v = number_value(text, &stop);
    if (!stop) {
        *end = text;
        return TEXT_NUMBER_NONE;
    }
    if (stop > last) {  // strtod went on reading 0x...
        v = *text == '-' ? -0.0 : 0.0;
    }
    if (!isfinite(v)) {
        return TEXT_NUMBER_RANGE;
    }
    *value = v;
    return TEXT_NUMBER_OK;
}

enum {
    WORD_MAX = 64,
    SHARED_MIN = 3,  // letters that words share at least, of which one goes on where the other ends
};

static int lower(char c) {
    return c >= 'A' && c <= 'Z' ? c - 'A' + 'a' : c;
}

static int smaller(int a, int b) {
    return a < b ? a : b;
}

static int exact(char c) {
    return c;
}

// Edit distance with swaps of neighbours (restricted Damerau-Levenshtein distance), row by row.
// Both words have fewer than WORD_MAX bytes; `fold` makes letters equal that count as equal.
static int edit_distance(const char *a, int n, const char *b, int m, int (*fold)(char)) {
    int row[3][WORD_MAX];
    int *before = row[0], *last = row[1], *now = row[2];
    for (int j = 0; j <= m; j++) {
        last[j] = j;
    }
    for (int i = 1; i <= n; i++) {
        now[0] = i;
        for (int j = 1; j <= m; j++) {
            bool same = fold(a[i - 1]) == fold(b[j - 1]);
            now[j] = smaller(last[j - 1] + !same, 1 + smaller(last[j], now[j - 1]));
            if (i > 1 && j > 1 && fold(a[i - 1]) == fold(b[j - 2]) &&
                fold(a[i - 2]) == fold(b[j - 1])) {
                now[j] = smaller(now[j], before[j - 2] + 1);
            }
        }
        int *spare = before;
        before = last;
        last = now;
        now = spare;
    }
    return last[m];
}

// True if one word goes on where the other ends: `known` anyhow, `word` by no letter or digit.
static bool is_relative(const char *word, const char *known) {
    size_t shared = 0;
    while (word[shared] && word[shared] == known[shared]) {
        shared++;
    }
    bool whole = !word[shared] || (!known[shared] && !isalnum((unsigned char)word[shared]));
    return whole && shared >= SHARED_MIN;
}

// The only known word of which that is so; NULL: there is none, or there are several.
static const char *only_relative(const char *word, const char *const *known, int n) {
    const char *relative = NULL;
    for (int i = 0; i < n; i++) {
        if (is_relative(word, known[i])) {
            if (relative) {
                return NULL;
            }
            relative = known[i];
        }
    }
    return relative;
}

const char *text_nearest(const char *word, const char *const *known, int n) {
    size_t length = strlen(word);
    if (length >= WORD_MAX || length == 0) {
        return NULL;
    }
    int limit = length >= 6 ? (int)length / 3 : 1;
    limit = smaller(limit, (int)length - (word[0] == '-') - 1);
    int best = WORD_MAX * WORD_MAX;
    const char *nearest = NULL;
    for (int i = 0; i < n; i++) {
        int other = (int)strnlen(known[i], WORD_MAX);
        if (other == WORD_MAX) {
            continue;
        }
        int folded = edit_distance(word, (int)length, known[i], other, lower);
        int score = WORD_MAX * folded + edit_distance(word, (int)length, known[i], other, exact);
        if (folded <= limit && score < best) {
            best = score;
            nearest = known[i];
        }
    }
    return nearest ? nearest : only_relative(word, known, n);
}

const char *text_stem(const char *path, size_t *n) {
    const char *slash = strrchr(path, '/');
    const char *name = slash ? slash + 1 : path;
    const char *dot = strrchr(name, '.');
    *n = dot && dot > name ? (size_t)(dot - name) : strlen(name);
    return name;
}

static bool is_between(unsigned char c, int low, int high) {
    return c >= low && c <= high;
}

// Unicode 15, table 3-7: well-formed UTF-8 byte sequences.
size_t text_character(const char *text, size_t n) {
    unsigned char c[4] = {0};
    memcpy(c, text, n < 4 ? n : 4);
    if (is_between(c[0], 0x01, 0x7F)) {
        return 1;
    }
    if (is_between(c[0], 0xC2, 0xDF) && is_between(c[1], 0x80, 0xBF)) {
        return 2;
    }
    if (is_between(c[0], 0xE0, 0xEF)) {
        int low = c[0] == 0xE0 ? 0xA0 : 0x80;   // no overlong forms
        int high = c[0] == 0xED ? 0x9F : 0xBF;  // no surrogates
        return is_between(c[1], low, high) && is_between(c[2], 0x80, 0xBF) ? 3 : 0;
    }
    if (is_between(c[0], 0xF0, 0xF4)) {
        int low = c[0] == 0xF0 ? 0x90 : 0x80;
        int high = c[0] == 0xF4 ? 0x8F : 0xBF;  // up to U+10FFFF
        return is_between(c[1], low, high) && is_between(c[2], 0x80, 0xBF) &&
                       is_between(c[3], 0x80, 0xBF)
                   ? 4
                   : 0;
    }
    return 0;
}

bool text_is_control(const char *text, size_t size) {
    unsigned char first = (unsigned char)text[0];
    return (size == 1 && (first < 0x20 || first == 0x7F)) ||
           (size == 2 && first == 0xC2 && (unsigned char)text[1] < 0xA0);
}

int text_columns(const char *text, size_t n) {
    int columns = 0;
    for (size_t i = 0; i < n; columns++) {
        size_t size = text_character(text + i, n - i);
        i += size ? size : 1;
    }
    return columns;
}

bool text_is_utf8(const char *text, size_t n, size_t *at) {
    for (size_t i = 0; i < n;) {
        size_t size = text_character(text + i, n - i);
        if (size == 0) {
            *at = i;
            return false;
        }
        i += size;
    }
    return true;
}

size_t text_cut(const char *text, size_t n) {
    size_t start = n;
    while (start > 0 && n - start < 3 && ((unsigned char)text[start - 1] & 0xC0) == 0x80) {
        start--;
    }
    if (start == 0 || (unsigned char)text[start - 1] < 0xC0) {
        return n;
    }
    return text_character(text + start - 1, n - start + 1) ? n : start - 1;
}

void text_clean(char *to, size_t size, const char *text, size_t n) {
    size_t used = 0;
    for (size_t i = 0; i < n;) {
        size_t bytes = text_character(text + i, n - i);
        size_t step = bytes ? bytes : 1;
        bool shown = bytes && !text_is_control(text + i, bytes);
        size_t room = shown ? bytes : 1;
        if (used + room + 1 > size) {
            break;
        }
        if (shown) {
            memcpy(to + used, text + i, bytes);
        } else {
            to[used] = text[i] == '\t' ? ' ' : '?';
        }
        used += room;
        i += step;
    }
    to[used] = 0;
}

const char *text_short(struct text_short *s, const char *text) {
    size_t n = strnlen(text, sizeof s->text);
    if (n < sizeof s->text) {
        text_clean(s->text, sizeof s->text, text, n);
    } else {
        text_clean(s->text, sizeof s->text - 3, text, text_cut(text, sizeof s->text - 4));
        memcpy(s->text + strlen(s->text), "...", sizeof "...");
    }
    return s->text;
}

const char *text_exact(struct text_exact *t, double value) {
    for (int digits = 15; digits <= 17; digits++) {
        snprintf(t->text, sizeof t->text, "%.*g", digits, value);
        if (strtod(t->text, NULL) == value) {
            break;
        }
    }
    return t->text;
}

const char *text_more(struct text_more *t, int n) {
    snprintf(t->text, sizeof t->text, n > 1 ? " (and %d more)" : "", n - 1);
    return t->text;
}
