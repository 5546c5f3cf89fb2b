// SPDX-License-Identifier: GPL-3.0-or-later
#define _XOPEN_SOURCE 700  // sigaltstack
#include "command/crash.h"

#include <signal.h>
#include <stddef.h>
#include <string.h>
#include <unistd.h>

#include "command/command.h"

static const struct harm {
    int signal;
    const char *name;
} harms[] = {
    {SIGSEGV, "segmentation fault"}, {SIGBUS, "bus error"}, {SIGFPE, "arithmetic error"},
    {SIGILL, "illegal instruction"}, {SIGABRT, "abort"},
};
enum { N_HARM = sizeof harms / sizeof harms[0], STACK_BYTES = 1 << 14 };

// Where the handler runs, as the stack may be what is exhausted.
static char stack[STACK_BYTES];

static void say(const char *text) {
    if (write(STDERR_FILENO, text, strlen(text)) < 0) {
        return;  // there is nobody left to tell
    }
}

// Calls nothing but what POSIX allows in a handler.
static void end(int number) {
    say("jostle: error: ended by a");
    for (int i = 0; i < N_HARM; i++) {
        if (harms[i].signal == number) {
            say(strchr("aeiou", harms[i].name[0]) ? "n " : " ");
            say(harms[i].name);
        }
    }
    say("; a damaged HDF5 file or too little memory does that, else it is a mistake of jostle\n");
    _exit(EXIT_SYSTEM);
}

void crash_catch(void) {
    const stack_t own = {.ss_sp = stack, .ss_size = sizeof stack};
    struct sigaction old, action = {.sa_handler = end};
    if (sigaltstack(&own, NULL) == 0) {
        action.sa_flags = SA_ONSTACK;
    }
    sigemptyset(&action.sa_mask);
    for (int i = 0; i < N_HARM; i++) {
        if (sigaction(harms[i].signal, NULL, &old) == 0 && old.sa_handler == SIG_DFL) {
            sigaction(harms[i].signal, &action, NULL);
        }
    }
}
