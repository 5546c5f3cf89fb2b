// SPDX-License-Identifier: GPL-3.0-or-later
// The list of commands, and what they have in common: messages, help, exit status.
#include "command/command.h"

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

int command_usage(const struct command *c, const char *format, ...) {
    fprintf(stderr, "jostle %s: %s ", c->name, error_word());
    va_list list;
    va_start(list, format);
    vfprintf(stderr, format, list);
    va_end(list);
    fprintf(stderr, "\ntry 'jostle %s --help'\n", c->name);
    return EXIT_INPUT;
}

int command_unknown(const struct command *c, const char *what, const char *word,
                    const char *const *known, int n) {
    const char *near = text_nearest(word, known, n);
    return near ? command_usage(c, "unknown %s '%s'; did you mean '%s'?", what, word, near)
                : command_usage(c, "unknown %s '%s'", what, word);
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

int command_once(const struct command *c, const char *option, const char **text) {
    if (*text) {
        return command_usage(c, "%s is given twice", option);
    }
    *text = optarg;
    return EXIT_DONE;
}

const char *command_line(struct arena *a, int argc, char **argv) {
    const char *line = "jostle";
    for (int i = 0; i < argc && line; i++) {
        line = arena_format(a, "%s %s", line, argv[i]);
    }
    return line;
}

// Says what getopt_long found wrong: '?' or ':'.
static int refuse(const struct command *c, int answer, char **argv) {
    // getopt_long leaves the letter in optopt; for a long option the word is the one before optind.
    // That may also be the option before a letter that others follow in its word (--force -zq).
    // With getopt_long_only a long option may have one dash; its value is above all letters.
    const char *word = optind > 1 ? argv[optind - 1] : "";
    const bool is_long = word[0] == '-' && word[1] == '-' && (answer == ':' || strchr(word, '='));
    const char letter[] = {'-', (char)optopt, '\0'};
    const char *shown = is_long || optopt == 0 || optopt > UCHAR_MAX ? word : letter;
    return command_usage(
        c, answer == ':' ? "option '%s' needs a value" : "unknown or ambiguous option '%s'", shown);
}

int command_parse(const struct command_options *o, int argc, char **argv, void *request) {
    opterr = 0;
    optind = 1;
    for (int letter; (letter = o->next(argc, argv, o->letters, o->option, NULL)) != -1;) {
        if (letter == 'h') {
            command_help(o->command, o->details);
            if (o->print_details) {
                o->print_details();
            }
            return EXIT_DONE;
        }
        const int status = letter == '?' || letter == ':' ? refuse(o->command, letter, argv)
                                                          : o->take(request, letter);
        if (status != EXIT_DONE) {
            return status;
        }
    }
    return GO_ON;
}
