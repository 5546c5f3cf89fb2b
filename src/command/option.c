// SPDX-License-Identifier: GPL-3.0-or-later
#include "command/option.h"

#include <assert.h>
#include <errno.h>
#include <getopt.h>
#include <limits.h>
#include <stdlib.h>
#include <string.h>

#include "core/arena.h"
#include "core/text.h"

// Tags of the help up to this width share their line with the text; lines end before the other.
enum { TAG_MAX = 18, HELP_WIDTH = 95 };

// Answers of getopt_long for long names, above all letters: this and the number of the row.
enum { ROWS_MAX = 40, LONG_FIRST = UCHAR_MAX + 1 };

const struct option_row option_help[] = {
    {"help", 'h', NULL, OPTION_HELP, OPTION_NAME_ONLY, .doc = "this text"}, {0}};

struct scan {
    const struct option_list *list;
    void *request;
    struct arena *arena;
    int argc;
    int n;
    const struct option_row *row[ROWS_MAX];    // (n)
    const struct option_part *part[ROWS_MAX];  // (n) that they are of
    bool given[ROWS_MAX];                      // (n)
    struct option option[ROWS_MAX + 1];        // of getopt_long
    char letters[2 * ROWS_MAX + 3];            // likewise
};

// --- the help ------------------------------------------------------------------------------------

// "-o, --output FILE"; returns its width.
static int tag(const struct option_row *r, char *text, size_t size) {
    const bool letter = r->letter && !(r->flags & OPTION_NAME_ONLY);
    const bool name = !(r->flags & OPTION_LETTER_ONLY);
    return snprintf(text, size, "%s%.*s%s%s%s%s%s", letter ? "-" : "", letter, &r->letter,
                    letter && name ? ", " : "", name ? "--" : "", name ? r->name : "",
                    r->value ? " " : "", r->value ? r->value : "");
}

void option_wrap(const char *text, int column, int width) {
    int at = column;
    for (const char *word = text; *word; word += strspn(word, " ")) {
        const size_t n = strcspn(word, " ");
        const int wide = text_columns(word, n);
        if (at > column && at + 1 + wide > width) {
            printf("\n%*s", column, "");
            at = column;
        }
        at += printf(at > column ? " " : "") + wide;
        printf("%.*s", (int)n, word);
        word += n;
    }
    printf("\n");
}

static void print_rows(const struct option_row *row, int column) {
    char text[64];
    for (const struct option_row *r = row; r->doc; r++) {
        if (tag(r, text, sizeof text) > TAG_MAX) {
            printf("  %s\n%*s", text, column, "");
        } else {
            printf("  %-*s", column - 2, text);
        }
        option_wrap(r->doc, column, HELP_WIDTH);
    }
}

static void print_help(const struct scan *s) {
    const struct command *c = s->list->command;
    char text[64];
    int column = 0;
    for (int i = 0; i < s->n; i++) {
        const int n = tag(s->row[i], text, sizeof text);
        column = n > column && n <= TAG_MAX ? n : column;
    }
    printf("usage: jostle %s %s\n\n%s\n\n", c->name, c->usage, c->summary);
    for (const struct option_part *p = s->list->part; p->row || p->text || p->print; p++) {
        if (p->row) {
            print_rows(p->row, column + 4);
        } else if (p->print) {
            p->print();
        } else {
            fputs(p->text, stdout);
        }
    }
}

// --- what is wrong -------------------------------------------------------------------------------

// Is the word, "--force" or "--force=yes", the whole name?
static bool is_whole(const char *word, const char *name) {
    const char *own = word + strspn(word, "-");
    const size_t n = strcspn(own, "=");
    return n == strlen(name) && strncmp(own, name, n) == 0;
}

static bool is_long(const char *word) {
    return word[0] == '-' && word[1] != '\0' && word[2] != '\0';
}

static int find_letter(const struct scan *s, int letter) {
    for (int i = 0; i < s->n; i++) {
        if (letter && s->row[i]->letter == letter) {
            return i;
        }
    }
    return -1;
}

// Is the word an option, as in `-o --force`, where the value of -o is missing?
static bool is_option(const struct scan *s, const char *word) {
    if (word[0] == '-' && !is_long(word)) {
        return find_letter(s, word[1]) >= 0;
    }
    for (int i = 0; i < s->n && is_long(word); i++) {
        if (is_whole(word, s->row[i]->name)) {
            return true;
        }
    }
    return false;
}

