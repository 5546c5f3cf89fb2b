// SPDX-License-Identifier: GPL-3.0-or-later
// The options by which `plot` and `fragility` choose what of a study they look at.
#ifndef JOSTLE_SUITE_OPTIONS_H
#define JOSTLE_SUITE_OPTIONS_H

#include "command/command.h"
#include "study/suite.h"

// Values of getopt_long for them; above all letters.
enum { SUITE_EDP = 1000, SUITE_IM, SUITE_OVER, SUITE_AT, SUITE_LIMIT, SUITE_FAILED };
#define SUITE_OPTIONS                                                                              \
    {"edp", required_argument, NULL, SUITE_EDP}, {"im", required_argument, NULL, SUITE_IM},        \
        {"over", required_argument, NULL, SUITE_OVER}, {"at", required_argument, NULL, SUITE_AT},  \
        {"limit", required_argument, NULL, SUITE_LIMIT}, {                                         \
        "failed", required_argument, NULL, SUITE_FAILED                                            \
    }

// The one of them that may be repeated.
#define SUITE_REPEATABLE "at"

struct suite_options {
    struct suite_request request;
    const char **at;     // (argc) owned
    const char *limits;  // "VALUE,VALUE"; NULL: none
    const char *first;   // the first of these options that was given; NULL: none
};

// Errors: no memory.
int suite_options_init(struct suite_options *o, int argc, struct error *e);
void suite_options_close(struct suite_options *o);

// Takes option `letter` of getopt_long with optarg. Returns EXIT_DONE or EXIT_INPUT.
int suite_options_take(const struct command *c, int letter, struct suite_options *o);

// True if `letter` is one of these.
bool suite_options_has(int letter);

// The limits, in the units of the EDP, from the arena of `s`; *n is 0 where none is given. Errors:
// those of edp_limit, STATUS_SYSTEM.
int suite_options_limits(const struct suite_options *o, const struct suite *s, double **limit,
                         int *n, struct error *e);

// Warns on stderr of a limit on a drift ratio, read from `text`, that a percentage without its sign
// seems to be.
void suite_options_warn_limit(const struct edp *p, const char *text, double limit);

// Lines of help about these options but --im and --limit.
extern const char suite_options_help[];

// What EDP can be, a line each.
void suite_options_print_edps(void);

// Warns on stderr of runs that are missing or failed, and says how they count.
void suite_options_warn(const struct suite *s);

#endif
