// SPDX-License-Identifier: GPL-3.0-or-later
// Words -> the values of a row: numbers with repeats, texts.
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "core/text.h"
#include "deck/expression.h"
#include "deck/parameter.h"
#include "deck/quantity.h"

const char *deck_repeat_mark(const struct word *w) {
    const char *end;
    double count;
    bool number = w->text[0] >= '0' && w->text[0] <= '9' &&
                  text_number(w->text, &end, &count) != TEXT_NUMBER_NONE;
    bool unit = number && *end == '*' &&
                ((end[1] >= 'a' && end[1] <= 'z') || (end[1] >= 'A' && end[1] <= 'Z'));
    return number && *end == '*' && !unit ? end : NULL;
}

// The count of a repeat; 1 for other words; 0: the count is wrong.
static int repeat_count(const struct word *w) {
    const char *mark = deck_repeat_mark(w);
    if (!mark) {
        return 1;
    }
    const char *end;
    double count;
    bool whole = w->text + strspn(w->text, "0123456789") == mark &&
                 text_number(w->text, &end, &count) == TEXT_NUMBER_OK;
    return whole && count >= 1 && count <= LIST_MAX ? (int)count : 0;
}

// False after having reported a repeat with a wrong count, or a repeat that the row does not allow.
static bool check_repeat(struct deck *d, const struct row *row, const struct word *w) {
    const char *mark = deck_repeat_mark(w);
    if (!mark || (row->kind == ROW_LIST && repeat_count(w) > 0)) {
        return true;
    }
    struct word part = deck_report_part(d, w, w->text, mark);
    struct text_short t;
    if (row->kind != ROW_LIST) {
        deck_error(d, w, "%s takes one value, not a repeat; write a product in ${...}", row->key);
    } else {
        deck_error(d, &part, "the count of a repeat is %s; it must be a whole number from 1 to %d",
                   text_short(&t, part.text), LIST_MAX);
    }
    return false;
}

// The number of values in all words; -1 after having reported an error.
static int count_values(struct deck *d, const struct row *row, const struct word *word,
                        int n_word) {
    int n = 0;
    bool ok = true;
    for (int i = 0; i < n_word; i++) {
        ok = check_repeat(d, row, &word[i]) && ok;
        int count = repeat_count(&word[i]);
        if (count > LIST_MAX - n) {
            deck_error(d, &word[i], "%s has more than %d values", row->key, LIST_MAX);
            return -1;
        }
        n += count;
    }
    d->reader->n_repeated += (size_t)(n > n_word ? n - n_word : 0);
    if (d->reader->n_repeated > REPEATED_MAX) {
        deck_error(d, &word[0], "the repeats of all lists make more than %d values", REPEATED_MAX);
        return -1;
    }
    return ok ? n : -1;
}

enum { WEIGHT_SIZE = 64 };

// The expression that turns the weight in the word into a mass, for a message.
static const char *mass_of(const struct word *w, char text[WEIGHT_SIZE]) {
    const char *mark = deck_repeat_mark(w);
    const char *from = mark ? mark + 1 : w->text;
    const bool expression = strncmp(from, "${", 2) == 0;
    from += expression ? 2 : *from == '$';
    const size_t n = expression ? strcspn(from, "}") : strlen(from);
    if (n > WEIGHT_SIZE / 2) {
        return "W ${W/1g}";
    }
    snprintf(text, WEIGHT_SIZE, expression ? "${(%.*s)/1g}" : "${%.*s/1g}", (int)n, from);
    return text;
}

static bool check_dimension(struct deck *d, const struct row *row, struct dimension wanted,
                            const struct word *w, const struct quantity *q) {
    if (!q->known || dimension_equal(q->dimension, wanted)) {
        return true;
    }
    struct quantity_text got, need;
    quantity_describe(&d->units, q->dimension, &got);
    const char *noun = dimension_noun(wanted);
    char mass[WEIGHT_SIZE];
    bool weight =
        dimension_equal(wanted, dimension_mass) && dimension_equal(q->dimension, dimension_force);
    return deck_error(d, w, "%s has the dimension of %s; %s is needed%s%s", row->key, got.text,
                      noun ? noun : quantity_describe(&d->units, wanted, &need),
                      weight ? "; the mass of a weight is " : "", weight ? mass_of(w, mass) : "");
}

// False after having reported a word that does not start like a number, such as a parameter's name.
static bool check_number_like(struct deck *d, const struct row *row, const struct word *w,
                              const char *from) {
    const char *at = from + (*from == '-' || *from == '+');
    if ((*at >= '0' && *at <= '9') || *at == '.' || *at == '$') {
        return true;
    }
    struct word part = deck_report_part(d, w, from, w->text + strlen(w->text));
    struct text_short t;
    text_short(&t, part.text);
    bool parameter = parameter_find(d, from, strlen(from)) != NULL;
    if (!parameter && quantity_is_unit(d, from, strlen(from))) {
        deck_error(d, &part, "%s needs a number, not '%s'; write a unit directly after its number",
                   row->key, t.text);
    } else if (parameter) {
        deck_error(d, &part, "%s needs a number, not '%s'; did you mean '$%s'?", row->key, t.text,
                   t.text);
    } else {
        deck_error(d, &part, "%s needs a number, not '%s'", row->key, t.text);
    }
    return false;
}

