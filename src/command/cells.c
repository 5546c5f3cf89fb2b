// SPDX-License-Identifier: GPL-3.0-or-later
#include "command/cells.h"

#include <math.h>
#include <string.h>

#include "core/safe.h"
#include "core/text.h"

static void begin(struct cells *c) {
    static const char *const between[] = {
        [CELLS_TSV] = "\t", [CELLS_CSV] = ",", [CELLS_JSON] = ", "};
    if (c->within) {
        fputs(between[c->form], c->to);
    } else if (c->form == CELLS_JSON) {
        fputs(c->n_line == 0 ? "{\"columns\": [" : c->n_line == 1 ? "\n[" : ",\n[", c->to);
    }
    c->within = true;
}

void cells_text(struct cells *c, const char *text) {
    static const enum safe form[] = {
        [CELLS_TSV] = SAFE_TSV, [CELLS_CSV] = SAFE_CSV, [CELLS_JSON] = SAFE_JSON};
    begin(c);
    safe_put(c->to, form[c->form], text);
}

void cells_number(struct cells *c, double value) {
    struct text_exact t;
    begin(c);
    if (c->form == CELLS_JSON && !isfinite(value)) {
        fputs("null", c->to);
        return;
    }
    fputs(isnan(value) ? "nan" : text_exact(&t, value), c->to);  // a NaN has no sign here
}

void cells_numbers(struct cells *c, const double *value, int n) {
    for (int i = 0; i < n; i++) {
        cells_number(c, value[i]);
    }
}

void cells_empty(struct cells *c) {
    if (c->form == CELLS_JSON) {
        begin(c);
        fputs("null", c->to);
    } else {
        cells_text(c, "");
    }
}

void cells_whole(struct cells *c, long value) {
    begin(c);
    fprintf(c->to, "%ld", value);
}

void cells_sign(struct cells *c, int value) {
    if (value < 0) {
        cells_empty(c);
    } else {
        cells_whole(c, value);
    }
}

void cells_end(struct cells *c) {
    if (c->form != CELLS_JSON) {
        fputc('\n', c->to);
    } else {
        fputs(c->n_line == 0 ? "],\n\"data\": [" : "]", c->to);
    }
    c->within = false;
    c->n_line++;
}

void cells_close(struct cells *c) {
    if (c->form == CELLS_JSON) {
        fputs("\n]}\n", c->to);
    }
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
