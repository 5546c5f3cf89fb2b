// SPDX-License-Identifier: GPL-3.0-or-later
// Lines, fields and numbers of a record file, and messages that point into it.
#include "motion/lines.h"

#include <assert.h>
#include <stdarg.h>
#include <string.h>

#include "core/text.h"
#include "motion/record_format.h"

// True for a space, tab, line feed, vertical tab, form feed and carriage return. The first test is
// fast, because most characters are none of these.
static bool is_blank(char c) {
    return (unsigned char)c <= ' ' && (c == ' ' || (c >= '\t' && c <= '\r'));
}

static bool is_digit(char c) {
    return c >= '0' && c <= '9';
}

static char upper(char c) {
    return c >= 'a' && c <= 'z' ? (char)(c - 'a' + 'A') : c;
}

static bool is_word(char c) {
    return is_digit(c) || (upper(c) >= 'A' && upper(c) <= 'Z') || c == '_';
}

struct piece lines_trim(struct piece s) {
    while (s.n > 0 && is_blank(s.text[0])) {
        s.text++;
        s.n--;
    }
    while (s.n > 0 && is_blank(s.text[s.n - 1])) {
        s.n--;
    }
    return s;
}

void lines_init(struct lines *l, const struct record_text *t) {
    bool has_newline = t->size > 0 && memchr(t->text, '\n', t->size);
    *l = (struct lines){
        .at = t->text,
        .end = t->text + t->size,
        .terminator = has_newline ? '\n' : '\r',
        .line = {.text = t->text},
    };
}

bool lines_next(struct lines *l) {
    if (l->at == l->end) {
        return false;
    }
    const char *stop = memchr(l->at, l->terminator, (size_t)(l->end - l->at));
    const char *line_end = stop ? stop : l->end;
    l->whole = (struct piece){l->at, (size_t)(line_end - l->at)};
    l->line = lines_trim(l->whole);
    l->at = stop ? stop + 1 : l->end;
    l->number++;
    return true;
}

struct lines lines_at(struct lines from, int number) {
    for (int i = 1; i < number && lines_next(&from); i++) {
    }
    return from;
}

static bool is_separator(char c, const char *separators) {
    while (*separators != '\0' && *separators != c) {
        separators++;
    }
    return *separators != '\0';
}

// The end of the spaces at `at`.
static const char *skip_blanks(const char *at, const char *end) {
    while (at < end && is_blank(*at)) {
        at++;
    }
    return at;
}

bool lines_field(struct piece *rest, const char *separators, struct piece *field) {
    assert(rest && separators && field);
    if (rest->n == 0) {
        *field = *rest;  // an empty field
        return false;
    }
    const char *end = rest->text + rest->n;
    const char *start = skip_blanks(rest->text, end);
    const char *at = start;
    while (at < end && !is_blank(*at) && !is_separator(*at, separators)) {
        at++;
    }
    *field = (struct piece){start, (size_t)(at - start)};
    at = skip_blanks(at, end);
    at += at < end && is_separator(*at, separators);
    *rest = (struct piece){at, (size_t)(end - at)};
    return start < end;
}

size_t lines_count(struct piece line, const char *separators) {
    size_t n = 0;
    struct piece field;
    while (lines_field(&line, separators, &field)) {
        n++;
    }
    return n;
}

static bool is_overflow(struct piece field) {
    bool stars = false;
    for (size_t i = 0; i < field.n; i++) {
        if (field.text[i] == '\0' || !strchr("*+-.0123456789EeDd", field.text[i])) {
            return false;
        }
        stars |= i > 0 && field.text[i] == '*' && field.text[i - 1] == '*';
    }
    return stars;
}

bool lines_overflow(struct piece line) {
    bool found = false;
    struct piece field;
    while (lines_field(&line, ",;", &field)) {
        const bool stars = is_overflow(field);
        if (!stars && !lines_number_like(field)) {
            return false;
        }
        found |= stars;
    }
    return found;
}

// The first single # before a space, or the end of the line. #N/A and #### are not comments:
// spreadsheets write them for values that they cannot show.
static const char *comment_mark(struct piece line) {
    const char *end = line.text + line.n;
    const char *mark = memchr(line.text, '#', line.n);
    while (mark && ((mark + 1 < end && !is_blank(mark[1])) || mark[-1] == '#')) {
        mark = memchr(mark + 1, '#', (size_t)(end - mark) - 1);
    }
    return mark ? mark : end;
}