static int refuse_word(const struct scan *s, const char *word) {
    const struct command *c = s->list->command;
    const char *known[ROWS_MAX];
    char name[64];
    for (int i = 0; i < s->n; i++) {
        known[i] = s->row[i]->name;
        if (is_long(word) && is_whole(word, known[i])) {
            return command_usage(c, "option '%s' takes no value", word);
        }
    }
    const char *own = word + strspn(word, "-");
    snprintf(name, sizeof name, "%.*s", (int)strcspn(own, "="), own);
    const char *near = is_long(word) ? text_nearest(name, known, s->n) : NULL;
    return near ? command_usage(c, "unknown option '%s'; did you mean '--%s'?", word, near)
                : command_usage(c, "unknown option '%s'", word);
}

static size_t place_of(const struct scan *s, int row) {
    return s->part[row]->at + s->row[row]->at;
}

static bool share_place(const struct scan *s, int i, int k) {
    return i == k || (s->row[i]->kind == s->row[k]->kind && place_of(s, i) == place_of(s, k));
}

// Options without a value that set one thing to different values. A flag says the same as often as
// it is given.
static int check_flag(const struct scan *s, int now) {
    for (int i = 0; i < s->n; i++) {
        if (s->given[i] && share_place(s, i, now) && s->row[i]->set != s->row[now]->set) {
            return command_usage(s->list->command, "--%s and --%s exclude each other",
                                 s->row[i < now ? i : now]->name, s->row[i < now ? now : i]->name);
        }
    }
    return EXIT_DONE;
}

// "-o or --output is given twice".
static int check_once(const struct scan *s, int now) {
    const bool text = s->row[now]->kind == OPTION_TEXT;
    char names[128] = "";
    size_t n = 0;
    bool twice = false;
    for (int i = 0; i < s->n && n < sizeof names; i++) {
        const struct option_row *r = s->row[i];
        if (i == now || (text && share_place(s, i, now))) {
            twice = twice || s->given[i];
            const char letter[] = {'-', r->letter, '\0'};
            n += (size_t)snprintf(names + n, sizeof names - n, "%s%s%s--%s", n ? " or " : "",
                                  r->letter ? letter : "", r->letter ? " or " : "", r->name);
        }
    }
    return twice ? command_usage(s->list->command, "%s is given twice", names) : EXIT_DONE;
}

static int check_given(const struct scan *s, int now) {
    switch (s->row[now]->kind) {
        case OPTION_TRUE:
        case OPTION_WORDS:
            return EXIT_DONE;
        case OPTION_SET:
            return check_flag(s, now);
        default:
            return check_once(s, now);
    }
}

// --- values --------------------------------------------------------------------------------------

// How messages about its value call an option: "-j", "--rtol".
static const char *shown_name(const struct option_row *r, char *text, size_t size) {
    const bool letter = r->flags & OPTION_LETTER_ONLY;
    snprintf(text, size, letter ? "-%.1s" : "--%s", letter ? &r->letter : r->name);
    return text;
}

int option_whole(const struct command *c, const struct option_row *r, const char *text,
                 int *value) {
    char name[32], *end;
    errno = 0;
    const long n = strtol(text, &end, 10);
    if (errno || end == text || *end || (double)n < r->least || (double)n > r->most) {
        return command_usage(c, "%s takes %s from %.0f to %.0f, not '%s'",
                             shown_name(r, name, sizeof name), r->what ? r->what : "a whole number",
                             r->least, r->most, text);
    }
    *value = (int)n;
    return EXIT_DONE;
}

static int take_number(const struct command *c, const struct option_row *r, const char *text,
                       double *value) {
    char name[32], *end;
    errno = 0;
    *value = strtod(text, &end);
    return errno || end == text || *end || !(*value >= r->least && *value <= r->most)
               ? command_usage(c, "%s takes a number from %g to %g, not '%s'",
                               shown_name(r, name, sizeof name), r->least, r->most, text)
               : EXIT_DONE;
}

static int take_choice(const struct command *c, const struct option_row *r, const char *text,
                       int *value) {
    char list[64] = "";
    *value = 0;
    for (const char *word = r->value; *word; ++*value) {
        const size_t n = strcspn(word, "|"), used = strlen(list);
        if (n == strlen(text) && strncmp(word, text, n) == 0) {
            return EXIT_DONE;
        }
        snprintf(list + used, sizeof list - used, "%s%.*s", used ? " or " : "", (int)n, word);
        word += n + (word[n] == '|');
    }
    return command_usage(c, "--%s is %s, not '%s'", r->name, list, text);
}

static int take_word(struct scan *s, struct words *w, const char *text) {
    w->word = w->n ? w->word : arena_alloc(s->arena, (size_t)s->argc, sizeof *w->word);
    if (!w->word) {
        return command_no_memory();
    }
    w->word[w->n++] = text;
    return EXIT_DONE;
}

