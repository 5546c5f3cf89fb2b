// SPDX-License-Identifier: GPL-3.0-or-later
// Words and expressions -> quantities, by recursive descent:
//
//     sum     = product { (+ | -) product }
//     product = sign { (* | /) sign }
//     sign    = (+ | -) sign | power
//     power   = primary [ ^ sign ]                so 2^3^2 = 2^9 and -2^2 = -4
//     primary = literal | name | $name | pi | function ( sum {, sum} ) | ( sum )
//
// A literal takes the longest unit that follows it directly. In 300t/g the g is the unit; in
// 300t / g it is a parameter.
#include "deck/expression.h"

#include <ctype.h>
#include <string.h>

#include "core/text.h"
#include "deck/parameter.h"
#include "deck/quantity.h"

// The limit of nested brackets, signs and powers, so that no text overflows the stack.
enum { DEPTH_MAX = 100 };

struct parser {
    struct deck *deck;
    const struct word *word;
    const char *at, *end;
    int depth;
};

static bool sum(struct parser *p, struct quantity *out);

static void skip_spaces(struct parser *p) {
    while (p->at < p->end && (*p->at == ' ' || *p->at == '\t')) {
        p->at++;
    }
}

// The next character that is not a space; 0 at the end.
static char next(struct parser *p) {
    skip_spaces(p);
    return p->at < p->end ? *p->at : '\0';
}

static bool parameter_number(struct deck *d, const struct word *w, const char *from, const char *to,
                             struct quantity *out) {
    const struct parameter *parameter = parameter_get(d, w, from, to);
    if (!parameter || parameter->kind == PARAMETER_WRONG) {
        return false;
    }
    if (parameter->kind == PARAMETER_TEXT) {
        struct text_short name, text;
        return deck_report_false(
            d, w, from, to, "parameter '%s' is the text '%s'; a number is needed",
            text_short(&name, parameter->name), text_short(&text, parameter->text));
    }
    *out = parameter->number;
    return true;
}

static bool name_is(const char *from, const char *to, const char *name) {
    return (size_t)(to - from) == strlen(name) && strncmp(from, name, strlen(name)) == 0;
}

static bool close_bracket(struct parser *p, const char *open) {
    if (next(p) != ')') {
        return deck_report_false(p->deck, p->word, open, open + 1,
                                 "the ')' to this '(' is missing");
    }
    p->at++;
    return true;
}

// Reads the other arguments of min (sign -1) or max (+1), after the first one.
static bool choice(struct parser *p, int sign, const char *name, const char *name_end,
                   struct quantity *out) {
    if (next(p) != ',') {
        return deck_report_false(p->deck, p->word, name, name_end,
                                 "at least two values are needed here");
    }
    while (next(p) == ',') {
        const char *from = ++p->at;
        struct quantity other;
        struct error e;
        if (!sum(p, &other)) {
            return false;
        }
        if (quantity_choose(&p->deck->units, sign, out, &other, &e) != STATUS_OK) {
            return deck_report_false(p->deck, p->word, from, p->at, "%s", e.message);
        }
    }
    return true;
}

static bool call(struct parser *p, const char *name, const char *name_end, struct quantity *out) {
    if (!quantity_is_reserved(name, (size_t)(name_end - name)) || name_is(name, name_end, "pi")) {
        const char *known[32] = {"min", "max"};
        int n = 2;
        for (int i = 0; i < n_quantity_function && n < 32; i++) {
            known[n++] = quantity_functions[i].name;
        }
        struct word part = deck_report_part(p->deck, p->word, name, name_end);
        deck_unknown(p->deck, &part, part.text, "function", known, n);
        return false;
    }
    const char *open = p->at++;
    skip_spaces(p);
    const char *from = p->at;
    if (!sum(p, out)) {
        return false;
    }
    bool smallest = name_is(name, name_end, "min");
    if (smallest || name_is(name, name_end, "max")) {
        return choice(p, smallest ? -1 : 1, name, name_end, out) && close_bracket(p, open);
    }
    struct error e;
    if (quantity_function(&p->deck->units, name, (size_t)(name_end - name), out, &e) != STATUS_OK) {
        return deck_report_false(p->deck, p->word, from, p->at, "%s", e.message);
    }
    if (next(p) == ',') {
        return deck_report_false(p->deck, p->word, p->at, p->at + 1,
                                 "this function takes one value");
    }
    return close_bracket(p, open);
}

static bool name_or_call(struct parser *p, struct quantity *out) {
    const char *name = p->at, *end = parameter_name_end(name);
    p->at = end;
    if (next(p) == '(') {
        return call(p, name, end, out);
    }
    p->at = end;
    if (name_is(name, end, "pi")) {
        *out = (struct quantity){.value = 3.14159265358979323846};
        return true;
    }
    if (quantity_is_reserved(name, (size_t)(end - name))) {
        return deck_report_false(p->deck, p->word, name, end, "a '(' must follow a function");
    }
    if (!parameter_find(p->deck, name, (size_t)(end - name)) &&
        quantity_is_unit(p->deck, name, (size_t)(end - name))) {
        return deck_report_false(p->deck, p->word, name, end,
                                 "unknown parameter '%.*s'; write 1%.*s if the unit is meant",
                                 (int)(end - name), name, (int)(end - name), name);
    }
    return parameter_number(p->deck, p->word, name, end, out);
}

