// SPDX-License-Identifier: GPL-3.0-or-later
// The statements of a deck with the values of its parameters, as bytes for a checksum.
//
// Each statement adds its words. A number adds its value and its dimension, so that it adds the
// same wherever it comes from: a literal, a param, a sweep or a -D. Any other word adds its text. A
// number without a unit, or in front of the options, may be a name, and the names 1 and 01 differ.
// So this number adds its text too. Of the statements of the language only units and gravity add
// something.
#include <string.h>
#include <sys/stat.h>

#include "core/checksum.h"
#include "core/number.h"
#include "deck/expression.h"
#include "deck/quantity.h"

static void add_double(struct checksum_sum *to, double x) {
    checksum_add_number(to, (uint64_t)number_bits(x));
}

// Reads the word from `from` on as a number. False: it is not a number, which is not an error here.
static bool read_number(struct deck *d, const struct word *w, const char *from,
                        struct quantity *out) {
    const char *at = from + (*from == '-' || *from == '+');
    const int n_error = d->diagnostics.n_error;
    const bool may_be = (*at >= '0' && *at <= '9') || *at == '.' || *at == '$';
    const bool is = may_be && expression_number(d, w, from, out);
    d->diagnostics.n_error = n_error;
    return is;
}

static void add_quantity(struct checksum_sum *to, const struct quantity *q) {
    add_double(to, q->value);
    checksum_add_number(to, q->known);
    if (q->known) {
        add_double(to, q->dimension.force);
        add_double(to, q->dimension.length);
        add_double(to, q->dimension.time);
    }
}

// May a word of the statement name a file? To look for files costs more than all the rest. If the
// key lacks a file because of this choice, the study notices it when it reads the file.
static bool may_be_file(const char *statement, const char *text) {
    static const char *const readers[] = {"ground", "load", "matrix"};
    bool reads = strpbrk(text, "./") != NULL;
    for (size_t i = 0; i < sizeof readers / sizeof readers[0]; i++) {
        reads = reads || strcmp(statement, readers[i]) == 0;
    }
    return reads;
}

// Enters the file of that name into the list of the deck's files, if there is one.
static void enter_file(struct deck *d, const struct word *w, const char *name) {
    struct stat s;
    const struct deck_path *before = d->files;
    const struct deck_path *file = deck_path_enter(d, w, name);
    if (file && !(stat(file->path, &s) == 0 && S_ISREG(s.st_mode))) {
        d->files = before;
    }
}

// Adds word `i` of a statement; false: a parameter in it has no value.
static bool add_word(struct deck *d, const struct statement *s, int i, struct checksum_sum *to) {
    const struct word *w = &s->word[i];
    const char *mark = deck_repeat_mark(w), *from = mark ? mark + 1 : w->text;
    const bool option = deck_is_option(w);
    struct quantity q;
    const bool number = !option && read_number(d, w, from, &q);
    checksum_add_number(to, option ? 2 : number);
    if (number) {
        checksum_add_number(to, (uint64_t)(from - w->text));
        checksum_add(to, w->text, (size_t)(from - w->text));
        add_quantity(to, &q);
    }
    if (number && q.known && i >= s->n_plain) {
        return true;
    }
    const char *text = deck_text_of_file(d, w);
    if (text) {
        checksum_add_text(to, text);
    }
    if (text && i > 0 && !number && !option && may_be_file(s->word[0].text, text)) {
        enter_file(d, w, text);
    }
    return text != NULL;
}

bool deck_key(struct deck *d, struct checksum_sum *to) {
    struct statement s;
    bool sound = true;
    while (deck_next(d, &s)) {
        checksum_add_number(to, (uint64_t)s.n_word);
        for (int i = 0; i < s.n_word; i++) {
            sound = add_word(d, &s, i, to) && sound;
        }
    }
    add_double(to, d->units.force);
    add_double(to, d->units.length);
    add_double(to, d->units.time);
    add_double(to, d->units.gravity);
    return sound && d->diagnostics.n_error == 0 && !d->torn;
}