static int take(struct scan *s, int row, const char *text) {
    const struct command *c = s->list->command;
    const struct option_row *r = s->row[row];
    void *to = (char *)s->request + place_of(s, row);
    switch (r->kind) {
        case OPTION_TRUE:
            *(bool *)to = true;
            return EXIT_DONE;
        case OPTION_SET:
            *(int *)to = r->set;
            return EXIT_DONE;
        case OPTION_TEXT:
            *(const char **)to = text;
            return EXIT_DONE;
        case OPTION_WORDS:
            return take_word(s, to, text);
        case OPTION_WHOLE:
            return option_whole(c, r, text, to);
        case OPTION_NUMBER:
            return take_number(c, r, text, to);
        case OPTION_CHOICE:
            return take_choice(c, r, text, to);
        default:
            return r->own(s->request, s->arena, text);
    }
}

// --- the command line ----------------------------------------------------------------------------

// Reads the option that begins at optind, or goes on in the word there. GO_ON, or the exit status.
static int read_option(struct scan *s, char **argv) {
    const char *word = argv[optind];
    int at = -1;
    const int answer = (s->list->dash == DASH_ONE ? getopt_long_only : getopt_long)(
        s->argc, argv, s->letters, s->option, &at);
    // getopt_long also accepts the beginning of a name. jostle does not: a typing error may be the
    // beginning of another option, and a new option would change the meaning of a script.
    if (at >= 0 && !is_whole(word, s->row[at]->name)) {
        return refuse_word(s, word);
    }
    if (answer == '?' || answer == ':') {
        // '?': unknown option; ':': no value. A word may have several letters; optopt is the wrong
        // one.
        const char letter[] = {'-', (char)optopt, '\0'};
        const char *shown = optopt == 0 || optopt > UCHAR_MAX ? word : letter;
        return answer == ':' ? command_usage(s->list->command, "option '%s' needs a value", shown)
                             : refuse_word(s, shown);
    }
    at = at >= 0 ? at : find_letter(s, answer);
    assert(at >= 0);
    const struct option_row *r = s->row[at];
    if (r->kind == OPTION_HELP) {
        print_help(s);
        return EXIT_DONE;
    }
    if (r->value && optarg == argv[optind - 1] && is_option(s, optarg)) {
        return command_usage(s->list->command, "option '%s' needs a value; '%s' is an option", word,
                             optarg);
    }
    int status = check_given(s, at);
    s->given[at] = true;
    if (status == EXIT_DONE && s->part[at]->first) {
        const struct option_row **first =
            (const struct option_row **)(void *)((char *)s->request + s->part[at]->first);
        *first = *first ? *first : r;
    }
    status = status == EXIT_DONE ? take(s, at, optarg) : status;
    return status == EXIT_DONE ? GO_ON : status;
}

static bool is_operand(const struct scan *s, const char *word) {
    return word[0] != '-' || word[1] == '\0' ||
           (s->list->dash == DASH_LAW && word[1] != '-' && strcmp(word, "-h") != 0);
}

// Options and operands, mixed, up to "--". GO_ON, or the exit status.
static int read_words(struct scan *s, char **argv, struct words *operand) {
    int status = GO_ON;
    bool options = true;
    opterr = 0;
    optind = 1;
    while (optind < s->argc && status == GO_ON) {
        if (options && strcmp(argv[optind], "--") == 0) {
            options = false;
            optind++;
        } else if (!options || is_operand(s, argv[optind])) {
            operand->word[operand->n++] = argv[optind++];
        } else {
            status = read_option(s, argv);
        }
    }
    if (status == GO_ON && s->list->operand && operand->n != 1) {
        status = command_usage(s->list->command, "one %s is expected, not %d", s->list->operand,
                               operand->n);
    }
    return status;
}

int option_run(const struct option_list *l, int argc, char **argv, void *request) {
    struct scan s = {.list = l, .request = request, .arena = arena_create(), .argc = argc};
    struct words operand = {
        s.arena ? arena_alloc(s.arena, (size_t)argc, sizeof *operand.word) : NULL, 0};
    char *letter = s.letters;
    *letter++ = '+';  // operands are left to read_words
    *letter++ = ':';
    for (const struct option_part *p = s.list->part; p->row || p->text || p->print; p++) {
        for (const struct option_row *r = p->row; r && r->doc; r++) {
            assert(s.n < ROWS_MAX);
            s.row[s.n] = r;
            s.part[s.n] = p;
            s.option[s.n] = (struct option){r->name, r->value ? required_argument : no_argument,
                                            NULL, LONG_FIRST + s.n};
            s.n++;
            if (r->letter) {
                *letter++ = r->letter;
                *letter = ':';
                letter += r->value != NULL;
            }
        }
    }
    *letter = '\0';
    int status = operand.word ? read_words(&s, argv, &operand) : command_no_memory();
    if (status == GO_ON) {
        status = l->use(request, s.arena, &operand);
    }
    arena_free(s.arena);
    return status;
}
