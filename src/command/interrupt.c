// SPDX-License-Identifier: GPL-3.0-or-later
#include "command/interrupt.h"

#include <errno.h>
#include <signal.h>
#include <stddef.h>
#include <time.h>

// The only state that outlives a call, as signals ask for.
static volatile sig_atomic_t interrupted, since;  // which, and when [s]
static volatile pid_t also;                       // process to be ended; 0: none

// timeout(1) and others signal a process and then its group, so that one signal comes twice.
enum { ONE_SIGNAL = 1 };  // [s]

static void end_other(void) {
    if (also > 0) {
        kill(also, SIGTERM);
    }
}

static void note(int number) {
    const int before = errno;
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    if (!interrupted) {
        interrupted = number;
        since = (sig_atomic_t)now.tv_sec;
    } else if (now.tv_sec - since > ONE_SIGNAL) {
        signal(number, SIG_DFL);
        raise(number);
    }
    end_other();
    errno = before;
}

void interrupt_catch(void) {
    static const int caught[] = {SIGINT, SIGTERM, SIGHUP, SIGXCPU, SIGUSR1};
    struct sigaction action = {.sa_handler = note, .sa_flags = SA_RESTART}, old;
    sigemptyset(&action.sa_mask);
    for (size_t i = 0; i < sizeof caught / sizeof caught[0]; i++) {
        if (sigaction(caught[i], NULL, &old) == 0 && old.sa_handler != SIG_IGN) {
            sigaction(caught[i], &action, NULL);
        }
    }
}

void interrupt_also(pid_t process) {
    also = process;
    if (interrupted) {
        end_other();
    }
}

int interrupt_number(void) {
    return interrupted;
}

int interrupt_check(struct error *e) {
    return interrupted ? error_set(e, STATUS_SYSTEM, "interrupted by signal %d", (int)interrupted)
                       : STATUS_OK;
}
