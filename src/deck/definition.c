// SPDX-License-Identifier: GPL-3.0-or-later
// Definitions of parameters: param NAME VALUE, a sweep, or both. The value of a -D or of a sweep
// replaces the value of the param and must have its kind and dimension.
#include "deck/definition.h"

#include <assert.h>
#include <string.h>

#include "core/text.h"
#include "deck/expression.h"
#include "deck/parameter.h"
#include "deck/quantity.h"

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

void sweep_choose(const struct sweep *s, int choice, struct parameter *p) {
    assert(choice >= 0 && choice < s->n);
    p->kind = s->number ? PARAMETER_NUMBER : PARAMETER_TEXT;
    p->swept = true;
    if (s->number) {
        p->number = (struct quantity){s->number[choice], s->known, s->dimension};
    } else {
        p->text = s->text[choice];
        p->origin = s->origin;
    }
}

static const char *const kind_name[] = {[PARAMETER_NUMBER] = "number", [PARAMETER_TEXT] = "text"};

// True if one value may replace the other. Numbers without a unit fit all numbers.
static bool fits(const struct parameter *a, const struct parameter *b) {
    return a->kind == b->kind &&
           (a->kind == PARAMETER_TEXT || !a->number.known || !b->number.known ||
            dimension_equal(a->number.dimension, b->number.dimension));
}

// False after having reported that `got`, at `w`, has another kind or dimension than `given`, which
// is in `where`.
static bool check_kind(struct deck *d, const struct word *w, const struct parameter *given,
                       const char *where, const struct parameter *got) {
    struct text_short name;
    struct quantity_text is, needed;
    if (got->kind == PARAMETER_WRONG || given->kind == PARAMETER_WRONG || fits(given, got)) {
        return true;
    }
    text_short(&name, got->name);
    if (got->kind != given->kind) {
        deck_error(d, w, "'%s' is a %s in %s; this is a %s", name.text, kind_name[given->kind],
                   where, kind_name[got->kind]);
    } else {
        deck_error(d, w, "'%s' is %s in %s; this is %s", name.text,
                   quantity_describe(&d->units, given->number.dimension, &needed), where,
                   quantity_describe(&d->units, got->number.dimension, &is));
    }
    return false;
}

// Replaces the value of `p` by the value of a -D. The kind stays the same.
static void override(struct deck *d, struct define *define, struct parameter *p) {
    struct parameter deck_value = *p;
    if (deck_value.kind == PARAMETER_TEXT) {
        parameter_read_text(d, &define->value, p);
        p->origin = define->beside ? define->beside : p->origin;
        return;
    }
    parameter_read(d, &define->value, p);
    if (!check_kind(d, &define->value, &deck_value, "the deck", p)) {
        p->kind = PARAMETER_WRONG;
    }
}

// The place of the param or sweep of `p`, whichever `by` includes; NULL: there is none.
static const struct place *defined_at(const struct parameter *p, enum definition by) {
    return by & BY_PARAM && p->param.source   ? &p->param
           : by & BY_SWEEP && p->sweep.source ? &p->sweep
                                              : NULL;
}

bool parameter_is_free(struct deck *d, const struct word *name, enum definition by) {
    if (!parameter_check_name(d, name)) {
        return false;
    }
    struct text_short t;
    const struct parameter *other = parameter_find(d, name->text, strlen(name->text));
    const struct place *at = other ? defined_at(other, by) : NULL;
    if (at) {
        deck_error(d, name, "parameter '%s' is already %s in %s", text_short(&t, name->text),
                   at == &other->param ? "defined" : "swept", source_mention(d, at, &name->place));
    }
    return !at;
}

static void take_value(struct parameter *to, const struct parameter *from) {
    to->kind = from->kind;
    to->number = from->number;
    to->text = from->text;
    to->origin = from->origin;
}

// Adds the second definition to `p`, which then has a param and a sweep. The sweep gives the
// values. True if a -D gives the value.
static bool add_definition(struct deck *d, const struct word *name, enum definition by,
                           struct parameter *p, struct parameter *value) {
    const struct place *first = by == BY_PARAM ? &p->sweep : &p->param;
    struct define *define = deck_define_find(d, p->name);
    const bool found =  // the -D is a label whose file the sweep has found
        define && define->beside && by == BY_SWEEP && p->kind == PARAMETER_TEXT;
    value->name = p->name;
    if (found) {
        override(d, define, p);
    }
    if (p->derived || value->derived) {
        deck_error(d, name, "the param of a swept parameter cannot depend on a sweep");
    } else if (check_kind(d, name, p, source_mention(d, first, &name->place), value)) {
        if (define) {
            take_value(value, p);
        } else if (by == BY_SWEEP) {
            take_value(p, value);
            p->swept = true;
        }
        const bool changed = found || (!define && by == BY_SWEEP);
        d->reader->late = d->reader->late || (changed && p->used && p->kind != PARAMETER_WRONG);
    }
    return define;
}

bool parameter_keep(struct deck *d, const struct word *name, enum definition by,
                    struct parameter *value) {
    struct parameter *kept = parameter_find(d, name->text, strlen(name->text));
    bool defined = false;
    if (kept) {
        defined = add_definition(d, name, by, kept, value);
    } else {
        value->name = name->text;
        // The value of a new parameter comes from a -D or, for a param, from a sweep of the first
        // reading. A sweep that does not fit is ignored here and reported at its statement.
        struct define *define = deck_define_find(d, value->name);
        int choice;
        const struct sweep *s = by == BY_PARAM ? sweep_bound(d, value->name, &choice) : NULL;
        if (define) {
            if (!define->taken) {
                define->taken = true;
                override(d, define, value);
            }
            value->swept = false;
        } else if (s) {
            struct parameter chosen = *value;
            sweep_choose(s, choice, &chosen);
            *value = fits(value, &chosen) ? chosen : *value;
        }
        defined = define;
        kept = parameter_add(d, value);
    }
    if (kept) {
        kept->derived = kept->derived || value->derived;
        kept->param = by & BY_PARAM ? name->place : kept->param;
        kept->sweep = by & BY_SWEEP ? name->place : kept->sweep;
    }
    return defined;
}

void parameter_define(struct deck *d, const struct word *name, const struct word *value) {
    if (parameter_is_free(d, name, BY_PARAM)) {
        struct parameter p = {
            0};  // added after its value is read: a value cannot use its own parameter
        d->reader->swept = false;
        parameter_read(d, value, &p);
        p.swept = p.derived = d->reader->swept;
        parameter_keep(d, name, BY_PARAM, &p);
    }
}
