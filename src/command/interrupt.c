// SPDX-License-Identifier: GPL-3.0-or-later
#include "command/interrupt.h"

#include <signal.h>
#include <stddef.h>

// The only state that outlives a call, as signals ask for.
static volatile sig_atomic_t interrupted;

static void note(int number) {
    interrupted = number;
}

void interrupt_catch(void) {
    struct sigaction action = {.sa_handler = note, .sa_flags = (int)SA_RESETHAND};
    sigemptyset(&action.sa_mask);
    sigaction(SIGINT, &action, NULL);
    sigaction(SIGTERM, &action, NULL);
    sigaction(SIGHUP, &action, NULL);
}

int interrupt_number(void) {
    return interrupted;
}

int interrupt_check(struct error *e) {
    return interrupted ? error_set(e, STATUS_SYSTEM, "interrupted by signal %d", (int)interrupted)
                       : STATUS_OK;
}
