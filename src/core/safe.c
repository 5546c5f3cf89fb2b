// SPDX-License-Identifier: GPL-3.0-or-later
// Quotes and escapes after RFC 4180 (CSV), RFC 8259 (JSON), POSIX.1-2017, Shell Command Language,
// 2.2 (words of sh), and the manual of gnuplot 5.4: nothing but a quote is special within single
// quotes, and a percent sign in the label of a tic. Two quotes stand for one there, but not at the
// start and not twice in a row (scanner.c of gnuplot 5.4), so a text with a quote goes into double
// quotes, where what is special is written as an octal number. A backslash at the end of a line
// goes on with the next one, also in a comment.
#include "core/safe.h"

#include <assert.h>
#include <stdarg.h>
#include <stdbool.h>
#include <string.h>

#include "core/text.h"

// The mark before and behind a text.
static const char *mark_of(enum safe where, const char *text) {
    static const char plain[] = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789"
                                "_./:=,+@%^-";
    switch (where) {
        case SAFE_CSV:
            return strpbrk(text, ",\"\r\n") ? "\"" : "";
        case SAFE_JSON:
            return "\"";
        case SAFE_GNUPLOT:
        case SAFE_TIC:
            return strchr(text, '\'') ? "\"" : "'";
        case SAFE_SHELL:
            return text[0] && text[strspn(text, plain)] == '\0' ? "" : "'";
        default:
            return "";
    }
}

// What stands for a character that ends a text or is special within; NULL: nothing.
static const char *escape(enum safe where, char c) {
    switch (where) {
        case SAFE_CSV:
            return c == '"' ? "\"\"" : c == '\n' || c == '\t' ? (c == '\n' ? "\n" : "\t") : NULL;
        case SAFE_JSON:
            return c == '"' ? "\\\"" : c == '\\' ? "\\\\" : c == '\n' ? "\\n" : NULL;
        case SAFE_TIC:
            return c == '%' ? "%%" : NULL;
        case SAFE_SHELL:
            return c == '\'' ? "'\\''" : NULL;
        case SAFE_TERMINAL:
            return c == '\t' ? " " : NULL;
        default:
            return NULL;
    }
}

static void put_control(FILE *to, enum safe where, unsigned code) {
    if (where == SAFE_JSON) {
        fprintf(to, "\\u%04x", code);
    } else {
        fputc(where == SAFE_TERMINAL || where == SAFE_SHELL ? '?' : ' ', to);
    }
}

void safe_put(FILE *to, enum safe where, const char *text) {
    assert(to && text);
    const char *mark = mark_of(where, text);
    size_t left = strlen(text);
    const bool joins = where == SAFE_COMMENT && left > 0 && text[left - 1] == '\\';
    const bool octal = (where == SAFE_GNUPLOT || where == SAFE_TIC) && mark[0] == '"';
    fputs(mark, to);
    for (size_t n; left > 0; text += n, left -= n) {
        const size_t size = text_character(text, left);
        const char *other = size == 0 && where == SAFE_JSON ? "\\ufffd"
                            : size == 0                     ? "?"
                                                            : escape(where, *text);
        n = size > 0 ? size : 1;
        if (other) {
            fputs(other, to);
        } else if (octal && strchr("\"'\\`@", *text)) {
            fprintf(to, "\\%03o", (unsigned)*text);
        } else if (text_is_control(text, n)) {
            put_control(to, where, (unsigned char)text[n - 1]);
        } else {
            fwrite(text, 1, n, to);
        }
    }
    fputs(joins ? " " : mark, to);
}

void safe_line(FILE *to, const char *format, ...) {
    char line[4001];
    va_list list;
    va_start(list, format);
    const bool cut = text_compose(line, sizeof line, format, list);
    va_end(list);
    fprintf(to, "%s%s\n", line, cut ? "..." : "");
}

void safe_cell(FILE *to, const char *name, int width) {
    assert(name);
    const int n = text_columns(name, strlen(name));
    const char *tail = name;
    for (int skip = n > width ? n - width + 2 : 0; skip > 0; skip--) {
        tail++;
        while (((unsigned char)*tail & 0xC0) == 0x80) {
            tail++;
        }
    }
    fputs(n > width ? ".." : "", to);
    safe_put(to, SAFE_TERMINAL, tail);
    fprintf(to, "%*s", n < width ? width - n : 0, "");
}
