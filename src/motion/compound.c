// SPDX-License-Identifier: GPL-3.0-or-later
// Fields of Fortran output that hold several values. The rules of repeat counts, and of exponents
// without a letter, are those of Fortran 2018, ISO/IEC 1539-1, 13.7.2.3 and 13.10.3.
#include "motion/lines.h"

#include <string.h>

enum { REPEAT_DIGITS = 6, EXPONENT_DIGITS = 3 };

static bool is_digit_at(struct piece s, size_t i) {
    return i < s.n && s.text[i] >= '0' && s.text[i] <= '9';
}

static bool is_one_of(struct piece s, size_t i, const char *set) {
    return i < s.n && s.text[i] != '\0' && strchr(set, s.text[i]);
}

// The end of the digits that begin at `i`.
static size_t skip_digits(struct piece s, size_t i) {
    while (is_digit_at(s, i)) {
        i++;
    }
    return i;
}

// The end of the exponent that begins at `i`; `i`: there is no exponent. *ambiguous: some of its
// digits may belong to the next number.
static size_t skip_exponent(struct piece s, size_t i, bool *ambiguous) {
    size_t end = i;
    if (is_one_of(s, i, "EeDd")) {
        end = skip_digits(s, i + 1 + is_one_of(s, i + 1, "+-"));
    } else if (is_one_of(s, i, "+-") && skip_digits(s, i + 1) == i + 1 + EXPONENT_DIGITS) {
        end = i + 1 + EXPONENT_DIGITS;
    }
    *ambiguous = end > i && is_one_of(s, end, ".");
    return end;
}

// Length of the number with a decimal point at the start of `s`; 0: there is no such number.
static size_t number_length(struct piece s, bool *ambiguous) {
    const size_t sign = is_one_of(s, 0, "+-");
    const size_t point = skip_digits(s, sign);
    if (!is_one_of(s, point, ".")) {
        return 0;
    }
    const size_t end = skip_digits(s, point + 1);
    return end > sign + 1 ? skip_exponent(s, end, ambiguous) : 0;
}

// Count of numbers in a field that contains only numbers; 0: it contains something else.
static size_t count_touching(struct piece s, bool *ambiguous) {
    size_t n = 0;
    for (size_t length; s.n > 0; n++) {
        length = number_length(s, ambiguous);
        if (length == 0 || *ambiguous || (length < s.n && !is_one_of(s, length, "+-"))) {
            return 0;
        }
        s = (struct piece){s.text + length, s.n - length};
    }
    return n;
}

static bool read_repeat(struct piece field, struct compound *out) {
    const size_t star = skip_digits(field, 0);
    double value, count;
    if (star == 0 || star > REPEAT_DIGITS || !is_one_of(field, star, "*")) {
        return false;
    }
    const struct piece number = {field.text + star + 1, field.n - star - 1};
    if (lines_number((struct piece){field.text, star}, &count) != NUMBER_OK || count < 1 ||
        lines_number(number, &value) != NUMBER_OK) {
        return false;
    }
    *out = (struct compound){COMPOUND_REPEATED, number, (size_t)count};
    return true;
}

// True if the text is a number without an exponent, a sign and digits to the end.
static bool lacks_letter(struct piece s) {
    bool ambiguous;
    const size_t point = skip_digits(s, is_one_of(s, 0, "+-"));
    const size_t sign = number_length(s, &ambiguous);
    return sign > 0 && sign == skip_digits(s, point + 1) && sign + 1 < s.n &&
           is_one_of(s, sign, "+-") && skip_digits(s, sign + 1) == s.n;
}

struct compound compound_of(struct piece field) {
    struct compound c = {COMPOUND_ONE, field, 1};
    if (read_repeat(field, &c)) {
        return c;
    }
    bool ambiguous = false;
    const size_t n = count_touching(field, &ambiguous);
    if (ambiguous) {
        c.kind = COMPOUND_AMBIGUOUS;
    } else if (n > 1) {
        c = (struct compound){COMPOUND_TOUCHING, field, n};
    } else if (n == 0 && lacks_letter(field)) {
        c.kind = COMPOUND_NO_LETTER;
    }
    return c;
}

struct piece compound_next(struct compound *c) {
    if (c->kind != COMPOUND_TOUCHING) {
        return c->rest;
    }
    bool ambiguous;
    const struct piece number = {c->rest.text, number_length(c->rest, &ambiguous)};
    c->rest.text += number.n;
    c->rest.n -= number.n;
    return number;
}
