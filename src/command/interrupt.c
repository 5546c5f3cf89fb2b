// SPDX-License-Identifier: GPL-3.0-or-later
#include "command/interrupt.h"

#include <signal.h>
#include <stddef.h>
#include <time.h>

// The only state that outlives a call, as signals ask for.
static volatile sig_atomic_t interrupted, since;  // which, and when [s]

// timeout(1) and others signal a process and then its group, so that one signal comes twice.
enum { ONE_SIGNAL = 1 };  // [s]

static void note(int number) {
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    if (!interrupted) {
        interrupted = number;
        since = (sig_atomic_t)now.tv_sec;
    } else if (now.tv_sec - since > ONE_SIGNAL) {
        signal(number, SIG_DFL);
        raise(number);
    }
}

void interrupt_catch(void) {
    struct sigaction action = {.sa_handler = note}, old;
    sigemptyset(&action.sa_mask);
    sigaction(SIGINT, &action, NULL);
    sigaction(SIGTERM, &action, NULL);
    if (sigaction(SIGHUP, NULL, &old) == 0 && old.sa_handler != SIG_IGN) {  // nohup ignores it
        sigaction(SIGHUP, &action, NULL);
    }
    sigaction(SIGXCPU, &action, NULL);
}

int interrupt_number(void) {
    return interrupted;
}

int interrupt_check(struct error *e) {
    return interrupted ? error_set(e, STATUS_SYSTEM, "interrupted by signal %d", (int)interrupted)
                       : STATUS_OK;
}