struct piece lines_without_comment(struct piece line) {
    bool slashes = line.n > 1 && line.text[0] == '/' && line.text[1] == '/';
    if (line.n == 0 || slashes || strchr("#%!", line.text[0]) ||
        (line.text[0] == '*' && !lines_overflow(line))) {
        return (struct piece){line.text, 0};
    }
    return lines_trim((struct piece){line.text, (size_t)(comment_mark(line) - line.text)});
}

static const char *find(struct piece line, const char *text, size_t from) {
    size_t n = strlen(text);
    for (size_t i = from; i + n <= line.n; i++) {
        size_t k = 0;
        while (k < n && upper(line.text[i + k]) == text[k]) {
            k++;
        }
        if (k == n) {
            return line.text + i;
        }
    }
    return NULL;
}

const char *lines_word(struct piece line, const char *word) {
    assert(word && word[0]);
    size_t n = strlen(word);
    const char *end = line.text + line.n;
    const char *at = find(line, word, 0);
    while (at && ((at > line.text && is_word(at[-1])) || (at + n < end && is_word(at[n])))) {
        at = find(line, word, (size_t)(at - line.text) + 1);
    }
    return at;
}

struct piece lines_behind(struct piece line, const char *word) {
    const char *at = lines_word(line, word);
    if (!at) {
        return (struct piece){line.text, 0};
    }
    at += strlen(word);
    return (struct piece){at, (size_t)(line.text + line.n - at)};
}

bool lines_value(struct piece line, const char *word, struct piece *value) {
    struct piece rest = lines_behind(line, word);
    struct piece mark;
    if (!lines_field(&rest, "=", &mark) || mark.n > 0) {
        return false;
    }
    lines_field(&rest, ",", value);
    return true;
}

bool lines_contain(struct piece line, const char *text) {
    return find(line, text, 0) != NULL;
}

static enum number read_plain(const char *text, size_t n, double *value) {
    const char *end = text;
    enum text_number how = text_number(text, &end, value);
    if (how == TEXT_NUMBER_NONE || end != text + n) {
        return NUMBER_BAD;
    }
    return how == TEXT_NUMBER_RANGE ? NUMBER_RANGE : NUMBER_OK;
}

// Position of the exponent in a Fortran number: at its D, or at the sign of a three-digit exponent
// without a letter. n: there is no exponent.
static size_t fortran_exponent(struct piece s) {
    for (size_t i = 1; i < s.n; i++) {
        if (upper(s.text[i]) == 'D') {
            return i;
        }
        bool is_sign = s.text[i] == '+' || s.text[i] == '-';
        if (is_sign && (is_digit(s.text[i - 1]) || s.text[i - 1] == '.') && s.n - i == 4) {
            return i;
        }
    }
    return s.n;
}

enum number lines_number(struct piece field, double *value) {
    assert(value);
    enum { LONGEST = 60 };
    if (field.n == 0) {
        return NUMBER_BAD;
    }
    enum number how = read_plain(field.text, field.n, value);
    if (how != NUMBER_BAD || field.n > LONGEST) {
        return how;
    }
    // If fields of a fixed width touch, read_plain has read characters of the next field, too.
    char copy[LONGEST + 2];
    size_t at = fortran_exponent(field);
    if (at == field.n) {
        memcpy(copy, field.text, field.n);
        copy[field.n] = '\0';
        return read_plain(copy, field.n, value);
    }
    size_t skipped = upper(field.text[at]) == 'D' ? at + 1 : at;
    memcpy(copy, field.text, at);
    copy[at] = 'E';
    memcpy(copy + at + 1, field.text + skipped, field.n - skipped);
    size_t n = at + 1 + field.n - skipped;
    copy[n] = '\0';
    return read_plain(copy, n, value);
}

bool lines_number_like(struct piece field) {
    static const char *const words[] = {"NAN", "INF", "INFINITY"};
    if (field.n > 0 && (field.text[0] == '+' || field.text[0] == '-')) {
        field.text++;
        field.n--;
    }
    for (size_t i = 0; i < sizeof words / sizeof words[0]; i++) {
        if (field.n == strlen(words[i]) && lines_contain(field, words[i])) {
            return true;
        }
    }
    if (field.n > 1 && field.text[0] == '.') {
        return is_word(field.text[1]);
    }
    return field.n > 0 && is_digit(field.text[0]);
}

