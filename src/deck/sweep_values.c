// SPDX-License-Identifier: GPL-3.0-or-later
// The values of a sweep that the deck lists, as a list, a range or a pattern of file names.
//
// range gives FROM + i (TO - FROM) / (N - 1), or with -log FROM (TO / FROM)^(i / (N - 1)), i = 0 ..
// N - 1; the last is TO itself.
#include <assert.h>
#include <glob.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "core/arena.h"
#include "core/text.h"
#include "deck/definition.h"
#include "deck/expression.h"
#include "deck/parameter.h"
#include "deck/quantity.h"
#include "deck/sweep.h"

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
        return deck_error(d, w, "this is a %s, the first value a %s",
                          p->kind == PARAMETER_TEXT ? "text" : "number",
                          p->kind == PARAMETER_TEXT ? "number" : "text");
    }
    if (p->kind == PARAMETER_TEXT || !p->number.known) {
        return true;
    }
    if (!first->number.known) {
        first->number.known = true;
        first->number.dimension = p->number.dimension;
    }
    if (!dimension_equal(p->number.dimension, first->number.dimension)) {
        return deck_error(d, w, "this is %s; the value before is %s",
                          quantity_describe(&d->units, p->number.dimension, &got),
                          quantity_describe(&d->units, first->number.dimension, &needed));
    }
    return true;
}

// Reads `n` words of equal kind and dimension into an array; NULL after having reported an error.
static struct parameter *read_values(struct deck *d, const struct word *word, int n) {
    struct parameter *p = deck_array(d, (size_t)n, sizeof *p);
    bool good = p != NULL;
    for (int i = 0; p && i < n; i++) {
        good = sweep_value(d, &word[i], i > 0 ? &p[0] : NULL, &p[i]) && good;
    }
    return good ? p : NULL;
}

