// SPDX-License-Identifier: GPL-3.0-or-later
// Periods on the command line: FROM:TO:N, evenly spaced by their logarithms, or a list.
#ifndef JOSTLE_PERIODS_H
#define JOSTLE_PERIODS_H

#include "command/command.h"

struct periods {
    const double *value;  // (n) [s] ascending, 0 or 0.001 to 1000; NULL: none are given
    int n;
};

// Reads the value of `option`. What these two make is from `a`; they return EXIT_DONE or, after a
// message, the exit status.
int periods_parse(const struct command *c, const char *option, const char *text, struct arena *a,
                  struct periods *out);

// n >= 2 periods between two > 0.
int periods_range(const struct command *c, double from, double to, int n, struct arena *a,
                  struct periods *out);

#endif