static bool read_number(struct deck *d, const struct row *row, struct dimension dimension,
                        const struct word *w, double *value, bool *bare) {
    const char *mark = deck_repeat_mark(w);
    const char *from = mark ? mark + 1 : w->text;
    struct quantity q;
    if (!check_number_like(d, row, w, from) || !expression_number(d, w, from, &q)) {
        return false;
    }
    *value = q.value;
    *bare = !q.known;
    if (!check_dimension(d, row, dimension, w, &q)) {
        return false;
    }
    const double largest = 2147483647;  // whole numbers must fit an int
    if (row->kind == ROW_INTEGER && (q.value != floor(q.value) || fabs(q.value) > largest)) {
        return deck_error(d, w, "%s is %.10g; it must be a whole number up to %.0f", row->key,
                          q.value, largest);
    }
    double size = unit_size(&d->units, dimension);
    if (range_holds(row->range, unit_convert(q.value, size, 1))) {
        return true;
    }
    char unit[64];
    unit_text(&d->units, dimension, unit, sizeof unit);
    bool pure = dimension_equal(dimension, dimension_none);
    return deck_error(d, w, "%s is %.10g%s%s; it must be %s", row->key, q.value, pure ? "" : " ",
                      pure ? "" : unit, row->range->text);
}

static bool read_numbers(struct deck *d, const struct row *row, double power,
                         const struct word *word, int n_word, struct argument *out) {
    int n = count_values(d, row, word, n_word);
    bool ok = n >= 0;
    size_t room = ok ? (size_t)n : 0;
    double *number = deck_array(d, room, sizeof *number);
    struct word *from = deck_array(d, room, sizeof *from);
    if (!number || !from) {
        return false;
    }
    int used = 0;
    const bool before = reader_note_sweeps(d);
    for (int i = 0; i < n_word; i++) {  // all words, so that all errors are reported
        double value = NAN;
        ok = read_number(d, row, row_dimension(row, power), &word[i], &value, &out->bare) && ok;
        for (int count = room > 0 ? repeat_count(&word[i]) : 0; count > 0; count--) {
            number[used] = value;
            from[used++] = word[i];
        }
    }
    if (row->kind == ROW_INTEGER) {
        reader_noted_sweeps(d, before);
    } else {
        d->reader->swept = d->reader->swept || before;
    }
    out->n = used;
    out->number = number;
    out->word = from;
    return ok;
}

static bool read_texts(struct deck *d, const struct row *row, const struct word *word, int n_word,
                       struct argument *out) {
    const char **text = deck_array(d, (size_t)n_word, sizeof *text);
    if (!text) {
        return false;
    }
    struct deck_quote quote;
    bool ok = true;
    for (int i = 0; i < n_word; i++) {
        text[i] = row->kind == ROW_FILE ? deck_text_of_file(d, &word[i]) : deck_text(d, &word[i]);
        bool good = text[i] && text[i][0];
        if (text[i] && !good) {
            deck_error(d, &word[i], "%s is an empty text", row->key);
        } else if (good && row->kind == ROW_TEXTS && strchr(text[i], ',')) {
            deck_error(d, &word[i], "%s has a comma; separate the values of a list by spaces",
                       deck_quote(&quote, &word[i], text[i]));
            good = false;
        }
        ok = ok && good;
    }
    out->n = n_word;
    out->text = text;
    out->word = word;
    return ok;
}

// The word of a choice as a number.
static bool read_choice(struct deck *d, const struct row *row, const struct word *w,
                        struct argument *out) {
    const char *text = deck_text(d, w);
    double *number = deck_array(d, 1, sizeof *number);
    if (!text || !number) {
        return false;
    }
    const char *const *known = row->range->word;
    int n = 0;
    while (known[n] && strcmp(known[n], text) != 0) {
        n++;
    }
    if (!known[n]) {
        deck_unknown(d, w, text, row->key, (const char **)known, n);
        return false;
    }
    *number = n;
    out->n = 1;
    out->number = number;
    out->word = w;
    return true;
}

bool deck_values(struct deck *d, const struct row *row, double power, const struct word *word,
                 int n_word, struct argument *out) {
    struct text_short t;
    *out = (struct argument){.given = true};
    if (n_word > 0) {
        out->key = word[0];
    }
    bool many = row->kind == ROW_LIST || row->kind == ROW_TEXTS;
    int most = row->kind == ROW_FLAG ? 0 : 1;
    if (!many && n_word > most) {
        return deck_error(d, &word[most], "'%s' is not expected: %s takes %s",
                          text_short(&t, word[most].text), row->key,
                          most ? "one value" : "no value");
    }
    if (row->kind == ROW_FLAG) {
        return true;
    }
    if (n_word < 1) {
        return deck_error(d, NULL, "%s needs a value", row->key);
    }
    if (row->kind == ROW_CHOICE) {
        return read_choice(d, row, word, out);
    }
    if (row->kind == ROW_TEXT || row->kind == ROW_TEXTS || row->kind == ROW_FILE) {
        return read_texts(d, row, word, n_word, out);
    }
    return read_numbers(d, row, power, word, n_word, out);
}