bool sweep_take(struct deck *d, struct sweep *s, const struct parameter *p, int n) {
    assert(n >= 0 && (p || n == 0));
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

static int compare_values(const void *a, const void *b) {
    const struct key *x = a, *y = b;
    int order =
        x->label ? strcmp(x->label, y->label) : (x->number > y->number) - (x->number < y->number);
    return order ? order : x->at - y->at;
}

// The number of a value or, without values, of a label that occurs before; -1: all differ, or there
// is no memory.
static int find_repeated(struct deck *d, const double *number, const char *const *label, int n) {
    struct key *key = deck_array(d, (size_t)n, sizeof *key);
    for (int i = 0; key && i < n; i++) {
        key[i] = (struct key){number ? number[i] : 0.0, number ? NULL : label[i], i};
    }
    if (key) {
        qsort(key, (size_t)n, sizeof *key, compare_values);
    }
    for (int i = 1; key && i < n; i++) {
        struct key before = key[i - 1];
        before.at = key[i].at;
        if (compare_values(&before, &key[i]) == 0) {
            return key[i].at;
        }
    }
    return -1;
}

// False after having reported a value that is given twice. Values must differ because they identify
// the results.
static bool check_distinct(struct deck *d, const struct sweep *s, const struct word *word) {
    struct text_short t;
    const int again = find_repeated(d, s->number, s->label, s->n);
    if (again >= 0) {
        deck_error(d, &word[again], "value %s is given twice", text_short(&t, word[again].text));
    }
    return again < 0 && !d->diagnostics.out_of_memory;
}

bool sweep_list(struct deck *d, const struct statement *s, enum repeats repeats,
                struct sweep *sweep) {
    const int n = s->n_plain - 3;
    if (n < 1 || n > SWEEP_VALUES_MAX) {
        return deck_error(d, &s->word[2], "%d values are given; 1 to %d are allowed", n,
                          SWEEP_VALUES_MAX);
    }
    const struct parameter *p = read_values(d, &s->word[3], n);
    return p && sweep_take(d, sweep, p, n) &&
           (repeats == VALUES_MAY_REPEAT || check_distinct(d, sweep, &s->word[3]));
}

// Reads FROM and TO; NULL after having reported an error.
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
        return deck_error(d, &s->word[2], "a range is FROM TO N [-log]");
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

void sweep_fix(struct deck *d, const struct parameter *p, struct sweep *s) {
    s->fixed = true;
    if (p->kind != PARAMETER_WRONG) {
        sweep_take(d, s, p, 1);
    }
}

static int compare_paths(const void *a, const void *b) {
    return strcmp(*(char *const *)a, *(char *const *)b);
}

static void set_labels(struct deck *d, struct sweep *s) {
    const char **label = deck_array(d, (size_t)s->n, sizeof *label);
    if (!label) {
        return;
    }
    // Form 0: the name of the file without extension, 1: the name, 2: the whole path.
    for (int form = 0; form < 3; form++) {
        for (int i = 0; i < s->n; i++) {
            size_t n;
            const char *stem = text_stem(s->text[i], &n);
            const char *from = form < 2 ? stem : s->text[i];
            label[i] = arena_text(d->arena, from, form == 0 ? n : strlen(from));
            if (!label[i]) {
                diagnostics_no_memory(&d->diagnostics);
                return;
            }
        }
        if (find_repeated(d, NULL, label, s->n) < 0) {
            break;
        }
    }
    s->label = label;
}

// Stores the paths found, without their first `skip` bytes, which are the folder of the deck.
static bool take_paths(struct deck *d, const struct word *w, const glob_t *found, size_t skip,
                       struct sweep *out) {
    if (found->gl_pathc > SWEEP_VALUES_MAX) {
        return deck_error(d, w, "the pattern matches %zu files; at most %d are allowed",
                          found->gl_pathc, SWEEP_VALUES_MAX);
    }
    const char **path = arena_alloc(d->arena, found->gl_pathc, sizeof *path);
    out->n = (int)found->gl_pathc;
    for (int i = 0; path && i < out->n; i++) {
        const char *name = found->gl_pathv[i] + skip;
        const char *wrong = text_not_plain(name);
        if (wrong) {
            struct text_short t;
            return deck_error(d, w,
                              text_character(wrong, strlen(wrong))
                                  ? "the file name '%s' has a control character; rename the file"
                                  : "the file name '%s' is not UTF-8",
                              text_short(&t, name));
        }
        path[i] = arena_text(d->arena, name, strlen(name));
        path = path[i] ? path : NULL;
    }
    if (!path) {
        diagnostics_no_memory(&d->diagnostics);
        return false;
    }
    qsort(path, (size_t)out->n, sizeof *path, compare_paths);
    out->text = path;
    out->origin = w->place.source;
    set_labels(d, out);
    return out->label != NULL;
}

// `path` as a pattern in which the first `n` bytes, the folder, have no special characters.
static const char *escaped(struct deck *d, const char *path, size_t n) {
    char *text = arena_alloc(d->arena, n + strlen(path) + 1, 1);
    char *to = text;
    for (size_t i = 0; text && path[i]; i++) {
        if (i < n && strchr("*?[\\", path[i])) {
            *to++ = '\\';
        }
        *to++ = path[i];
    }
    return text;
}

static bool search(struct deck *d, const struct word *w, const char *pattern, struct sweep *out) {
    const char *path = source_path(d, w->place.source, pattern);
    const size_t folder = path ? strlen(path) - strlen(pattern) : 0;
    path = path ? escaped(d, path, folder) : NULL;
    if (!path) {
        diagnostics_no_memory(&d->diagnostics);
        return false;
    }
    glob_t found;
    int answer = glob(path, GLOB_NOSORT, NULL, &found);
    if (answer != 0) {
        struct deck_quote quote;
        return deck_error(d, w,
                          answer == GLOB_NOMATCH ? "no file matches %s" : "cannot search for %s",
                          deck_quote(&quote, w, pattern));
    }
    bool good = take_paths(d, w, &found, folder, out);
    globfree(&found);
    return good;
}

// True if `text` may be a file, relative to the deck or to the file of the sweep.
static bool may_be_file(struct deck *d, const struct sweep *s, const char *text) {
    const struct source top = {.name = d->path};
    const char *path[] = {source_path(d, &top, text), source_path(d, s->origin, text)};
    return strchr(text, '$') || !path[0] || !path[1] || access(path[0], F_OK) == 0 ||
           access(path[1], F_OK) == 0;
}

enum extension { WITHOUT_EXTENSION, WITH_EXTENSION };

// The text of `s` whose file name, with or without extension, is `name`; NULL: there is none, or
// several.
static const char *text_of(const struct sweep *s, const char *name, enum extension extension) {
    const char *found = NULL;
    for (int i = 0; i < s->n; i++) {
        size_t n;
        const char *stem = text_stem(s->text[i], &n);
        n = extension == WITHOUT_EXTENSION ? n : strlen(stem);
        if (strlen(name) == n && strncmp(stem, name, n) == 0) {
            if (found && strcmp(found, s->text[i]) != 0) {
                return NULL;
            }
            found = s->text[i];
        }
    }
    return found;
}

void sweep_take_short_name(struct deck *d, const struct sweep *s) {
    struct define *define = s->text ? deck_define_find(d, s->name) : NULL;
    bool listed = false;
    for (int i = 0; define && i < s->n; i++) {
        listed = listed || strcmp(define->value.text, s->text[i]) == 0;
    }
    if (!define || listed || define->beside || may_be_file(d, s, define->value.text)) {
        return;
    }
    const char *text = text_of(s, define->value.text, WITHOUT_EXTENSION);
    text = text ? text : text_of(s, define->value.text, WITH_EXTENSION);
    if (text) {
        define->value.text = text;
        define->beside = s->origin;
    }
}

bool sweep_files(struct deck *d, const struct word *w, const char *pattern, struct sweep *out) {
    int choice;
    const struct sweep *from = sweep_bound(d, out->name, &choice);
    const bool one =
        from && from->fixed &&
        !deck_define_find(d, out->name);  // the one that a -D of its dimension has kept
    if (from && from->text && !one) {
        out->n = from->n;
        out->text = from->text;
        out->origin = from->origin;
        out->label = from->label;
    } else if (!search(d, w, pattern, out)) {
        return false;
    }
    // Changes a -D that gives the label of a file, as tables show it, into the path of the file.
    struct define *define = deck_define_find(d, out->name);
    for (int i = 0; define && i < out->n; i++) {
        if (strcmp(define->value.text, out->label[i]) == 0) {
            define->value.text = out->text[i];
            define->beside = out->origin;
            return true;
        }
    }
    if (!define || define->beside || may_be_file(d, out, define->value.text)) {
        return true;
    }
    deck_unknown(d, &define->value, define->value.text, out->name, out->label, out->n);
    define->taken = true;
    struct parameter *p = parameter_find(d, out->name, strlen(out->name));
    if (p) {
        p->kind = PARAMETER_WRONG;
    }
    return false;
}
