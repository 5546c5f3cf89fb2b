// SPDX-License-Identifier: GPL-3.0-or-later
#include "command/threads.h"

#include <errno.h>
#include <stdlib.h>
#include <unistd.h>

enum { THREADS_MAX = 4096 };

int threads_parse(const struct command *c, const char *text, int *n_thread) {
    char *end;
    errno = 0;
    const long n = strtol(text, &end, 10);
    if (errno || end == text || *end || n < 1 || n > THREADS_MAX) {
        return command_usage(c, "-j takes a number of threads from 1 to %d, not '%s'", THREADS_MAX,
                             text);
    }
    *n_thread = (int)n;
    return EXIT_DONE;
}

int threads_all(void) {
    const long n = sysconf(_SC_NPROCESSORS_ONLN);
    return n < 1 ? 1 : n > THREADS_MAX ? THREADS_MAX : (int)n;
}
