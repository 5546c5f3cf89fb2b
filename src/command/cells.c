// SPDX-License-Identifier: GPL-3.0-or-later
#include "command/cells.h"

#include <math.h>
#include <string.h>

#include "core/text.h"

static void begin(struct cells *c) {
    if (c->within) {
        fputc(c->form == CELLS_TSV ? '\t' : ',', c->to);
    }
    c->within = true;
}

static void quote(const char *text, FILE *to) {
    fputc('"', to);
    for (; *text; text++) {
        if (*text == '"') {
            fputc('"', to);
        }
        fputc(*text, to);
    }
    fputc('"', to);
}

void cells_put_text(const char *text, FILE *to) {
    for (; *text; text++) {
        fputc((unsigned char)*text < ' ' ? ' ' : *text, to);
    }
}

void cells_text(struct cells *c, const char *text) {
    begin(c);
    if (c->form == CELLS_CSV && strpbrk(text, ",\"\r\n")) {
        quote(text, c->to);
        return;
    }
    if (c->form == CELLS_TSV) {
        cells_put_text(text, c->to);
    } else {
        fputs(text, c->to);
    }
}

void cells_number(struct cells *c, double value) {
    struct text_exact t;
    begin(c);
    fputs(isnan(value) ? "nan" : text_exact(&t, value), c->to);  // a NaN has no sign here
}

void cells_empty(struct cells *c) {
    cells_text(c, "");
}

void cells_whole(struct cells *c, long value) {
    begin(c);
    fprintf(c->to, "%ld", value);
}

void cells_end(struct cells *c) {
    fputc('\n', c->to);
    c->within = false;
}

void cells_words(struct cells *c, const char *words) {
    while (*words) {
        char word[64];
        const size_t n = strcspn(words, " ");
        snprintf(word, sizeof word, "%.*s", (int)n, words);
        cells_text(c, word);
        words += n + strspn(words + n, " ");
    }
}
