// SPDX-License-Identifier: GPL-3.0-or-later
// Dispatch and exit status, nothing else.
#include <errno.h>
#include <fcntl.h>
#include <gsl/gsl_errno.h>
#include <signal.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "command/command.h"
#include "command/crash.h"
#include "core/safe.h"
#include "core/text.h"

static void print_help(FILE *to) {
    fprintf(to, "usage: jostle COMMAND ...\n\n"
                "Simulates the earthquake pounding of multistorey buildings.\n\n");
    for (int i = 0; i < n_command; i++) {
        fprintf(to, "  %-12s %s\n", commands[i]->name, commands[i]->summary);
    }
    fprintf(
        to,
        "\n  --version prints the version; COMMAND --help or help COMMAND explains a command\n\n"
        "Exit status: 0 done, 1 the analysis failed, 2 wrong usage, deck or record,\n"
        "3 the system failed.\n");
}

static int unknown(const char *word) {
    enum { KNOWN_MAX = 64 };
    const char *known[KNOWN_MAX];
    int n = 0;
    for (; n < n_command && n < KNOWN_MAX; n++) {
        known[n] = commands[n]->name;
    }
    const char *near = text_nearest(word, known, n);
    safe_line(stderr, "jostle: error: unknown %s '%s'%s%s%s", word[0] == '-' ? "option" : "command",
              word, near ? "; did you mean '" : "", near ? near : "", near ? "'?" : "");
    fprintf(stderr, "try 'jostle --help'\n");
    return EXIT_INPUT;
}

static int dispatch_command(int argc, char **argv) {
    for (int i = 0; i < n_command; i++) {
        if (strcmp(argv[0], commands[i]->name) == 0) {
            return commands[i]->run(argc, argv);
        }
    }
    return unknown(argv[0]);
}

static bool asks_for_help(const char *word) {
    return strcmp(word, "--help") == 0 || strcmp(word, "-h") == 0 || strcmp(word, "help") == 0;
}

// `help`, alone, with a command or with itself.
static int help(int argc, char **argv) {
    static char option[] = "--help";
    if (argc == 1 || asks_for_help(argv[1])) {
        print_help(stdout);
        return EXIT_DONE;
    }
    return dispatch_command(2, (char *[]){argv[1], option, NULL});
}

static int dispatch(int argc, char **argv) {
    if (argc < 2) {
        print_help(stderr);
        return EXIT_INPUT;
    }
    const bool asks = asks_for_help(argv[1]);
    const bool version = strcmp(argv[1], "--version") == 0;
    if (argc > (asks ? 3 : 2) && (asks || version)) {
        safe_line(stderr, "jostle: error: '%s' is not expected after %s", argv[argc - 1], argv[1]);
        fprintf(stderr, "try 'jostle --help'\n");
        return EXIT_INPUT;
    }
    if (version) {
        printf("jostle %s\n", JOSTLE_VERSION);
        return EXIT_DONE;
    }
    return asks ? help(argc - 1, argv + 1) : dispatch_command(argc - 1, argv + 1);
}

// A file that is opened where a standard stream is closed would get what is printed there. What
// takes its place cannot be written to, so that errors are as they would be.
static void hold_streams(void) {
    for (int i = STDIN_FILENO; i <= STDERR_FILENO; i++) {
        if (fcntl(i, F_GETFD) < 0) {
            open("/dev/null", i == STDIN_FILENO ? O_WRONLY : O_RDONLY);
        }
    }
}

int main(int argc, char **argv) {
    hold_streams();
    crash_catch();
    gsl_set_error_handler_off();
    // A closed pipe and a file grown too large are write errors like any other.
    signal(SIGPIPE, SIG_IGN);
    signal(SIGXFSZ, SIG_IGN);
    int status = dispatch(argc, argv);
    crash_release();
    errno = 0;
    if (fflush(stdout) != 0 || ferror(stdout)) {
        if (errno == EPIPE) {
            return EXIT_SYSTEM;  // whoever read has seen enough
        }
        fprintf(stderr, "jostle: error: cannot write to the standard output%s%s\n",
                errno ? ": " : "", errno ? strerror(errno) : "");
        return EXIT_SYSTEM;
    }
    return status;
}
