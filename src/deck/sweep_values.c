// SPDX-License-Identifier: GPL-3.0-or-later
// The values of a list or a range.
//
// range gives FROM + i (TO - FROM) / (N - 1), or with -log FROM (TO / FROM)^(i / (N - 1)), i = 0 ..
// N - 1; the last is TO itself.
#include "deck/sweep_values.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "core/text.h"

bool sweep_value(struct deck *d, const struct word *w, struct parameter *first,
                 struct parameter *p) {
    struct quantity_text got, needed;
    parameter_read(d, w, p);
    if (p->kind == PARAMETER_WRONG || (first && first->kind == PARAMETER_WRONG)) {
        return false;
    }
    if (!first) {
        return true;
    }
    if (p->kind != first->kind) {
        deck_error(d, w, "this is a %s, the first value a %s",
                   p->kind == PARAMETER_TEXT ? "text" : "number",
                   p->kind == PARAMETER_TEXT ? "number" : "text");
        return false;
    }
    if (p->kind == PARAMETER_TEXT || !p->number.known) {
        return true;
    }
    if (!first->number.known) {
        first->number.known = true;
        first->number.dimension = p->number.dimension;
    }
    if (!dimension_equal(p->number.dimension, first->number.dimension)) {
        deck_error(d, w, "this is %s; the value before is %s",
                   quantity_describe(&d->units, p->number.dimension, &got),
                   quantity_describe(&d->units, first->number.dimension, &needed));
        return false;
    }
    return true;
}

// Reads `n` words that must be alike into an array; NULL after having reported.
static struct parameter *read_values(struct deck *d, const struct word *word, int n) {
    struct parameter *p = deck_array(d, (size_t)n, sizeof *p);
    bool good = p != NULL;
    for (int i = 0; p && i < n; i++) {
        good = sweep_value(d, &word[i], i > 0 ? &p[0] : NULL, &p[i]) && good;
    }
    return good ? p : NULL;
}

bool sweep_take(struct deck *d, struct sweep *s, const struct parameter *p, int n) {
    s->n = n;
    if (p[0].kind == PARAMETER_TEXT) {
        const char **text = deck_array(d, (size_t)n, sizeof *text);
        for (int i = 0; text && i < n; i++) {
            text[i] = p[i].text;
        }
        s->text = text;
        s->origin = p[0].origin;
        s->label = text;
        return text != NULL;
    }
    double *number = deck_array(d, (size_t)n, sizeof *number);
    for (int i = 0; number && i < n; i++) {
        number[i] = p[i].number.value;
    }
    s->number = number;
    s->known = p[0].number.known;
    s->dimension = p[0].number.dimension;
    return number != NULL;
}

struct key {
    double number;
    const char *label;  // NULL: a number
    int at;
};

static int compare(const void *a, const void *b) {
    const struct key *x = a, *y = b;
    int order =
        x->label ? strcmp(x->label, y->label) : (x->number > y->number) - (x->number < y->number);
    return order ? order : x->at - y->at;
}

// False after having reported a value that is given twice: results are found by their values.
static bool check_distinct(struct deck *d, const struct sweep *s, const struct word *word) {
    struct key *key = deck_array(d, (size_t)s->n, sizeof *key);
    for (int i = 0; key && i < s->n; i++) {
        key[i] = (struct key){s->number ? s->number[i] : 0.0, s->label ? s->label[i] : NULL, i};
    }
    if (!key) {
        return false;
    }
    qsort(key, (size_t)s->n, sizeof *key, compare);
    for (int i = 1; i < s->n; i++) {
        struct key before = key[i - 1];
        before.at = key[i].at;
        if (compare(&before, &key[i]) == 0) {
            struct text_short t;
            deck_error(d, &word[key[i].at], "value %s is given twice",
                       text_short(&t, word[key[i].at].text));
            return false;
        }
    }
    return true;
}

bool sweep_list(struct deck *d, const struct statement *s, enum repeats repeats,
                struct sweep *sweep) {
    const int n = s->n_plain - 3;
    if (n < 1 || n > SWEEP_VALUES_MAX) {
        deck_error(d, &s->word[2], "%d values are given; 1 to %d are allowed", n, SWEEP_VALUES_MAX);
        return false;
    }
    const struct parameter *p = read_values(d, &s->word[3], n);
    return p && sweep_take(d, sweep, p, n) &&
           (repeats == VALUES_MAY_REPEAT || check_distinct(d, sweep, &s->word[3]));
}

// FROM and TO; NULL after having reported what is wrong with them.
static const struct parameter *read_ends(struct deck *d, const struct word *word,
                                         enum spacing spacing) {
    const struct parameter *p = read_values(d, word, 2);
    if (!p) {
        return NULL;
    }
    if (p[0].kind == PARAMETER_TEXT) {
        deck_error(d, &word[0], "a range goes from number to number; this is a text");
        return NULL;
    }
    const double from = p[0].number.value, to = p[1].number.value;
    if (from == to) {
        deck_error(d, &word[1], "the range ends where it starts");
        return NULL;
    }
    if (spacing == SPACING_LOG && (from <= 0.0 || to <= 0.0)) {
        deck_error(d, &word[from <= 0.0 ? 0 : 1], "with -log both ends must be > 0");
        return NULL;
    }
    return p;
}

bool sweep_range(struct deck *d, const struct statement *s, enum spacing spacing,
                 struct sweep *sweep) {
    static const struct range count = {
        .min = 2, .max = SWEEP_VALUES_MAX, .text = ">= 2 and <= 1e6"};
    const struct row row = {.key = "N", .kind = ROW_INTEGER, .range = &count};
    struct argument n;
    if (s->n_plain != 6) {
        deck_error(d, &s->word[2], "a range is FROM TO N [-log]");
        return false;
    }
    const struct parameter *p = read_ends(d, &s->word[3], spacing);
    if (!deck_values(d, &row, 0, &s->word[5], 1, &n) || !p) {
        return false;
    }
    sweep->n = (int)n.number[0];
    double *number = deck_array(d, (size_t)sweep->n, sizeof *number);
    const double from = p[0].number.value, to = p[1].number.value;
    for (int i = 0; number && i < sweep->n; i++) {
        const double share = (double)i / (sweep->n - 1);
        number[i] = i == sweep->n - 1        ? to
                    : spacing == SPACING_LOG ? from * pow(to / from, share)
                                             : from + (to - from) * share;
    }
    sweep->number = number;
    sweep->known = p[0].number.known;
    sweep->dimension = p[0].number.dimension;
    return number != NULL;
}
