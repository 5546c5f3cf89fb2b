// SPDX-License-Identifier: GPL-3.0-or-later
// Numbers from text, and back.
#include "core/text.h"

#include <assert.h>
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

// The end of the exponent at `at`; `at` if there is none.
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

// The end of the decimal number at `text`; NULL: there is none.
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

// The double nearest to the number, if one operation is enough: doubles hold whole numbers of up to
// 15 digits and powers of ten up to 22 exactly (Clinger 1990, How to read floating point numbers
// accurately, section 3). NAN: one operation is not enough.
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
    assert(text && end && value);
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

const char *text_exact(struct text_exact *t, double value) {
    for (int digits = 15; digits <= 17; digits++) {
        snprintf(t->text, sizeof t->text, "%.*g", digits, value);
        if (strtod(t->text, NULL) == value) {
            break;
        }
    }
    return t->text;
}

const char *text_rounded(struct text_exact *t, double value, int digits) {
    assert(digits > 0);
    const double size = fabs(value), largest = 1e15;
    if (!(size >= pow(10.0, digits) - 0.5 && size < largest)) {
        snprintf(t->text, sizeof t->text, "%.*g", digits, value);
        return t->text;
    }
    const double unit = pow(10.0, floor(log10(size)) + 1.0 - digits);
    snprintf(t->text, sizeof t->text, "%.0f", unit * round(value / unit));
    return t->text;
}