static bool unexpected(struct parser *p) {
    if (next(p) == 0) {
        return deck_report_false(p->deck, p->word, p->end, p->end,
                                 "the expression is not complete");
    }
    size_t bytes = text_character(p->at, (size_t)(p->end - p->at));
    struct word part = deck_report_part(p->deck, p->word, p->at, p->at + (bytes ? bytes : 1));
    struct text_short t;
    const char before = p->at > p->word->text ? p->at[-1] : '\0';
    const char *hint = before == '*' && *p->at == '*' ? "; a power is written ^"
                       : before == ' ' && isalpha((unsigned char)*p->at)
                           ? "; write a unit directly after its number"
                           : "";
    return deck_error(p->deck, &part, "unexpected '%s'%s", text_short(&t, part.text), hint);
}

static bool primary(struct parser *p, struct quantity *out) {
    char c = next(p);
    if ((c >= '0' && c <= '9') || (c == '.' && p->at[1] >= '0' && p->at[1] <= '9')) {
        return quantity_read(p->deck, p->word, &p->at, out);
    }
    if (c == '(') {
        const char *open = p->at++;
        return sum(p, out) && close_bracket(p, open);
    }
    if (c == '$' && parameter_name_end(p->at + 1) > p->at + 1) {
        const char *name = p->at + 1;
        p->at = parameter_name_end(name);
        return parameter_number(p->deck, p->word, name, p->at, out);
    }
    if (parameter_name_end(p->at) > p->at) {
        return name_or_call(p, out);
    }
    return unexpected(p);
}

// Sets *a to *a op *b. An error points at the operator, or at the divisor for a division by zero.
static bool combine(struct parser *p, const char *op, struct quantity *a,
                    const struct quantity *b) {
    struct error e;
    if (quantity_combine(&p->deck->units, *op, a, b, &e) == STATUS_OK) {
        return true;
    }
    const char *from = op, *to = op + 1;
    if (*op == '/' && b->value == 0) {
        from = op + 1 + strspn(op + 1, " \t");
        to = p->at;
    }
    return deck_report_false(p->deck, p->word, from, to, "%s", e.message);
}

static bool sign(struct parser *p, struct quantity *out);

static bool power(struct parser *p, struct quantity *out) {
    if (!primary(p, out)) {
        return false;
    }
    if (next(p) != '^') {
        return true;
    }
    const char *op = p->at++;
    struct quantity exponent = {0};
    return sign(p, &exponent) && combine(p, op, out, &exponent);
}

static bool sign(struct parser *p, struct quantity *out) {
    char c = next(p);
    if (p->depth == DEPTH_MAX) {
        return deck_report_false(p->deck, p->word, p->at, p->at + (c != 0),
                                 "more than %d levels of brackets, signs and powers", DEPTH_MAX);
    }
    p->depth++;
    bool ok;
    if (c == '-' || c == '+') {
        p->at++;
        ok = sign(p, out);
        if (ok && c == '-') {
            out->value = -out->value;
        }
    } else {
        ok = power(p, out);
    }
    p->depth--;
    return ok;
}

static bool product(struct parser *p, struct quantity *out) {
    bool ok = sign(p, out);
    while (ok && (next(p) == '*' || *p->at == '/') && p->at < p->end) {
        const char *op = p->at++;
        struct quantity other;
        ok = sign(p, &other) && combine(p, op, out, &other);
    }
    return ok;
}

static bool sum(struct parser *p, struct quantity *out) {
    *out = (struct quantity){0};
    bool ok = product(p, out);
    while (ok && (next(p) == '+' || *p->at == '-') && p->at < p->end) {
        const char *op = p->at++;
        struct quantity other = {0};
        ok = product(p, &other) && combine(p, op, out, &other);
    }
    return ok;
}

bool expression_evaluate(struct deck *d, const struct word *w, const char *from, const char *to,
                         struct quantity *out) {
    struct parser p = {.deck = d, .word = w, .at = from, .end = to};
    if (!sum(&p, out)) {
        return false;
    }
    return next(&p) == 0 || unexpected(&p);
}

// Reads the $name or ${expression} at *at, and moves *at past it.
static bool dollar(struct deck *d, const struct word *w, const char **at, struct quantity *out) {
    const char *from = *at + 1;
    if (*from == '{') {
        const char *close = strchr(from, '}');
        if (!close) {
            return deck_report_false(d, w, *at, from + 1, "the '}' to this '${' is missing");
        }
        *at = close + 1;
        return expression_evaluate(d, w, from + 1, close, out);
    }
    const char *to = parameter_name_end(from);
    if (to == from) {
        return deck_report_false(d, w, *at, from, "a name or '{' must follow '$'");
    }
    *at = to;
    return parameter_number(d, w, from, to, out);
}

bool expression_number(struct deck *d, const struct word *w, const char *from,
                       struct quantity *out) {
    const char *at = from;
    bool negative = *at == '-';
    const char *unsigned_part = at + (*at == '-' || *at == '+');
    bool ok;
    if (*unsigned_part == '$') {
        at = unsigned_part;
        ok = dollar(d, w, &at, out);
        out->value = ok && negative ? -out->value : out->value;
    } else {
        ok = quantity_read(d, w, &at, out);
    }
    return ok && (*at == 0 || quantity_end(d, w, at, out));
}
