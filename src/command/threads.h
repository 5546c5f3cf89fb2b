// SPDX-License-Identifier: GPL-3.0-or-later
// The option -j THREADS.
#ifndef JOSTLE_THREADS_H
#define JOSTLE_THREADS_H

#include "command/command.h"

// Reads a number of threads. Returns EXIT_DONE or EXIT_INPUT.
int threads_parse(const struct command *c, const char *text, int *n_thread);

// As many as the system has cores.
int threads_all(void);

#endif
