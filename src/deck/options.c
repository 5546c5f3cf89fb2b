// SPDX-License-Identifier: GPL-3.0-or-later
// Matches the options of a statement with rows.
#include <assert.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "core/arena.h"
#include "deck/reader.h"

enum { SETS_MAX = 8 };  // sets of rows of one statement

// The number of values of the option at s->word[at].
static int count_behind(const struct statement *s, int at) {
    int n = 0;
    while (at + 1 + n < s->n_word && !deck_is_option(&s->word[at + 1 + n])) {
        n++;
    }
    return n;
}

const struct word *deck_option(const struct statement *s, const char *key, int *n_word) {
    assert(key && n_word);
    *n_word = 0;
    for (int i = s->n_plain; i < s->n_word; i++) {
        if (deck_is_option(&s->word[i]) && strcmp(s->word[i].text + 1, key) == 0) {
            *n_word = count_behind(s, i);
            return &s->word[i + 1];
        }
    }
    return NULL;
}

// The row of option `key`; *at is the number of its set. NULL: no set has such a row.
static const struct row *find_row(const struct row_set *set, int n_set, const char *key, int *at) {
    for (*at = 0; *at < n_set; (*at)++) {
        for (int j = 0; j < set[*at].n_row; j++) {
            if (strcmp(set[*at].row[j].key, key) == 0) {
                return &set[*at].row[j];
            }
        }
    }
    return NULL;
}

// Reports the unknown option at s->word[at]. If its name resembles the name of a row, this row
// counts as given, so that it is not reported as missing too.
static void report_unknown(struct deck *d, const struct statement *s, int at,
                           const struct row_set *set, int n_set) {
    const char *known[64];
    int n = 0;
    for (int i = 0; i < n_set; i++) {
        for (int j = 0; j < set[i].n_row && n < 64; j++) {
            const char *name = arena_format(d->arena, "-%s", set[i].row[j].key);
            if (!name) {
                diagnostics_no_memory(&d->diagnostics);
                return;
            }
            known[n++] = name;
        }
    }
    const struct word *key = &s->word[at];
    const char *near = deck_unknown(d, key, key->text, "option", known, n);
    if (near && !deck_option(s, near + 1, &n)) {
        const struct row *row = find_row(set, n_set, near + 1, &at);
        set[at].argument[row - set[at].row] = (struct argument){.given = true, .key = *key};
    }
}

// Sets the argument of every row to its fallback.
static bool clear(struct deck *d, const struct row_set *set, double power) {
    for (int j = 0; j < set->n_row; j++) {
        const struct row *row = &set->row[j];
        set->argument[j] = (struct argument){.given = false};
        if (row->kind == ROW_FLAG || row->kind == ROW_TEXT || row->kind == ROW_TEXTS ||
            row->kind == ROW_FILE || isnan(row->fallback)) {
            continue;
        }
        struct dimension dimension = row_dimension(row, power);
        double *number = deck_array(d, 1, sizeof *number);
        if (!number) {
            return false;
        }
        *number = unit_convert(row->fallback, 1, unit_size(&d->units, dimension));
        set->argument[j].number = number;
        set->argument[j].n = 1;
    }
    return true;
}

// The exponent in the dimensions of the set: the value, or the fallback, of the row with ROW_POWER.
// NAN: the value is missing or wrong. The error is reported here or later.
static double read_power(struct deck *d, const struct statement *s, const struct row_set *set) {
    for (int j = 0; j < set->n_row; j++) {
        const struct row *row = &set->row[j];
        if (!(row->flags & ROW_POWER)) {
            continue;
        }
        int n_word;
        const struct word *word = deck_option(s, row->key, &n_word);
        struct argument value;
        if (!word || n_word == 0) {
            assert(!isnan(row->fallback) || (row->flags & ROW_REQUIRED));
            return row->fallback;
        }
        return deck_values(d, row, 0, word, n_word, &value) ? value.number[0] : NAN;
    }
    return 0;
}

// Reads the option at s->word[at] with its values.
static bool read_option(struct deck *d, const struct statement *s, int at,
                        const struct row_set *set, int n_set, const double *set_power) {
    const struct word *key = &s->word[at];
    int i;
    const struct row *row = find_row(set, n_set, key->text + 1, &i);
    if (!row) {
        report_unknown(d, s, at, set, n_set);
        return false;
    }
    struct argument *argument = &set[i].argument[row - set[i].row];
    double power = set_power[i];
    if (argument->given) {
        return deck_error(d, key, "%s is given twice", key->text);
    }
    int n = count_behind(s, at);
    if (n == 0 && row->kind != ROW_FLAG) {
        argument->given = true;
        argument->key = *key;
        return deck_error(d, key, "%s needs a value: %s", key->text,
                          row->doc ? row->doc : row->key);
    }
    const unsigned depends = ROW_POWER | ROW_PER_LENGTH_POWER | ROW_PER_VELOCITY_POWER;
    if (isnan(power) && (row->flags & depends)) {
        argument->given = true;  // read_power reports a wrong exponent
        argument->key = *key;
        return false;
    }
    bool ok = deck_values(d, row, power, key + 1, n, argument);
    argument->key = *key;
    return ok;
}

static bool check_required(struct deck *d, const struct statement *s, const struct row_set *set) {
    bool ok = true;
    for (int j = 0; j < set->n_row; j++) {
        const struct row *row = &set->row[j];
        if ((row->flags & ROW_REQUIRED) && !set->argument[j].given) {
            deck_error(d, &s->word[0], "%s needs -%s: %s", s->word[0].text, row->key,
                       row->doc ? row->doc : row->key);
            ok = false;
        }
    }
    return ok;
}

// Exactly one of the rows with ROW_ONE_OF in a set must be given; false after having reported an
// error.
static bool check_one_of(struct deck *d, const struct statement *s, const struct row_set *set) {
    char names[256] = "";
    const struct word *first = NULL;
    bool any = false, ok = true;
    for (int j = 0; j < set->n_row; j++) {
        if (!(set->row[j].flags & ROW_ONE_OF)) {
            continue;
        }
        size_t used = strlen(names);
        snprintf(names + used, sizeof names - used, "%s-%s", any ? " or " : "", set->row[j].key);
        any = true;
        const struct argument *argument = &set->argument[j];
        if (argument->given && first) {
            deck_error(d, &argument->key, "%s and %s cannot be combined", argument->key.text,
                       first->text);
            ok = false;
        }
        first = argument->given && !first ? &argument->key : first;
    }
    if (any && !first) {
        return deck_error(d, &s->word[0], "%s needs %s", s->word[0].text, names);
    }
    return ok;
}

bool deck_options(struct deck *d, const struct statement *s, struct row_set *set, int n_set) {
    assert(n_set >= 0 && n_set <= SETS_MAX && (set || n_set == 0));
    double power[SETS_MAX];
    bool ok = true;
    for (int i = 0; i < n_set; i++) {
        power[i] = read_power(d, s, &set[i]);
        ok = ok && !isnan(power[i]);
        if (!clear(d, &set[i], power[i])) {
            return false;
        }
    }
    for (int i = s->n_plain; i < s->n_word; i += 1 + count_behind(s, i)) {
        ok = read_option(d, s, i, set, n_set, power) && ok;
    }
    for (int i = 0; i < n_set; i++) {
        bool all = check_required(d, s, &set[i]);
        ok = check_one_of(d, s, &set[i]) && all && ok;
    }
    return ok;
}
