// SPDX-License-Identifier: GPL-3.0-or-later
// The table of parameters, and the -D NAME=VALUE of the command line.
#include "deck/parameter.h"

#include <assert.h>
#include <stdlib.h>
#include <string.h>

#include "core/arena.h"
#include "core/hash.h"
#include "core/text.h"
#include "deck/quantity.h"

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
    assert(name);
    const struct reader *r = d->reader;
    struct parameter *p = r->n_bucket > 0 ? *bucket_of(r, name, n) : NULL;
    while (p && !(strlen(p->name) == n && strncmp(p->name, name, n) == 0)) {
        p = p->next_in_bucket;
    }
    return p;
}

// Reports that there is no parameter of the name `w`.
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
        struct word part = deck_report_part(d, w, from, to);
        report_unknown(d, &part);
    } else {
        p->used = true;
        d->reader->swept = d->reader->swept || p->swept;
    }
    return p;
}

static void put_in_bucket(const struct reader *r, struct parameter *p) {
    struct parameter **bucket = bucket_of(r, p->name, strlen(p->name));
    p->next_in_bucket = *bucket;
    *bucket = p;
}

// Doubles the number of buckets, so that few parameters share one bucket.
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

struct parameter *parameter_add(struct deck *d, const struct parameter *value) {
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
        return deck_error(d, w, "'%s' cannot name a parameter; letters, digits and _ can", t.text);
    }
    return !quantity_is_reserved(w->text, strlen(w->text)) ||
           deck_error(d, w, "'%s' has a meaning in expressions and cannot name a parameter",
                      t.text);
}

struct define *deck_define_find(const struct deck *d, const char *name) {
    assert(name);
    for (int i = 0; i < d->reader->n_define; i++) {
        if (strcmp(d->reader->define[i].name, name) == 0) {
            return &d->reader->define[i];
        }
    }
    return NULL;
}

static void check(struct deck *d, struct define *define) {
    struct word name = define->value;
    name.text = define->name;
    define->taken = true;
    if (text_not_plain(define->name) || text_not_plain(define->value.text)) {
        deck_error(d, &name, "this is not UTF-8 text without control characters");
    } else if (!define->value.text[0]) {
        deck_error(d, &name, "it must be -D NAME=VALUE");
    } else if (parameter_check_name(d, &name)) {
        define->taken = false;
        for (struct define *other = d->reader->define; other < define; other++) {
            if (strcmp(other->name, define->name) == 0) {
                deck_error(d, &name, "'%s' is given twice", define->name);
                define->taken = true;
                return;
            }
        }
    }
}

static bool split(struct deck *d, const char *text, struct define *define) {
    size_t n = strcspn(text, "=");
    const char *value = text + n + (text[n] == '=');
    size_t size = strlen(value);
    bool quoted = size >= 2 && value[0] == '"' && value[size - 1] == '"';
    define->name = arena_text(d->arena, text, n);
    define->value.text =
        quoted ? arena_text(d->arena, value + 1, size - 2) : arena_text(d->arena, value, size);
    define->source.name = arena_format(d->arena, "-D %s", text);
    if (!define->name || !define->value.text || !define->source.name) {
        return false;
    }
    define->value.quoted = quoted;
    define->value.place.source = &define->source;
    return true;
}

bool deck_define_open(struct deck *d, const char *const *define, int n_define) {
    assert(n_define >= 0 && (define || n_define == 0));
    d->reader->define = arena_alloc(d->arena, (size_t)n_define, sizeof *d->reader->define);
    if (!d->reader->define) {
        return false;
    }
    for (int i = 0; i < n_define; i++) {
        d->reader->n_define = i + 1;
        if (!split(d, define[i], &d->reader->define[i])) {
            return false;
        }
    }
    return true;
}

void deck_define_check(struct deck *d) {
    for (int i = 0; i < d->reader->n_define; i++) {
        check(d, &d->reader->define[i]);
    }
}

void deck_define_turn(struct deck *d, struct define *define, const char *name, int number) {
    const char *text = arena_format(d->arena, "%d", number);
    if (!text) {
        diagnostics_no_memory(&d->diagnostics);
        return;
    }
    define->name = name;
    define->value.text = text;
    define->beside = NULL;
    d->reader->turned = true;
}

void deck_define_bind(struct deck *d, const struct deck *first) {
    for (int i = 0; i < d->reader->n_define; i++) {
        d->reader->define[i].name = first->reader->define[i].name;
        d->reader->define[i].value.text = first->reader->define[i].value.text;
        d->reader->define[i].beside = first->reader->define[i].beside;
    }
}

static int compare_texts(const void *a, const void *b) {
    return strcmp(*(char *const *)a, *(char *const *)b);
}

const char *const *deck_define_texts(const struct deck *d, struct arena *a) {
    const size_t n = (size_t)d->reader->n_define;
    const char **text = arena_alloc(a, n, sizeof *text);
    for (size_t i = 0; text && i < n; i++) {
        const struct define *define = &d->reader->define[i];
        const char *quote = define->value.quoted ? "\"" : "";
        text[i] = arena_format(a, "%s=%s%s%s", define->name, quote, define->value.text, quote);
        text = text[i] ? text : NULL;
    }
    if (text) {
        qsort(text, n, sizeof *text, compare_texts);
    }
    return text;
}

static void report_unused(struct deck *d, const struct parameter *p) {
    const struct define *define = deck_define_find(d, p->name);
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
    const bool valid = d->diagnostics.n_error == 0;
    for (const struct parameter *p = d->reader->first; valid && p; p = p->next) {
        if (!p->used) {
            report_unused(d, p);
        }
    }
}
