// SPDX-License-Identifier: GPL-3.0-or-later
// Paired sweeps (sweeps with the same -as): one dimension of the study.
#include <math.h>
#include <string.h>

#include "deck/definition.h"
#include "deck/parameter.h"
#include "deck/sweep.h"

struct bundle {
    struct sweep *sweep;  // over the numbers 1 ... n
    struct sweep *last;   // the last paired sweep so far; NULL: none yet
    int n;                // values of each sweep, also if a -D chooses one of them
    int choice;           // number of the value in this run, from 0
    bool valid;           // false: an error has been reported
    const char *first;    // name of its first paired sweep
    const char *noun;     // "value" or "file", for the values of the first sweep
    struct place place;
    struct bundle *next;
};

bool sweep_append(struct deck *d, const struct word *w, struct sweep *s) {
    struct reader *r = d->reader;
    if (s->fixed) {
        s->n = 1;
    }
    if (r->n_sweep == STUDY_SWEEPS_MAX) {
        return deck_error(d, w, "more than %d sweeps", STUDY_SWEEPS_MAX);
    }
    if (d->n_run > STUDY_RUNS_MAX / s->n) {
        return deck_error(d, w, "the sweeps make more than %d runs", STUDY_RUNS_MAX);
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

bool bundle_name(struct deck *d, const struct argument *as, const struct word *at,
                 const char *fallback, const struct sweep *own, struct bundle_request *q) {
    q->name = as->given ? as->word[0] : *at;
    q->name.text = as->given ? as->text[0] : fallback;
    return !q->name.text || strcmp(q->name.text, own->name) != 0 ||
           deck_error(d, &q->name, "the dimension of -as needs another name than its sweeps");
}

// Defines the parameter that numbers the paired values, and sets its number in this run.
static bool number_bundle(struct deck *d, const struct bundle_request *q, struct bundle *b) {
    const struct define *define = deck_define_find(d, q->name.text);
    if (!sweep_bound(d, q->name.text, &b->choice) || b->choice >= b->n) {
        b->choice = 0;
    }
    struct parameter p = {.kind = PARAMETER_NUMBER, .swept = true, .used = true};
    p.number = (struct quantity){b->choice + 1, true, dimension_none};
    if (!parameter_keep(d, &q->name, BY_BUNDLE, &p)) {
        return true;
    }
    const double x = p.kind == PARAMETER_NUMBER ? p.number.value : 1.0;
    if (!(x >= 1.0 && x <= b->n && x == floor(x))) {
        return deck_error(d, &define->value, "'%s' is numbered from 1 to %d", q->name.text, b->n);
    }
    b->choice = (int)x - 1;
    sweep_fix(d, &p, b->sweep);
    return p.kind == PARAMETER_NUMBER;
}

// The numbers 1 ... n; NULL: no memory. All runs use the array of the first reading.
static const double *numbers(struct deck *d, const char *name, int n) {
    int choice;
    const struct sweep *from = sweep_bound(d, name, &choice);
    if (from && from->number && from->n == n && from->along) {
        return from->number;
    }
    double *number = deck_array(d, (size_t)n, sizeof *number);
    for (int i = 0; number && i < n; i++) {
        number[i] = i + 1;
    }
    return number;
}

// Creates a dimension of paired sweeps. It stays in the list even if it has an error. NULL: no
// memory.
static struct bundle *create_bundle(struct deck *d, const struct bundle_request *q,
                                    const struct sweep *own) {
    const int n = own->n;
    struct bundle *b = deck_array(d, 1, sizeof *b);
    struct sweep *sweep = deck_array(d, 1, sizeof *sweep);
    const double *number = numbers(d, q->name.text, n);
    if (!b || !sweep || !number) {
        return NULL;
    }
    *sweep = (struct sweep){
        .name = q->name.text, .n = n, .number = number, .known = true, .dimension = dimension_none};
    *b = (struct bundle){.sweep = sweep,
                         .n = n,
                         .first = own->name,
                         .noun = q->noun,
                         .place = q->count->place,
                         .next = d->reader->bundles};
    d->reader->bundles = b;
    b->valid = parameter_is_free(d, &q->name, BY_BUNDLE) && number_bundle(d, q, b) &&
               sweep_append(d, &q->name, sweep);
    return b;
}

// The dimension that `q` names, created if it is new; NULL after having reported an error.
static struct bundle *find_bundle(struct deck *d, const struct bundle_request *q,
                                  const struct sweep *own) {
    struct bundle *b = d->reader->bundles;
    while (b && strcmp(b->sweep->name, q->name.text) != 0) {
        b = b->next;
    }
    b = b ? b : create_bundle(d, q, own);
    if (b && b->n != own->n) {
        deck_error(d, q->count,
                   "'%s' has %d %s%s, but '%s' in %s has %d %s%s; sweeps with -as %s need equally "
                   "many values; give another -as NAME to make them independent",
                   own->name, own->n, q->noun, own->n == 1 ? "" : "s", b->first,
                   source_mention(d, &b->place, &q->count->place), b->n, b->noun,
                   b->n == 1 ? "" : "s", b->sweep->name);
        return NULL;
    }
    return b && b->valid ? b : NULL;
}

bool bundle_choose(struct deck *d, const struct bundle_request *q, const struct sweep *own) {
    struct define *define = deck_define_find(d, own->name);
    int at = 0;
    if (!define || !q->name.text || deck_define_find(d, q->name.text)) {
        return false;
    }
    // Counts the occurrences of the text; `at` is the index of the last one.
    int n = 0;
    for (int i = 0; own->text && i < own->n; i++) {
        if (strcmp(own->text[i], define->value.text) == 0) {
            at = i;
            n++;
        }
    }
    if (n > 1) {
        deck_error(d, &define->value, "this occurs %d times in '%s'; -D %s=NUMBER chooses one", n,
                   own->name, q->name.text);
        define->taken = true;
    } else if (n == 1) {
        deck_define_turn(d, define, q->name.text, at + 1);
    }
    return n > 0;
}

// Removes all values of `s` except number `choice`.
static void keep_value(struct sweep *s, int choice) {
    s->n = 1;
    s->fixed = true;
    s->number = s->number ? s->number + choice : NULL;
    s->text = s->text ? s->text + choice : NULL;
    s->label = s->label ? s->label + choice : NULL;
    s->lines = (struct deck_lines){.text = NULL};
}

bool bundle_join(struct deck *d, const struct bundle_request *q, struct sweep *own,
                 struct parameter *p) {
    struct bundle *b = find_bundle(d, q, own);
    if (!b) {
        return false;
    }
    sweep_choose(own, b->choice, p);
    p->swept = !b->sweep->fixed;
    if (b->sweep->fixed) {
        keep_value(own, b->choice);
    }
    struct sweep *before = b->last ? b->last : b->sweep;
    before->along = own;
    b->last = own;
    return true;
}
