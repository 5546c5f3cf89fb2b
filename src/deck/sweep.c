// SPDX-License-Identifier: GPL-3.0-or-later
// sweep NAME values|range|files|random ...: a parameter that takes one value after another, run by
// run. A param of the same name may stand above or below it: its value is that of the deck without
// the sweep.
//
// range gives FROM + i (TO - FROM) / (N - 1), or with -log FROM (TO / FROM)^(i / (N - 1)), i = 0 ..
// N - 1; the last is TO itself. The values of a sweep do not depend on other sweeps, so that the
// runs of a study form a grid.
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "core/text.h"
#include "deck/reader.h"
#include "deck/sweep_files.h"
#include "deck/sweep_random.h"

const char sweep_usage[] =
    "sweep NAME values LIST | range FROM TO N [-log] | files \"GLOB\" | random DISTRIBUTION A B "
    "-n N -seed S [-lhs] [-min X] [-max X] [-as SAMPLE]";

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
        deck_error(d, w, "this is %s; before it stands %s",
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

// The values as the sweep keeps them.
static bool take(struct deck *d, struct sweep *s, const struct parameter *p, int n) {
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
            deck_error(d, &word[key[i].at], "value %s stands twice",
                       text_short(&t, word[key[i].at].text));
            return false;
        }
    }
    return true;
}

static bool read_list(struct deck *d, const struct statement *s, struct sweep *sweep) {
    const int n = s->n_word - 3;
    if (n < 1 || n > SWEEP_VALUES_MAX) {
        deck_error(d, &s->word[2], "%d values are given; 1 to %d are allowed", n, SWEEP_VALUES_MAX);
        return false;
    }
    const struct parameter *p = read_values(d, &s->word[3], n);
    return p && take(d, sweep, p, n) && check_distinct(d, sweep, &s->word[3]);
}

enum spacing { SPACING_LINEAR, SPACING_LOG };

