// SPDX-License-Identifier: GPL-3.0-or-later
#include "command/threads.h"

#include <unistd.h>

enum { THREADS_MAX = 4096 };

int threads_parse(const struct command *c, const char *text, int *n_thread) {
    long n = *n_thread;
    const int status = command_count(c, "-j takes a number of threads", text, THREADS_MAX, &n);
    *n_thread = (int)n;
    return status;
}

int threads_all(void) {
    const long n = sysconf(_SC_NPROCESSORS_ONLN);
    return n < 1 ? 1 : n > THREADS_MAX ? THREADS_MAX : (int)n;
}
