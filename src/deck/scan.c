// SPDX-License-Identifier: GPL-3.0-or-later
// Characters -> words with positions.
//
// A statement is one line. A `\` as the very last character of a line joins the next line; the `\`
// separates words like a space. Spaces and tabs separate words. A `"` at the start of a word quotes
// it up to the next `"` on the same line. Inside quotes `\` is an ordinary character; there are no
// escapes. Between `${` and `}` spaces belong to the word. `#` starts a comment up to the end of
// the line; a `\` at the end of a comment joins nothing. A `#` in the name of a file must be
// quoted. Lines end with LF or CR LF. Other control characters and bytes that are not UTF-8 are
// errors, also in comments. Typographic quotation marks, dashes and spaces are errors outside
// quotes.
//
// A statement with a wrong line is left out, and reading goes on after it.
#include <stdlib.h>
#include <string.h>

#include "core/text.h"
#include "deck/reader.h"

struct scan {
    struct deck *deck;
    struct source *source;
    int line;
    const char *at, *end;       // the rest of the line, without its line feed
    int column;                 // column of `at`
    bool wrong;                 // an error was reported
    bool joined;                // the next line belongs to the statement
    bool stray;                 // a `\` before spaces or a comment: it was meant to join lines
    bool open_quote;            // a quoted text goes on in the next line, which is not scanned
    const struct sweep *known;  // the sweep of these lines in the first reading; NULL: none
};

// sweep NAME values FIRST: the words of a known sweep that are read again.
enum { KNOWN_WORDS = 4 };

static void fail(struct scan *s, int column, int width, const char *message) {
    struct word w = {
        .text = "",
        .place = {.source = s->source, .line = s->line, .column = column, .width = width}};
    deck_error(s->deck, &w, "%s", message);
    s->wrong = true;
}

static bool is_space(char c) {
    return c == ' ' || c == '\t';
}

static void advance(struct scan *s) {
    size_t bytes = text_character(s->at, (size_t)(s->end - s->at));
    s->at += bytes ? bytes : 1;
    s->column++;
}

static bool grow(struct reader *r) {
    int capacity = r->word_capacity ? 2 * r->word_capacity : 64;
    struct word *word = realloc(r->word, (size_t)capacity * sizeof *word);
    if (!word) {
        return false;
    }
    r->word = word;
    r->word_capacity = capacity;
    return true;
}

// Appends the word from `start` to s->at. Quotes are not part of the word.
static void add_word(struct scan *s, const char *start, int column, bool quoted) {
    struct reader *r = s->deck->reader;
    if (r->n_word == r->word_capacity && !grow(r)) {
        diagnostics_no_memory(&s->deck->diagnostics);
        s->wrong = true;
        return;
    }
    char *text = s->source->cell + (start - s->source->text);
    text[s->at - start] = 0;
    int quotes = quoted ? 1 : 0;
    r->word[r->n_word++] = (struct word){
        .text = text,
        .quoted = quoted,
        .place = {.source = s->source,
                  .line = s->line,
                  .column = column,
                  .width = s->column - column + quotes},
    };
}

static void scan_quoted(struct scan *s) {
    int column = s->column;
    advance(s);
    const char *start = s->at;
    while (s->at < s->end && *s->at != '"') {
        advance(s);
    }
    if (s->at == s->end) {
        s->open_quote = s->end[-1] == '\\';
        fail(
            s, column, 1,
            s->open_quote
                ? "the quoted text does not end on its line; '\\' does not join lines within quotes"
                : "the quoted text does not end on its line");
        return;
    }
    add_word(s, start, column, true);
    advance(s);
    const bool joins = s->at < s->end && *s->at == '\\' && s->at + 1 == s->end;
    if (s->at < s->end && !is_space(*s->at) && *s->at != '#' && !joins) {
        fail(s, s->column, 1, "a space must follow the closing quote");
    }
}

// Moves s->at past the } of the ${ at s->at.
static void scan_braces(struct scan *s) {
    int column = s->column;
    while (s->at < s->end && *s->at != '}') {
        advance(s);
    }
    if (s->at == s->end) {
        fail(s, column, 2, "the '}' to this '${' is missing on its line");
        return;
    }
    advance(s);
}

