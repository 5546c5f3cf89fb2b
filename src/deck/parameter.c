// SPDX-License-Identifier: GPL-3.0-or-later
// Parameters: param NAME VALUE, -D NAME=VALUE, and their use in texts.
//
// VALUE is a number if it is not quoted and starts like one (a digit, a point and a digit, either
// of them behind a sign) or is a $name or ${expression} as a whole; everything else is a text. So a
// text that starts with a digit must be quoted: nothing is guessed.
#include <string.h>

#include "core/arena.h"
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

static unsigned bucket_of(const char *name, size_t n) {
    unsigned hash = 2166136261u;  // FNV-1a
    for (size_t i = 0; i < n; i++) {
        hash = (hash ^ (unsigned char)name[i]) * 16777619u;
    }
    return hash % PARAMETER_BUCKETS;
}

struct parameter *parameter_find(const struct deck *d, const char *name, size_t n) {
    struct parameter *p = d->reader->bucket[bucket_of(name, n)];
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
    deck_unknown(d, w, "parameter", known, n);
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

// True if the word is $name or ${...}, perhaps behind a sign, and nothing else.
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

static void read_text(struct deck *d, const struct word *w, struct parameter *p) {
    p->text = deck_text(d, w);
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

// Puts the value of a -D in the place of the deck's; the kind stays.
static void override(struct deck *d, struct define *define, struct parameter *p) {
    struct parameter deck_value = *p;
    define->taken = true;
    if (deck_value.kind == PARAMETER_TEXT) {
        read_text(d, &define->value, p);
        return;
    }
    parameter_read(d, &define->value, p);
    if (deck_value.kind != PARAMETER_NUMBER || p->kind == PARAMETER_WRONG) {
        return;
    }
    struct text_short name;
    struct quantity_text got, needed;
    if (p->kind == PARAMETER_TEXT) {
        deck_error(d, &define->value, "'%s' is a number in the deck; this is a text",
                   text_short(&name, p->name));
        p->kind = PARAMETER_WRONG;
    } else if (p->number.known && deck_value.number.known &&
               !dimension_equal(p->number.dimension, deck_value.number.dimension)) {
        deck_error(d, &define->value, "'%s' is %s in the deck; this is %s",
                   text_short(&name, p->name),
                   quantity_describe(&d->units, deck_value.number.dimension, &needed),
                   quantity_describe(&d->units, p->number.dimension, &got));
        p->kind = PARAMETER_WRONG;
    }
}

static struct parameter *append(struct deck *d, const struct word *name) {
    struct reader *r = d->reader;
    struct parameter *p = deck_array(d, 1, sizeof *p);
    if (!p) {
        return NULL;
    }
    p->name = name->text;
    p->place = name->place;
    struct parameter **bucket = &r->bucket[bucket_of(p->name, strlen(p->name))];
    p->next_in_bucket = *bucket;
    *bucket = p;
    if (r->last) {
        r->last->next = p;
    } else {
        r->first = p;
    }
    r->last = p;
    r->n_parameter++;
    return p;
}

// False after having reported that `w` cannot name a parameter.
static bool check_name(struct deck *d, const struct word *w) {
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

const struct define *parameter_definition(const struct deck *d, const char *name) {
    for (int i = 0; i < d->reader->n_define; i++) {
        if (strcmp(d->reader->define[i].name, name) == 0) {
            return &d->reader->define[i];
        }
    }
    return NULL;
}

bool parameter_is_free(struct deck *d, const struct word *name) {
    if (!check_name(d, name)) {
        return false;
    }
    struct text_short t;
    const struct parameter *other = parameter_find(d, name->text, strlen(name->text));
    if (other) {
        deck_error(d, name, "parameter '%s' is already defined in %s", text_short(&t, name->text),
                   source_mention(d, &other->place, &name->place));
    }
    return !other;
}

bool parameter_keep(struct deck *d, const struct word *name, struct parameter *value) {
    bool overridden = false;
    for (int i = 0; i < d->reader->n_define; i++) {
        struct define *define = &d->reader->define[i];
        if (!define->taken && strcmp(define->name, name->text) == 0) {
            value->name = name->text;
            override(d, define, value);
            overridden = true;
        }
    }
    struct parameter *kept = append(d, name);
    if (kept) {
        kept->kind = value->kind;
        kept->number = value->number;
        kept->text = value->text;
        kept->sweep = value->sweep && !overridden;
        kept->swept = value->swept && !overridden;
        kept->used = value->used;
    }
    return overridden;
}

void parameter_define(struct deck *d, const struct word *name, const struct word *value) {
    if (parameter_is_free(d, name)) {
        struct parameter p = {0};  // not in the list yet: a value cannot name its own parameter
        d->reader->swept = false;
        parameter_read(d, value, &p);
        p.swept = d->reader->swept;
        parameter_keep(d, name, &p);
    }
}

// True if the text can be shown and kept: UTF-8 without control characters.
static bool is_plain_text(const char *text) {
    size_t size = strlen(text);
    for (size_t i = 0; i < size;) {
        size_t bytes = text_character(text + i, size - i);
        if (bytes == 0 || text_is_control(text + i, bytes)) {
            return false;
        }
        i += bytes;
    }
    return true;
}

static void check_define(struct deck *d, struct define *define, bool has_value) {
    struct word name = define->value;
    name.text = define->name;
    define->taken = true;
    if (!is_plain_text(define->name) || !is_plain_text(define->value.text)) {
        deck_error(d, &name, "this is not UTF-8 text without control characters");
    } else if (!has_value || !define->value.text[0]) {
        deck_error(d, &name, "it must be -D NAME=VALUE");
    } else if (check_name(d, &name)) {
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
    bool has_value = text[n] == '=';
    const char *value = text + n + (has_value ? 1 : 0);
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
    check_define(d, define, has_value);
    return true;
}

bool parameter_open(struct deck *d, const char *const *define, int n_define) {
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

static void report_unused(struct deck *d, const struct parameter *p) {
    const struct define *define = parameter_definition(d, p->name);
    if (define) {
        struct word value = define->value;
        deck_error(d, &value, "nothing in the deck uses parameter '%s'", p->name);
    } else if (p->sweep) {
        struct word name = {.text = p->name, .place = p->place};
        deck_error(d, &name, "nothing uses the swept parameter '%s'", p->name);
    } else {
        struct word name = {.text = p->name, .place = p->place};
        deck_warning(d, &name, "nothing uses parameter '%s'", p->name);
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
