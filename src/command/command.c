// SPDX-License-Identifier: GPL-3.0-or-later
// The list of commands, and what they have in common: messages, help, exit status.
#include "command/command.h"

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
    char list[1024];
    const char *near = text_nearest(word, known, n);
    if (near) {
        return command_usage(c, "unknown %s '%s'; did you mean '%s'?", what, word, near);
    }
    return n > TEXT_LISTED_MAX ? command_usage(c, "unknown %s '%s'", what, word)
                               : command_usage(c, "unknown %s '%s'; available: %s", what, word,
                                               text_list(list, sizeof list, known, n));
}

const char *command_line(struct arena *a, int argc, char **argv) {
    const char *line = "jostle";
    for (int i = 0; i < argc && line; i++) {
        line = arena_format(a, "%s %s", line, argv[i]);
    }
    return line;
}
