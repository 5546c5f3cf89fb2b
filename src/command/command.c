// SPDX-License-Identifier: GPL-3.0-or-later
// The list of commands, and what they have in common: messages, help, exit status.
#include "command/command.h"

#include <assert.h>
#include <errno.h>
#include <limits.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "core/arena.h"
#include "core/text.h"

#define COMMAND(name) extern const struct command command_##name;
#include "command/command_list.inc"
#undef COMMAND

#define COMMAND(name) &command_##name,
const struct command *const commands[] = {
#include "command/command_list.inc"
};
#undef COMMAND
const int n_command = sizeof commands / sizeof commands[0];

bool command_colour(void) {
    const char *no_colour = getenv("NO_COLOR");
    return isatty(STDERR_FILENO) && !(no_colour && no_colour[0]);
}

static const char *error_word(void) {
    return command_colour() ? "\033[1;31merror:\033[0m" : "error:";
}

int command_fail(const struct error *e) {
    fprintf(stderr, "jostle: %s %s\n", error_word(), e->message);
    switch (e->status) {
        case STATUS_INPUT:
            return EXIT_INPUT;
        case STATUS_SYSTEM:
            return EXIT_SYSTEM;
        default:
            return EXIT_FAILED;
    }
}

int command_no_memory(void) {
    struct error e;
    error_no_memory(&e);
    return command_fail(&e);
}

enum { MESSAGE_MAX = 1024 };

int command_usage(const struct command *c, const char *format, ...) {
    char message[MESSAGE_MAX];
    va_list list;
    va_start(list, format);
    text_compose(message, sizeof message, format, list);
    va_end(list);
    fprintf(stderr, "jostle %s: %s %s\ntry 'jostle %s --help'\n", c->name, error_word(), message,
            c->name);
    return EXIT_INPUT;
}

int command_unknown(const struct command *c, const char *what, const char *word,
                    const char *const *known, int n) {
    char list[512];
    const char *near = text_nearest(word, known, n);
    if (near) {
        return command_usage(c, "unknown %s '%s'; did you mean '%s'?", what, word, near);
    }
    return n > TEXT_LISTED_MAX ? command_usage(c, "unknown %s '%s'", what, word)
                               : command_usage(c, "unknown %s '%s'; available: %s", what, word,
                                               text_list(list, sizeof list, known, n));
}

int command_help(const struct command *c, const char *details) {
    printf("usage: jostle %s %s\n\n%s\n\n%s", c->name, c->usage, c->summary, details);
    return EXIT_DONE;
}

int command_count(const struct command *c, const char *what, const char *text, long max,
                  long *value) {
    char *end;
    errno = 0;
    long n = strtol(text, &end, 10);
    if (errno || end == text || *end || n < 1 || n > max) {
        return command_usage(c, "%s from 1 to %ld, not '%s'", what, max, text);
    }
    *value = n;
    return EXIT_DONE;
}

const char *command_line(struct arena *a, int argc, char **argv) {
    const char *line = "jostle";
    for (int i = 0; i < argc && line; i++) {
        line = arena_format(a, "%s %s", line, argv[i]);
    }
    return line;
}

enum { OPTIONS_MAX = 64 };

static bool is_long(const char *word) {
    return word[0] == '-' && word[1] != '\0' && word[2] != '\0';
}

// Is `word`, "--force" or "--force=yes", the whole name?
static bool is_whole(const char *word, const char *name) {
    const char *own = word + strspn(word, "-");
    const size_t n = strcspn(own, "=");
    return n == strlen(name) && strncmp(own, name, n) == 0;
}

static int refuse_word(const struct command_options *o, const char *word) {
    const char *known[OPTIONS_MAX];
    char name[64];
    int n = 0;
    for (const struct option *p = o->option; is_long(word) && p->name && n < OPTIONS_MAX; p++) {
        if (is_whole(word, p->name)) {
            return command_usage(o->command, "option '%s' takes no value", word);
        }
        known[n++] = p->name;
    }
    const char *own = word + strspn(word, "-");
    snprintf(name, sizeof name, "%.*s", (int)strcspn(own, "="), own);
    const char *near = text_nearest(name, known, n);
    return near ? command_usage(o->command, "unknown option '%s'; did you mean '--%s'?", word, near)
                : command_usage(o->command, "unknown option '%s'", word);
}