struct excerpt lines_excerpt(struct piece field) {
    enum { SHOWN = 40 };
    struct excerpt e;
    const bool cut = field.n > SHOWN;
    text_clean(e.text, sizeof e.text - 3, field.text, cut ? text_cut(field.text, SHOWN) : field.n);
    if (cut) {
        memcpy(e.text + strlen(e.text), "...", sizeof "...");
    }
    return e;
}

struct line_place lines_place(const char *path, int line) {
    enum { SHOWN = 200 };
    size_t n = strlen(path);
    const char *from = n > SHOWN ? path + n - SHOWN : path;
    while (((unsigned char)*from & 0xc0) == 0x80) {
        from++;
    }
    struct line_place p;
    int used = snprintf(p.text, sizeof p.text, "%s%s", n > SHOWN ? "..." : "", from);
    if (line > 0) {
        snprintf(p.text + used, sizeof p.text - (size_t)used, ":%d", line);
    }
    return p;
}

struct line_place lines_place_field(const struct record_text *t, int line, struct piece field) {
    const char *start = field.text;
    while (start > t->text && start[-1] != '\n' && start[-1] != '\r') {
        start--;
    }
    struct line_place p = lines_place(t->path, line);
    const size_t used = strlen(p.text);
    snprintf(p.text + used, sizeof p.text - used, ":%d",
             text_columns(start, (size_t)(field.text - start)) + 1);
    return p;
}

int lines_error(struct error *e, const char *path, int line, const char *format, ...) {
    assert(path && line >= 0 && format);
    char cause[sizeof e->message];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(cause, sizeof cause, format, arguments);
    va_end(arguments);
    return error_set(e, STATUS_INPUT, "%s: %s", lines_place(path, line).text, cause);
}

int lines_overflow_error(struct error *e, const struct record_text *t, int line, const char *what,
                         struct piece stars, const char *where) {
    return error_set(
        e, STATUS_INPUT, "%s: %s'%s'%s is an overflow of Fortran: the value did not fit its field",
        lines_place_field(t, line, stars).text, what, lines_excerpt(stars).text, where);
}

int lines_read_number(const struct number_field *f, double *value, struct error *e) {
    enum number how = lines_number(f->field, value);
    if (how == NUMBER_OK) {
        return STATUS_OK;
    }
    const char *path = f->text->path;
    if (f->field.n == 0) {
        return lines_error(e, path, f->line, "%s %zu is empty", f->what, f->index);
    }
    if (is_overflow(f->field)) {
        char what[64];
        snprintf(what, sizeof what, "%s %zu ", f->what, f->index);
        return lines_overflow_error(e, f->text, f->line, what, f->field, "");
    }
    struct excerpt shown = lines_excerpt(f->field);
    static const char *const reasons[] = {
        [COMPOUND_ONE] = "is not a number",
        [COMPOUND_REPEATED] =
            "is a repeat count; only values that run on (-format series) have one",
        [COMPOUND_TOUCHING] = "are numbers that touch; put spaces between them, or read values "
                              "that run on with -format series",
        [COMPOUND_AMBIGUOUS] =
            "are numbers that touch and can be separated in two ways; put spaces "
            "between them",
        [COMPOUND_NO_LETTER] = "is not a number: an exponent without a letter has three digits; "
                               "write an E before its sign",
    };
    const char *reason = reasons[compound_of(f->field).kind];
    if (how == NUMBER_RANGE) {
        reason = "is out of range: over 1.8e308";
    } else if (memchr(f->field.text, ',', f->field.n)) {
        reason = "has a comma; numbers need a decimal point";
    }
    return lines_error(e, path, f->line, "%s %zu '%s' %s", f->what, f->index, shown.text, reason);
}

bool lines_bracket(struct piece *rest, struct piece *inside) {
    while (rest->n > 0 && rest->text[0] != '(' && rest->text[0] != '[') {
        rest->text++;
        rest->n--;
    }
    size_t n = 1;
    while (n < rest->n && rest->text[n] != ')' && rest->text[n] != ']') {
        n++;
    }
    if (n >= rest->n) {
        return false;
    }
    *inside = (struct piece){rest->text + 1, n - 1};
    rest->text += n + 1;
    rest->n -= n + 1;
    return true;
}