// Characters that word processors put in place of ordinary ones, with the message about them.
// Dashes and apostrophes are allowed inside a word, such as the name of a file. The others are
// allowed inside quotes only.
static const struct look_alike {
    const char *characters;
    bool inside;  // true: an error inside a word too
    const char *message;
} look_alikes[] = {
    {"\u00A0\u2002\u2003\u2009\u200B\u202F", true, "a typographic space; use an ordinary space"},
    {"\u2010\u2011\u2013\u2014\u2212", false,
     "a typographic dash; options and negative numbers start with '-'"},
    {"\u201C\u201D\u201E", true, "a typographic quotation mark; use \"...\""},
    {"\u2018\u2019'", false, "an apostrophe does not quote; use \"...\""},
};

// Error message for the character at s->at in a word that begins at `start`; NULL: it is valid.
static const char *find_look_alike(const struct scan *s, const char *start) {
    char c[5] = "";
    memcpy(c, s->at, text_character(s->at, (size_t)(s->end - s->at)));
    for (size_t i = 0; i < sizeof look_alikes / sizeof look_alikes[0]; i++) {
        const struct look_alike *l = &look_alikes[i];
        if ((l->inside || s->at == start) && strstr(l->characters, c)) {
            return l->message;
        }
    }
    return NULL;
}

static void scan_bare(struct scan *s) {
    const char *start = s->at;
    int column = s->column;
    while (s->at < s->end && !is_space(*s->at) && *s->at != '#' && !s->wrong) {
        const bool plain = (unsigned char)*s->at < 0x80 && *s->at != '\'';
        const char *message = plain ? NULL : find_look_alike(s, start);
        if (message) {
            fail(s, s->column, 1, message);
        } else if (*s->at == '"') {
            fail(s, s->column, 1, "a quote inside a word; put the whole word in quotes");
        } else if (*s->at == '$' && s->at + 1 < s->end && s->at[1] == '{') {
            scan_braces(s);
        } else if (*s->at == '\\' && s->at + 1 == s->end) {
            break;
        } else {
            advance(s);
        }
    }
    if (!s->wrong) {
        add_word(s, start, column, false);
    }
}

// True for a `\` before spaces or a comment: it was meant to join the next line, but does not.
static bool is_stray_join(const struct scan *s) {
    const char *p = s->at + 1;
    while (p < s->end && is_space(*p)) {
        p++;
    }
    return *s->at == '\\' && (p == s->end || (*p == '#' && p > s->at + 1));
}

static void scan_words(struct scan *s) {
    while (s->at < s->end && !s->wrong) {
        if (is_space(*s->at)) {
            advance(s);
        } else if (*s->at == '#' || (s->known && s->deck->reader->n_word == KNOWN_WORDS)) {
            return;
        } else if (*s->at == '\\' && s->at + 1 == s->end) {
            s->joined = true;
            return;
        } else if (is_stray_join(s)) {
            fail(s, s->column, 1, "'\\' joins lines only as the very last character");
            s->stray = true;
        } else if (*s->at == '"') {
            scan_quoted(s);
        } else {
            scan_bare(s);
        }
    }
}

// Reports the first character of the line that is not allowed.
static void check_characters(struct scan *s) {
    int column = 1;
    for (const char *p = s->at; p < s->end; column++) {
        size_t bytes = text_character(p, (size_t)(s->end - p));
        char message[64];
        if (bytes == 0) {
            snprintf(message, sizeof message, "byte 0x%02X is not UTF-8 text", (unsigned char)*p);
        } else if (*p != '\t' && text_is_control(p, bytes)) {
            unsigned code = (unsigned char)p[bytes - 1];
            snprintf(message, sizeof message, "control character U+%04X%s", code,
                     *p == '\r' ? "; lines end with LF or CR LF" : "");
        } else {
            p += bytes;
            continue;
        }
        fail(s, column, 1, message);
        return;
    }
}

