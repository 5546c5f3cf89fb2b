// SPDX-License-Identifier: GPL-3.0-or-later
// Parameters: param NAME VALUE, and their use in texts. The value of a -D or of a sweep goes before
// that of the param, whose kind and dimension it must have.
//
// VALUE is a number if it is not quoted and starts like one (a digit, or a point and a digit,
// either after a sign) or is a $name or ${expression} as a whole; everything else is a text. So a
// text that starts with a digit must be quoted: nothing is guessed.
#include <string.h>

#include "core/hash.h"
#include "core/text.h"
#include "deck/reader.h"

const char *parameter_name_end(const char *text) {
    const char *at = text;
    while ((*at >= 'a' && *at <= 'z') || (*at >= 'A' && *at <= 'Z') || *at == '_' ||
           (at > text && *at >= '0' && *at <= '9')) {
        at++;
    }
    return at;
}

static struct parameter **bucket_of(const struct reader *r, const char *name, size_t n) {
    return &r->bucket[hash_add(hash_start, name, n) % r->n_bucket];
}

struct parameter *parameter_find(const struct deck *d, const char *name, size_t n) {
    const struct reader *r = d->reader;
    struct parameter *p = r->n_bucket > 0 ? *bucket_of(r, name, n) : NULL;
    while (p && !(strlen(p->name) == n && strncmp(p->name, name, n) == 0)) {
        p = p->next_in_bucket;
    }
    return p;
}

// Reports that there is no parameter of the name that `w` holds.
static void report_unknown(struct deck *d, const struct word *w) {
    const struct reader *r = d->reader;
    const char **known = NULL;
    if (d->diagnostics.n_item < DIAGNOSTICS_MAX) {
        known = deck_array(d, (size_t)r->n_parameter, sizeof *known);
        if (!known) {
            return;
        }
    }
    int n = 0;
    for (const struct parameter *p = r->first; p && known; p = p->next) {
        known[n++] = p->name;
    }
    deck_unknown(d, w, w->text, "parameter", known, n);
}

struct parameter *parameter_get(struct deck *d, const struct word *w, const char *from,
                                const char *to) {
    struct parameter *p = parameter_find(d, from, (size_t)(to - from));
    if (!p) {
        struct word part = report_part(d, w, from, to);
        report_unknown(d, &part);
    } else {
        p->used = true;
        d->reader->swept = d->reader->swept || p->swept;
    }
    return p;
}

// True if the word is $name or ${...}, perhaps after a sign, and nothing else.
static bool is_dollar(const char *text) {
    text += *text == '-' || *text == '+';
    if (text[0] != '$') {
        return false;
    }
    if (text[1] == '{') {
        const char *close = strchr(text, '}');
        return close && close[1] == 0;
    }
    const char *end = parameter_name_end(text + 1);
    return end > text + 1 && *end == 0;
}

static bool is_number_like(const struct word *w) {
    const char *t = w->text + (*w->text == '-' || *w->text == '+');
    t += *t == '.';
    return !w->quoted && ((*t >= '0' && *t <= '9') || is_dollar(w->text));
}

// The text parameter that the word names as a whole, as $name or ${name}; NULL: it is no such word.
static const struct parameter *whole_text(const struct deck *d, const struct word *w) {
    if (w->quoted || w->text[0] != '$') {
        return NULL;
    }
    const char *name = w->text + 1;
    name += *name == '{';
    const char *end = parameter_name_end(name);
    const struct parameter *p = parameter_find(d, name, (size_t)(end - name));
    return is_dollar(w->text) && p && p->kind == PARAMETER_TEXT && (*end == 0 || *end == '}')
               ? p
               : NULL;
}

static const char *const kind_name[] = {[PARAMETER_NUMBER] = "number", [PARAMETER_TEXT] = "text"};

// Whether one value may replace the other: numbers without a unit fit all numbers.
static bool fits(const struct parameter *a, const struct parameter *b) {
    return a->kind == b->kind &&
           (a->kind == PARAMETER_TEXT || !a->number.known || !b->number.known ||
            dimension_equal(a->number.dimension, b->number.dimension));
}

const struct source *parameter_origin(const struct deck *d, const struct word *w) {
    const struct word bare = {.text = w->text};
    const struct parameter *p = whole_text(d, &bare);
    return p ? p->origin : w->place.source;
}

static void read_text(struct deck *d, const struct word *w, struct parameter *p) {
    p->origin = parameter_origin(d, w);
    p->text = deck_text_of_file(d, w);
    p->kind = p->text ? PARAMETER_TEXT : PARAMETER_WRONG;
}

void parameter_read(struct deck *d, const struct word *w, struct parameter *p) {
    if (!is_number_like(w) || whole_text(d, w)) {
        read_text(d, w, p);
        return;
    }
    bool ok = expression_number(d, w, w->text, &p->number);
    p->kind = ok ? PARAMETER_NUMBER : PARAMETER_WRONG;
}

// Reports that `got`, at `w`, is of another kind than `given`, which stands in `where`.
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