// Is it one of the options, as in `-o --force`, where a value is forgotten?
static bool is_option(const struct command_options *o, const char *word) {
    if (word[0] != '-' || word[1] == '\0') {
        return false;
    }
    if (word[2] == '\0') {
        return word[1] != ':' && strchr(o->letters, word[1]);
    }
    for (const struct option *p = o->option; is_long(word) && p->name; p++) {
        if (is_whole(word, p->name)) {
            return true;
        }
    }
    return false;
}

// Says what getopt_long found wrong: '?' or ':'.
static int refuse(const struct command_options *o, int answer, char **argv) {
    // getopt_long leaves the letter in optopt; for a long option the word is the one before optind.
    // That may also be the option before a letter that others follow in its word (--force -zq).
    // With getopt_long_only a long option may have one dash; its value is above all letters.
    const char *word = optind > 1 ? argv[optind - 1] : "";
    const bool dashes = word[0] == '-' && word[1] == '-' && (answer == ':' || strchr(word, '='));
    const char letter[] = {'-', (char)optopt, '\0'};
    const char *shown = dashes || optopt == 0 || optopt > UCHAR_MAX ? word : letter;
    return answer == ':' ? command_usage(o->command, "option '%s' needs a value", shown)
                         : refuse_word(o, shown);
}

// The word by which getopt_long found a long option: the one before optind, or before its value.
static const char *taken_word(char **argv) {
    return argv[optarg && optarg == argv[optind - 1] ? optind - 2 : optind - 1];
}

// The place of the first long option of this letter.
static int place_of(const struct command_options *o, int letter) {
    int i = 0;
    while (o->option[i].val != letter) {
        assert(o->option[i].name && i + 1 < OPTIONS_MAX);
        i++;
    }
    return i;
}

// May it stand only once? A flag says the same as often as it is given.
static bool stands_once(const struct command_options *o, const struct option *option) {
    return option->has_arg != no_argument &&
           !(o->repeatable && strcmp(o->repeatable, option->name) == 0);
}

// "-o or --output is given twice".
static int refuse_twice(const struct command_options *o, int letter) {
    char names[128] = "";
    size_t n = 0;
    if (letter <= UCHAR_MAX && strchr(o->letters, letter)) {
        n = (size_t)snprintf(names, sizeof names, "-%c", letter);
    }
    for (const struct option *p = o->option; p->name && n < sizeof names; p++) {
        if (p->val == letter) {
            n += (size_t)snprintf(names + n, sizeof names - n, "%s--%s", n ? " or " : "", p->name);
        }
    }
    return command_usage(o->command, "%s is given twice", names);
}

int command_parse(const struct command_options *o, int argc, char **argv, void *request) {
    bool given[OPTIONS_MAX] = {false};
    opterr = 0;
    optind = 1;
    // getopt_long takes the beginning of a name, too. A slip may be that of another option, and a
    // script breaks by an option to come.
    for (int index = -1, letter;
         (letter = o->next(argc, argv, o->letters, o->option, &index)) != -1; index = -1) {
        if (index >= 0 && !is_whole(taken_word(argv), o->option[index].name)) {
            return refuse_word(o, taken_word(argv));
        }
        if (letter == 'h') {
            command_help(o->command, o->details);
            if (o->print_details) {
                o->print_details();
            }
            return EXIT_DONE;
        }
        if (letter == '?' || letter == ':') {
            return refuse(o, letter, argv);
        }
        if (optarg && optarg == argv[optind - 1] && is_option(o, optarg)) {
            return command_usage(o->command, "option '%s' needs a value; '%s' is an option",
                                 taken_word(argv), optarg);
        }
        const int place = place_of(o, letter);
        if (given[place] && stands_once(o, &o->option[place])) {
            return refuse_twice(o, letter);
        }
        given[place] = true;
        const int status = o->take(request, letter);
        if (status != EXIT_DONE) {
            return status;
        }
    }
    return GO_ON;
}