// Scans the next line of the file.
static void scan_line(struct scan *s, struct frame *f) {
    const char *start = s->source->text + f->offset;
    const char *last = s->source->text + s->source->size;
    const char *feed = memchr(start, '\n', (size_t)(last - start));
    f->offset = (size_t)((feed ? feed + 1 : last) - s->source->text);
    s->line = f->line++;
    s->at = start;
    s->end = feed ? feed : last;
    s->end -= s->end > start && s->end[-1] == '\r';
    s->column = 1;
    s->joined = false;
    s->stray = false;
    bool was_wrong = s->wrong;
    s->wrong = false;
    if (!s->known) {
        check_characters(s);
    }
    if (s->open_quote) {
        s->wrong = true;
    } else {
        scan_words(s);
    }
    if (s->wrong) {  // the rest of the line was not read: guess where the statement ends
        s->joined = s->stray || (s->end > start && s->end[-1] == '\\');
    } else if (s->joined && f->offset == s->source->size) {
        fail(s, s->column, 1, "'\\' joins the next line, but there is none");
    }
    s->wrong = s->wrong || was_wrong;
}

bool deck_is_option(const struct word *w) {
    char letter = w->text[0] == '-' ? w->text[1] : 0;
    return !w->quoted && ((letter >= 'a' && letter <= 'z') || (letter >= 'A' && letter <= 'Z'));
}

// Copies the words read so far into a statement that starts at `start`; false after having reported
// an error.
static bool build(struct deck *d, const struct frame *start, const struct frame *end,
                  struct statement *out) {
    struct reader *r = d->reader;
    int n_plain = 0;
    while (n_plain < r->n_word && !deck_is_option(&r->word[n_plain])) {
        n_plain++;
    }
    if (n_plain == 0 || r->word[0].quoted) {
        return deck_error(d, &r->word[0], "a statement must start with its name");
    }
    struct word *word = deck_array(d, (size_t)r->n_word, sizeof *word);
    if (!word) {
        return false;
    }
    memcpy(word, r->word, (size_t)r->n_word * sizeof *word);
    *out = (struct statement){
        .word = word,
        .n_word = r->n_word,
        .n_plain = n_plain,
        .lines = {start->source->text + start->offset, end->offset - start->offset,
                  end->line - start->line},
    };
    return true;
}

static bool is_at(const struct deck_lines *lines, const struct frame *f) {
    const char *at = f->source->text + f->offset;
    const size_t n = lines->size, rest = f->source->size - f->offset;
    return lines->text && n <= rest && memcmp(lines->text, at, n) == 0 &&
           (at[n - 1] == '\n' || n == rest);
}

// The sweep that the first reading has found in the lines at `f`, if its values are the same here;
// NULL: none. If each run read its sweeps again, the time of a study would grow with the square of
// the number of values.
static const struct sweep *sweep_known(const struct deck *d, const struct frame *f) {
    const struct deck *first = d->reader->first_reading;
    const bool same = first && unit_system_equal(&first->units, &d->units);
    for (const struct sweep *s = same ? first->sweeps : NULL; s; s = s->next) {
        for (const struct sweep *p = s; p; p = p->along) {
            if (is_at(&p->lines, f)) {
                return p;
            }
        }
    }
    return NULL;
}

// Scans the lines of one statement.
static void scan_lines(struct scan *s, struct frame *f) {
    const struct frame start = *f;
    s->deck->reader->n_word = 0;
    s->wrong = false;
    s->open_quote = false;
    s->known = sweep_known(s->deck, f);
    do {
        scan_line(s, f);
    } while (s->joined && f->offset < f->source->size);
    if (s->known) {
        f->offset = start.offset + s->known->lines.size;
        f->line = start.line + s->known->lines.n_line;
    }
}

bool scan_statement(struct deck *d, struct frame *f, struct statement *out) {
    struct scan s = {.deck = d, .source = f->source};
    while (f->offset < f->source->size && !d->diagnostics.out_of_memory) {
        const struct frame start = *f;
        scan_lines(&s, f);
        if (!s.wrong && d->reader->n_word > 0 && build(d, &start, f, out)) {
            out->known = s.known;
            return true;
        }
        d->torn = d->torn || s.wrong || d->reader->n_word > 0;
    }
    return false;
}
