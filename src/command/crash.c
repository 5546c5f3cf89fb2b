// SPDX-License-Identifier: GPL-3.0-or-later
#define _DEFAULT_SOURCE  // sigaltstack, MAP_ANONYMOUS
#include "command/crash.h"

#include <signal.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <unistd.h>

#include "command/command.h"
#include "core/safe.h"

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

// The file that is read, as it is printed; a longer path is cut.
static char file_read[1024];
static volatile sig_atomic_t reads;

void crash_reading(void *context, const char *path) {
    (void)context;
    reads = 0;
    FILE *to = path ? fmemopen(file_read, sizeof file_read, "w") : NULL;
    if (to) {
        safe_put(to, SAFE_TERMINAL, path);
        fclose(to);
        reads = 1;
    }
}

static void say_file(void) {
    if (reads) {
        say(" while reading ");
        say(file_read);
    }
}

// Whether there is memory for the HDF5 library. Unlike malloc this works when the heap is damaged.
static bool is_memory_there(void) {
    enum { ROOM = 16 << 20 };
    void *room = mmap(NULL, ROOM, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    if (room == MAP_FAILED) {
        return false;
    }
    munmap(room, ROOM);
    return true;
}

// Calls nothing but what POSIX allows in a handler, and what only enters the kernel.
static void end(int number) {
    const bool is_damaged = reads && is_memory_there();
    say("jostle: error: ended by a");
    for (int i = 0; i < N_HARM; i++) {
        if (harms[i].signal == number) {
            say(strchr("aeiou", harms[i].name[0]) ? "n " : " ");
            say(harms[i].name);
        }
    }
    say_file();
    say(is_damaged ? "; the file is damaged, or it is a mistake of jostle\n"
                   : "; a damaged HDF5 file or too little memory does that, else it is a mistake "
                     "of jostle\n");
    _exit(is_damaged ? EXIT_INPUT : EXIT_SYSTEM);
}

static bool released;

static void end_early(void) {
    if (!released) {
        say("jostle: error: ended by a library");
        say_file();
        say("; too little memory does that\n");
        _exit(EXIT_SYSTEM);
    }
}

void crash_release(void) {
    released = true;
}

void crash_catch(void) {
    atexit(end_early);
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