static bool read_spacing(struct deck *d, const struct statement *s, enum spacing *spacing) {
    static const char *const known[] = {"-log"};
    *spacing = s->n_plain < s->n_word ? SPACING_LOG : SPACING_LINEAR;
    return *spacing == SPACING_LINEAR ||
           deck_keyword(d, &s->word[s->n_plain], "option", known, 1) == 0;
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

static bool read_range(struct deck *d, const struct statement *s, struct sweep *sweep) {
    static const struct range count = {
        .min = 2, .max = SWEEP_VALUES_MAX, .text = ">= 2 and <= 1e6"};
    const struct row row = {.key = "N", .kind = ROW_INTEGER, .range = &count};
    struct argument n;
    enum spacing spacing;
    if (!read_spacing(d, s, &spacing)) {
        return false;
    }
    if (s->n_plain != 6 || s->n_word > 7) {
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

static bool read_files(struct deck *d, const struct statement *s, struct sweep *sweep) {
    if (s->n_word != 4) {
        deck_error(d, &s->word[2], "one pattern of file names is expected");
        return false;
    }
    const char *pattern = deck_text(d, &s->word[3]);
    return pattern && sweep_files(d, &s->word[3], pattern, sweep);
}

static bool refuse_options(struct deck *d, const struct statement *s) {
    if (s->n_plain < s->n_word) {
        deck_error(d, &s->word[s->n_plain], "the statement is %s", sweep_usage);
    }
    return s->n_plain == s->n_word;
}

static bool read_values_of(struct deck *d, const struct statement *s, struct sweep *sweep) {
    enum { VALUES, RANGE, FILES, RANDOM, N_KIND };  // RANDOM: see sweep_run
    static const char *const kinds[N_KIND] = {
        [VALUES] = "values", [RANGE] = "range", [FILES] = "files", [RANDOM] = "random"};
    switch (deck_keyword(d, &s->word[2], "kind of sweep", kinds, N_KIND)) {
        case VALUES:
            return refuse_options(d, s) && read_list(d, s, sweep);
        case RANGE:
            return read_range(d, s, sweep);
        case FILES:
            return refuse_options(d, s) && read_files(d, s, sweep);
        default:
            return false;
    }
}

const struct sweep *sweep_bound(const struct deck *d, const char *name, int *choice) {
    int i = 0;
    for (const struct sweep *s = d->reader->bound; s; s = s->next, i++) {
        for (const struct sweep *p = s; p; p = p->along) {
            if (strcmp(p->name, name) == 0) {
                *choice = s->fixed ? 0 : d->reader->choice[i];
                return p;
            }
        }
    }
    return NULL;
}

// If each run read its sweeps anew, the time of a study would grow with the square of their
// lengths.
const struct sweep *sweep_known(const struct deck *d, const struct frame *f) {
    const struct deck *first = d->reader->first_reading;
    const struct sweep *s = first ? first->sweeps : NULL;
    const char *at = f->source->text + f->offset;
    const size_t rest = f->source->size - f->offset;
    while (s && !(s->lines.text && s->lines.size <= rest &&
                  memcmp(s->lines.text, at, s->lines.size) == 0 &&
                  (at[s->lines.size - 1] == '\n' || s->lines.size == rest))) {
        s = s->next;
    }
    return s && unit_system_equal(&first->units, &d->units) ? s : NULL;
}

void sweep_choose(const struct sweep *s, int choice, struct parameter *p) {
    p->kind = s->number ? PARAMETER_NUMBER : PARAMETER_TEXT;
    p->swept = true;
    if (s->number) {
        p->number = (struct quantity){s->number[choice], s->known, s->dimension};
    } else {
        p->text = s->text[choice];
        p->origin = s->origin;
    }
}

// The value of this run as a parameter.
static struct parameter chosen(const struct deck *d, const struct sweep *sweep) {
    int choice = 0;
    const struct sweep *from = sweep_bound(d, sweep->name, &choice);
    struct parameter p = {0};
    if (from && !from->number == !sweep->number) {
        sweep_choose(from, choice, &p);
    } else {
        sweep_choose(sweep, 0, &p);
    }
    return p;
}

bool sweep_append(struct deck *d, const struct word *w, struct sweep *s) {
    struct reader *r = d->reader;
    if (s->fixed) {
        s->n = 1;
    }
    if (r->n_sweep == STUDY_SWEEPS_MAX) {
        deck_error(d, w, "more than %d sweeps", STUDY_SWEEPS_MAX);
        return false;
    }
    if (d->n_run > STUDY_RUNS_MAX / s->n) {
        deck_error(d, w, "the sweeps make more than %d runs", STUDY_RUNS_MAX);
        return false;
    }
    d->n_run *= s->n;
    if (r->last_sweep) {
        r->last_sweep->next = s;
    } else {
        d->sweeps = s;
    }
    r->last_sweep = s;
    r->n_sweep++;
    return true;
}

// Reads the values; false after having reported what is wrong with them.
static bool read(struct deck *d, const struct statement *s, struct sweep *sweep) {
    if (s->known) {
        *sweep = *s->known;
        sweep->next = NULL;
        return true;
    }
    d->reader->swept = false;
    if (!read_values_of(d, s, sweep)) {
        return false;
    }
    if (d->reader->swept) {
        deck_error(d, &s->word[2], "the values of a sweep cannot depend on a swept parameter");
        return false;
    }
    if (!memchr(s->lines.text, '$', s->lines.size)) {
        sweep->lines = s->lines;
    }
    return true;
}

void sweep_fix(struct deck *d, const struct parameter *p, struct sweep *s) {
    s->fixed = true;
    if (p->kind != PARAMETER_WRONG) {
        take(d, s, p, 1);
    }
}

// The values of a sweep cannot be made from the param that they replace.
static void mark_param(struct deck *d, const char *name) {
    struct parameter *p = parameter_find(d, name, strlen(name));
    if (p) {
        p->swept = true;
    }
}

void sweep_run(struct deck *d, const struct statement *s) {
    if (s->n_plain < 4) {
        deck_error(d, s->word, "a word is missing; the statement is %s", sweep_usage);
    }
    if (s->n_plain < 2 || !parameter_is_free(d, &s->word[1], BY_SWEEP)) {
        return;
    }
    mark_param(d, s->word[1].text);
    struct sweep *sweep = deck_array(d, 1, sizeof *sweep);
    if (!sweep) {
        return;
    }
    sweep->name = s->word[1].text;
    if (s->n_plain >= 4 && strcmp(s->word[2].text, "random") == 0) {
        sweep_random(d, s, sweep);
        return;
    }
    struct parameter p = {.kind = PARAMETER_WRONG};
    if (s->n_plain >= 4 && read(d, s, sweep)) {
        p = chosen(d, sweep);
    }
    const bool good = p.kind != PARAMETER_WRONG;
    if (parameter_keep(d, &s->word[1], BY_SWEEP, &p) && good) {
        sweep_fix(d, &p, sweep);
    }
    if (good) {
        sweep_append(d, &s->word[1], sweep);
    }
}