// Puts the value of a -D in the place of the deck's; the kind stays.
static void override(struct deck *d, struct define *define, struct parameter *p) {
    struct parameter deck_value = *p;
    if (deck_value.kind == PARAMETER_TEXT) {
        read_text(d, &define->value, p);
        p->origin = define->beside ? define->beside : p->origin;
        return;
    }
    parameter_read(d, &define->value, p);
    if (!check_kind(d, &define->value, &deck_value, "the deck", p)) {
        p->kind = PARAMETER_WRONG;
    }
}

static void put_in_bucket(const struct reader *r, struct parameter *p) {
    struct parameter **bucket = bucket_of(r, p->name, strlen(p->name));
    p->next_in_bucket = *bucket;
    *bucket = p;
}

// Twice the buckets, so that few parameters share one.
static bool grow_buckets(struct deck *d) {
    enum { BUCKETS_FIRST = 64 };
    struct reader *r = d->reader;
    const size_t n = r->n_bucket > 0 ? 2 * r->n_bucket : BUCKETS_FIRST;
    struct parameter **bucket = deck_array(d, n, sizeof(struct parameter *));
    if (!bucket) {
        return false;
    }
    r->bucket = bucket;
    r->n_bucket = n;
    for (struct parameter *p = r->first; p; p = p->next) {
        put_in_bucket(r, p);
    }
    return true;
}

static struct parameter *append(struct deck *d, const struct parameter *value) {
    struct reader *r = d->reader;
    struct parameter *p = deck_array(d, 1, sizeof *p);
    if (!p || ((size_t)r->n_parameter == r->n_bucket && !grow_buckets(d))) {
        return NULL;
    }
    *p = *value;
    put_in_bucket(r, p);
    if (r->last) {
        r->last->next = p;
    } else {
        r->first = p;
    }
    r->last = p;
    r->n_parameter++;
    return p;
}

bool parameter_check_name(struct deck *d, const struct word *w) {
    struct text_short t;
    text_short(&t, w->text);
    const char *end = parameter_name_end(w->text);
    if (end == w->text || *end) {
        deck_error(d, w, "'%s' cannot name a parameter; letters, digits and _ can", t.text);
        return false;
    }
    if (expression_is_reserved(w->text, strlen(w->text))) {
        deck_error(d, w, "'%s' has a meaning in expressions and cannot name a parameter", t.text);
        return false;
    }
    return true;
}

// Where `p` is defined by one of the kinds that `by` names; NULL: nowhere.
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

// The value of a new parameter is that of a -D, or of a sweep below its param that another reading
// has found, which says there if it does not fit. True if it is that of a -D.
static bool replace(struct deck *d, enum definition by, struct parameter *p) {
    struct define *define = define_find(d, p->name);
    int choice;
    const struct sweep *s = by == BY_PARAM ? sweep_bound(d, p->name, &choice) : NULL;
    if (define) {
        if (!define->taken) {
            define->taken = true;
            override(d, define, p);
        }
        p->swept = false;
    } else if (s) {
        struct parameter chosen = *p;
        sweep_choose(s, choice, &chosen);
        *p = fits(p, &chosen) ? chosen : *p;
    }
    return define;
}

static void take_value(struct parameter *to, const struct parameter *from) {
    to->kind = from->kind;
    to->number = from->number;
    to->text = from->text;
    to->origin = from->origin;
}

// The second definition of `p`, by a param and a sweep: the sweep gives the values. True
// if a -D gives it.
static bool join(struct deck *d, const struct word *name, enum definition by, struct parameter *p,
                 struct parameter *value) {
    const struct place *first = by == BY_PARAM ? &p->sweep : &p->param;
    struct define *define = define_find(d, p->name);
    const bool found =  // the file of a label
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
        defined = join(d, name, by, kept, value);
    } else {
        value->name = name->text;
        defined = replace(d, by, value);
        kept = append(d, value);
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
        struct parameter p = {0};  // not in the list yet: a value cannot name its own parameter
        d->reader->swept = false;
        parameter_read(d, value, &p);
        p.swept = p.derived = d->reader->swept;
        parameter_keep(d, name, BY_PARAM, &p);
    }
}

static void report_unused(struct deck *d, const struct parameter *p) {
    const struct define *define = define_find(d, p->name);
    if (define) {
        struct word value = define->value;
        deck_error(d, &value, "nothing in the deck uses parameter '%s'", p->name);
    } else if (p->sweep.source) {
        struct word name = {.text = p->name, .place = p->sweep};
        deck_error(d, &name, "the deck does not use the swept parameter '%s'", p->name);
    } else {
        struct word name = {.text = p->name, .place = p->param};
        deck_warning(d, &name, "the deck does not use parameter '%s'", p->name);
    }
}

void parameter_close(struct deck *d) {
    for (int i = 0; i < d->reader->n_define; i++) {
        const struct define *define = &d->reader->define[i];
        if (!define->taken) {
            struct word name = define->value;
            name.text = define->name;
            report_unknown(d, &name);
        }
    }
    bool sound = d->diagnostics.n_error == 0;
    for (const struct parameter *p = d->reader->first; sound && p; p = p->next) {
        if (!p->used) {
            report_unused(d, p);
        }
    }
}
