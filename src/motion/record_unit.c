// SPDX-License-Identifier: GPL-3.0-or-later
// Units as record files and users write them: in capitals, with `sec` for s and `**` for ^. Volume
// 1 also has G/10.
#include "motion/record_format.h"

#include <string.h>

enum { UNIT_LONGEST = 23 };

static bool parse_whole(const char *text, double gravity, struct dimension *dimension, double *si) {
    const char *end;
    return unit_parse(text, gravity, &end, dimension, si) && *end == '\0';
}

bool record_unit(struct piece text, double gravity, struct dimension *dimension, double *si) {
    if (text.n == 0 || text.n > UNIT_LONGEST || memchr(text.text, '\0', text.n)) {
        return false;
    }
    char copy[UNIT_LONGEST + 1];
    memcpy(copy, text.text, text.n);
    copy[text.n] = '\0';
    if (parse_whole(copy, gravity, dimension, si)) {
        return true;
    }
    // `copy` is `text` with small letters, s for sec, ^ for **, and without spaces.
    size_t n = 0;
    for (size_t i = 0; i < text.n; i++) {
        char c = text.text[i];
        if (c == ' ' || c == '\t') {
            continue;
        }
        if (c == '*' && i + 1 < text.n && text.text[i + 1] == '*') {
            c = '^';
            i++;
        }
        copy[n++] = c >= 'A' && c <= 'Z' ? (char)(c - 'A' + 'a') : c;
        if (n >= 3 && memcmp(copy + n - 3, "sec", 3) == 0) {
            n -= 2;
        }
    }
    copy[n] = '\0';
    if (strcmp(copy, "g/10") == 0) {
        *dimension = dimension_acceleration;
        *si = gravity / 10;
        return true;
    }
    return parse_whole(copy, gravity, dimension, si);
}
