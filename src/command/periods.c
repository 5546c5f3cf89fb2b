// SPDX-License-Identifier: GPL-3.0-or-later
#include "command/spectrum.h"

#include <math.h>
#include <string.h>

#include "core/arena.h"
#include "core/quantity.h"

enum { PERIODS_MAX = 100000 };
static const double PERIOD_MIN = 1e-3, PERIOD_MAX = 1e3;  // [s]

int periods_range(const struct command *c, double from, double to, int n, struct arena *a,
                  struct periods *out) {
    if (!(from >= PERIOD_MIN && from < to && to <= PERIOD_MAX)) {
        return command_usage(c, "periods from %g to %g s; they must ascend within %g to %g s", from,
                             to, PERIOD_MIN, PERIOD_MAX);
    }
    double *value = arena_alloc(a, (size_t)n, sizeof *value);
    if (!value) {
        return command_no_memory();
    }
    for (int i = 0; i < n; i++) {
        value[i] = from * pow(to / from, (double)i / (n - 1));
    }
    value[n - 1] = to;
    *out = (struct periods){value, n};
    return EXIT_DONE;
}

static int refuse(const struct command *c, const char *option, const char *text) {
    return command_usage(c, "%s takes FROM:TO:N or a list, not '%s'", option, text);
}

int periods_parse(const struct command *c, const char *option, const char *text, struct arena *a,
                  struct periods *out) {
    if (strchr(text, ':')) {
        struct unit_system si;
        double from, to, n;
        unit_system_init(&si);
        const char *at = quantity_word(text, &si, &dimension_time, BARE_ALLOWED, &from);
        at = at && *at == ':' ? quantity_word(at + 1, &si, &dimension_time, BARE_ALLOWED, &to)
                              : NULL;
        if (!at || *at != ':' || !quantity_whole(at + 1, &dimension_none, BARE_ALLOWED, &n)) {
            return refuse(c, option, text);
        }
        if (!(n >= 2.0 && n <= PERIODS_MAX && n == floor(n))) {
            return command_usage(c, "%g periods; 2 to %d are taken", n, PERIODS_MAX);
        }
        return periods_range(c, from, to, (int)n, a, out);
    }
    const int max = quantity_count(text);
    double *value = arena_alloc(a, (size_t)max, sizeof *value);
    if (!value) {
        return command_no_memory();
    }
    const int n = quantity_list(text, &dimension_time, max, value);
    if (n == 0) {
        return refuse(c, option, text);
    }
    for (int i = 0; i < n; i++) {
        if (value[i] != 0.0 && !(value[i] >= PERIOD_MIN && value[i] <= PERIOD_MAX)) {
            return command_usage(c, "a period is %g s; it must be 0 or %g to %g s", value[i],
                                 PERIOD_MIN, PERIOD_MAX);
        }
        if (i > 0 && !(value[i] > value[i - 1])) {
            return command_usage(c, "periods must ascend: %g s follows %g s", value[i],
                                 value[i - 1]);
        }
    }
    *out = (struct periods){value, n};
    return EXIT_DONE;
}
