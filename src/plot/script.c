// SPDX-License-Identifier: GPL-3.0-or-later
// Helpers of the figures.
#include "plot/script.h"

#include <assert.h>
#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

const char *const script_colour[SCRIPT_COLOURS] = {
    "#0072b2", "#d55e00", "#009e73", "#cc79a7", "#000000", "#e69f00", "#56b4e9",
};
const int script_point[SCRIPT_COLOURS] = {7, 5, 9, 13, 11, 6, 4};

void script_raise(char *text) {
    for (char *at; (at = strchr(text, '^')) != NULL;) {
        const bool simple = (at[1] == '2' || at[1] == '3') && at[2] != '.';
        if (!simple) {
            return;
        }
        at[0] = (char)0xC2;
        at[1] = (char)(at[1] == '2' ? 0xB2 : 0xB3);
    }
}

void script_unit(const struct unit_system *units, struct dimension dimension, char *text,
                 size_t size) {
    char plain[64];
    size_t n = 0;
    unit_text(units, dimension, plain, sizeof plain);
    script_raise(plain);
    for (const char *s = plain; *s && n + 2 < size; s++) {
        if (*s == '*') {
            text[n++] = (char)0xC2;
            text[n++] = (char)0xB7;
        } else {
            text[n++] = *s;
        }
    }
    text[n] = '\0';
}

int script_exponent(double largest, double least, double most) {
    const bool fits = largest < most && largest >= least;
    return fits || !(largest > 0) || isinf(largest) ? 0 : 3 * (int)floor(log10(largest) / 3);
}

void script_power(int exponent, char *text, size_t size) {
    // The digits as UTF-8; those of Latin-1 are shorter.
    static const char raised[][4] = {"\u2070", "\u00b9", "\u00b2", "\u00b3", "\u2074",
                                     "\u2075", "\u2076", "\u2077", "\u2078", "\u2079"};
    char digits[16];
    snprintf(digits, sizeof digits, "%d", abs(exponent));
    size_t n = (size_t)snprintf(text, size, "10%s", exponent < 0 ? "\u207b" : "");
    for (const char *s = digits; *s && n < size; s++) {
        n += (size_t)snprintf(text + n, size - n, "%s", raised[*s - '0']);
    }
}

void script_number(double value, char *text, size_t size) {
    assert(size > 0);
    const int exponent = isfinite(value) ? script_exponent(fabs(value), 1e-3, 1e5) : 0;
    char power[32];
    if (exponent == 0) {
        snprintf(text, size, fabs(value) >= 1e4 ? "%.0f" : "%.4g", value);
        return;
    }
    script_power(exponent, power, sizeof power);
    snprintf(text, size, "%.4g·%s", value / pow(10, exponent), power);
}

double script_step(double largest, int n) {
    assert(n > 0);
    const double raw = largest / n;
    if (!(raw >= DBL_MIN) || isinf(raw)) {
        return 1;
    }
    const double power = pow(10, floor(log10(raw)));
    const double ratio = raw / power;
    return power * (ratio <= 1 ? 1 : ratio <= 2 ? 2 : ratio <= 5 ? 5 : 10);
}

// Behind the next `n` characters.
static const char *skip(const char *text, int n) {
    for (int i = 0; *text && i < n; i++) {
        text++;
        while (((unsigned char)*text & 0xC0) == 0x80) {
            text++;
        }
    }
    return text;
}

// Of a character, as DejaVu Sans has it, which is one of the wider fonts [em].
static double letter_width(const char *at) {
    static const struct {
        const char *letters;
        double width;
    } kinds[] = {
        {"'Iijl", 0.29},
        {" ,./:;\\|\u00b7", 0.33},
        {"!\"()-[]frt\u00b9\u00b2\u00b3\u2070\u2074\u2075\u2076\u2077\u2078\u2079\u207b", 0.4},
        {"*_sz", 0.51},
        {"DGHNOQU", 0.76},
        {"#+<=>^w~\u00d7", 0.84},
        {"%&@MWm\u2026", 0.96},
    };
    char letter[8];
    snprintf(letter, sizeof letter, "%.*s", (int)(skip(at, 1) - at), at);
    for (size_t i = 0; i < sizeof kinds / sizeof kinds[0]; i++) {
        if (strstr(kinds[i].letters, letter)) {
            return kinds[i].width;
        }
    }
    const bool wide = (unsigned char)*at >= 0xE3;  // Chinese, Japanese, Korean
    return wide ? 1 : *at >= 'A' && *at <= 'Z' ? 0.67 : 0.61;
}

static double width_between(const char *from, const char *end) {
    double width = 0;
    for (; from < end; from = skip(from, 1)) {
        width += letter_width(from);
    }
    return width;
}

double script_width(const char *text) {
    return width_between(text, text + strlen(text));
}

void script_shorten(const char *name, double width, char *cut, size_t size) {
    assert(name && size > 0);
    int n = 0;
    for (const char *at = name; *at; at = skip(at, 1)) {
        n++;
    }
    const char *end = name + strlen(name), *head = end, *tail = end;
    const char *between = "";
    double shown = width_between(name, end);
    for (int kept = n - 1; kept > 0 && shown > width; kept--) {
        head = skip(name, (kept + 1) / 2);
        tail = skip(name, n - kept / 2);
        between = tail[-1] == ' ' ? "\u2026 " : "\u2026";
        shown = width_between(name, head) + script_width(between) + width_between(tail, end);
    }
    snprintf(cut, size, "%.*s%s%s", (int)(head - name), name, between, tail);
}

void script_cut(const char *text, double width, char *cut, size_t size) {
    assert(text && size > 0);
    const char *end = text;
    while (*end && width_between(text, skip(end, 1)) <= width) {
        end = skip(end, 1);
    }
    snprintf(cut, size, "%.*s%s", (int)(end - text), text, *end ? "\u2026" : "");
}

static int ascending(const void *left, const void *right) {
    const size_t a = *(const size_t *)left, b = *(const size_t *)right;
    return (a > b) - (a < b);
}

// Adds the rows of the smallest and the largest value in [first, end).
static size_t extremes(const double *value, size_t first, size_t end, size_t *row) {
    size_t low = first, high = first;
    for (size_t i = first; i < end; i++) {
        low = value[i] < value[low] ? i : low;
        high = value[i] > value[high] ? i : high;
    }
    row[0] = low;
    row[1] = high;
    return 2;
}

size_t script_thin(const double *const *series, int n_series, size_t n, size_t bins, size_t *row) {
    assert(n_series > 0 && n > 0 && bins > 0 && row);
    const size_t room = 2 * (size_t)n_series * bins + 2;
    if (n <= room) {
        for (size_t i = 0; i < n; i++) {
            row[i] = i;
        }
        return n;
    }
    size_t n_row = 0;
    row[n_row++] = 0;
    for (size_t b = 0; b < bins; b++) {
        for (int s = 0; s < n_series; s++) {
            n_row += extremes(series[s], n * b / bins, n * (b + 1) / bins, row + n_row);
        }
    }
    row[n_row++] = n - 1;
    qsort(row, n_row, sizeof *row, ascending);
    size_t kept = 0;
    for (size_t i = 0; i < n_row; i++) {
        if (kept == 0 || row[i] != row[kept - 1]) {
            row[kept++] = row[i];
        }
    }
    return kept;
}
