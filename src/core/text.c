// SPDX-License-Identifier: GPL-3.0-or-later
// Characters of UTF-8, and file names.
#include "core/text.h"

#include <assert.h>
#include <ctype.h>
#include <string.h>

bool text_same(const char *a, const char *b) {
    return a && b ? strcmp(a, b) == 0 : a == b;
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

const char *text_not_plain(const char *text) {
    for (size_t left = strlen(text), n; left > 0; text += n, left -= n) {
        n = text_character(text, left);
        if (n == 0 || text_is_control(text, n)) {
            return text;
        }
    }
    return NULL;
}

int text_columns(const char *text, size_t n) {
    assert(text || n == 0);
    int columns = 0;
    for (size_t i = 0; i < n; columns++) {
        size_t size = text_character(text + i, n - i);
        i += size ? size : 1;
    }
    return columns;
}

bool text_is_name(const char *name) {
    for (const char *p = name; *p; p++) {
        const unsigned char c = (unsigned char)*p;
        if (!isalnum(c) && c != '_' && c != '-' && c < 0x80) {
            return false;
        }
    }
    return name[0] && name[0] != '-' && strlen(name) <= 64;
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
    assert(size > 0 && (text || n == 0));
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
            memmove(to + used, text + i, bytes);
        } else {
            to[used] = text[i] == '\t' ? ' ' : '?';
        }
        used += room;
        i += step;
    }
    to[used] = 0;
}

bool text_compose(char *to, size_t size, const char *format, va_list list) {
    assert(to && size > 0 && format);
    const int n = vsnprintf(to, size, format, list);
    const bool cut = n >= 0 && (size_t)n >= size;
    if (n < 0) {
        to[0] = '\0';
    } else if (cut) {
        to[text_cut(to, size - 1)] = '\0';
    }
    text_clean(to, size, to, strlen(to));
    return cut;
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

const char *text_more(struct text_more *t, int n) {
    assert(n > 0);
    t->text[0] = '\0';
    if (n > 1) {
        snprintf(t->text, sizeof t->text, " (and %d more)", n - 1);
    }
    return t->text;
}
