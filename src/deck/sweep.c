// SPDX-License-Identifier: GPL-3.0-or-later
// sweep NAME values|range|files|random ...: a parameter that takes one value after another, run by
// run. A param of the same name may be above or below the sweep. Its value would be used without
// the sweep. The values of a sweep do not depend on other sweeps, so the runs of a study form a
// grid.
#include <math.h>
#include <string.h>

#include "deck/definition.h"
#include "deck/expression.h"
#include "deck/parameter.h"
#include "deck/sweep.h"

const char sweep_usage[] =
    "sweep NAME values LIST | range FROM TO N [-log] | files \"GLOB\" | random DISTRIBUTION A B "
    "-n N -seed S [-lhs] [-min X] [-max X] [-correlated NAME:RHO], each [-as DIMENSION]";

enum { AS, LOG, N_ROW };

static const struct row rows[N_ROW] = {
    [AS] = {"as", ROW_TEXT, 0, {0, 0, 0}, NULL, NAN, "dimension of the paired sweeps"},
    [LOG] = {"log", ROW_FLAG, 0, {0, 0, 0}, NULL, NAN, "equal ratios"},
};

// The files that match a pattern.
static bool read_files(struct deck *d, const struct statement *s, struct sweep *own) {
    if (s->n_plain != 4) {
        return deck_error(d, &s->word[2], "one pattern of file names is expected");
    }
    const char *pattern = deck_text_of_file(d, &s->word[3]);
    return pattern && sweep_files(d, &s->word[3], pattern, own);
}

// Reads the values, and the name of their dimension into *q.
static bool read_values_of(struct deck *d, const struct statement *s, struct sweep *own,
                           struct bundle_request *q) {
    enum { VALUES, RANGE, FILES, RANDOM, N_KIND };
    static const char *const kinds[N_KIND] = {
        [VALUES] = "values", [RANGE] = "range", [FILES] = "files", [RANDOM] = "random"};
    const int kind = deck_keyword(d, &s->word[2], "kind of sweep", kinds, N_KIND);
    struct argument argument[N_ROW];
    struct row_set set = {rows, kind == RANGE ? N_ROW : AS + 1, argument};
    q->count = &s->word[1];
    q->noun = kind == FILES ? "file" : "value";
    if (kind < 0 || kind == RANDOM) {
        return kind == RANDOM && sweep_random(d, s, own, q);
    }
    if (!deck_options(d, s, &set, 1) || !bundle_name(d, &argument[AS], &s->word[1], NULL, own, q)) {
        return false;
    }
    if (kind == RANGE) {
        return sweep_range(d, s, argument[LOG].given ? SPACING_LOG : SPACING_LINEAR, own);
    }
    if (kind == FILES) {
        return read_files(d, s, own);
    }
    const bool good = sweep_list(d, s, q->name.text ? VALUES_MAY_REPEAT : VALUES_DIFFER, own);
    if (good) {
        sweep_take_short_name(d, own);
    }
    return good;
}

const struct sweep *sweep_named(const struct sweep *s) {
    while (s && s->random) {
        s = s->along;
    }
    return s;
}

// The dimension of the paired sweep `s` of an earlier reading; NULL: `s` is not paired.
static const struct sweep *dimension_of(const struct deck *d, const struct sweep *s) {
    for (const struct sweep *of = d->reader->bound; of; of = of->next) {
        for (const struct sweep *p = of->along; p; p = p->along) {
            if (p == s) {
                return of;
            }
        }
    }
    return NULL;
}

// The value of `sweep` in this run, as a parameter.
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

// The sweep of this name if it has been fixed at one value since the first reading, and not by a
// -D of it or of the dimension of its pair; NULL: it has not.
static const struct sweep *fixed_since(const struct deck *d, const char *name) {
    int choice;
    const struct sweep *from = sweep_bound(d, name, &choice);
    if (!from || !from->fixed || deck_define_find(d, name)) {
        return NULL;
    }
    const struct sweep *of = dimension_of(d, from);
    return of && deck_define_find(d, of->name) ? NULL : from;
}

// Reads the values; false after having reported an error.
static bool read(struct deck *d, const struct statement *s, struct sweep *own,
                 struct bundle_request *q) {
    const struct sweep *known = s->known ? s->known : fixed_since(d, s->word[1].text);
    if (known) {
        // Copies the sweep that the first reading found in these lines.
        const struct sweep *of = dimension_of(d, known);
        *own = *known;
        own->next = own->along = NULL;
        q->name = s->word[1];
        q->name.text = of ? of->name : NULL;
        q->count = &s->word[1];
        return true;
    }
    d->reader->swept = false;
    if (!read_values_of(d, s, own, q)) {
        return false;
    }
    if (d->reader->swept) {
        return deck_error(d, &s->word[2],
                          "the values of a sweep cannot depend on a swept parameter");
    }
    if (!memchr(s->lines.text, '$', s->lines.size)) {
        own->lines = s->lines;
    }
    return true;
}

void sweep_run(struct deck *d, const struct statement *s) {
    if (s->n_plain < 4) {
        deck_error(d, s->word, "a word is missing; the statement is %s", sweep_usage);
    }
    if (s->n_plain < 2 || !parameter_is_free(d, &s->word[1], BY_SWEEP)) {
        return;
    }
    const char *name = s->word[1].text;
    struct parameter *param = parameter_find(d, name, strlen(name));
    if (param) {
        param->swept = true;  // the values of the sweep must not depend on its param
    }
    struct sweep *own = deck_array(d, 1, sizeof *own);
    if (!own) {
        return;
    }
    own->name = name;
    struct bundle_request q = {.count = NULL};
    struct parameter p = {.kind = PARAMETER_WRONG};
    bool alone = true;  // not paired; a -D of one sweep ends its pairing
    if (s->n_plain >= 4 && read(d, s, own, &q) && sweep_note_law(d, own) &&
        !bundle_choose(d, &q, own)) {
        alone = !q.name.text || deck_define_find(d, own->name);
        if (alone) {
            p = chosen(d, own);
        } else {
            bundle_join(d, &q, own, &p);
        }
    }
    const bool good = p.kind != PARAMETER_WRONG;
    if (parameter_keep(d, &s->word[1], BY_SWEEP, &p) && good) {
        sweep_fix(d, &p, own);
    }
    if (good && alone) {
        sweep_append(d, &s->word[1], own);
    }
}
