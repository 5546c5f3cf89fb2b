// SPDX-License-Identifier: GPL-3.0-or-later
// The options by which `plot` and `fragility` choose what of a study they look at.
#ifndef JOSTLE_SUITE_OPTIONS_H
#define JOSTLE_SUITE_OPTIONS_H

#include "command/option.h"
#include "study/suite.h"

// The rows that both have; `place` is that of a struct suite_options in the request.
#define SUITE_ROWS(place)                                                                          \
    {"over",                                                                                       \
     0,                                                                                            \
     "NAME",                                                                                       \
     OPTION_TEXT,                                                                                  \
     0,                                                                                            \
     (place) + offsetof(struct suite_options, request.over),                                       \
     .doc = "sweeps whose values are samples, as NAME or NAME,NAME (default: record, or the only " \
            "sweep of texts, alone or with what goes together with it, and the samples of random " \
            "sweeps)"},                                                                            \
        {"at",                                                                                     \
         0,                                                                                        \
         "NAME=VALUE",                                                                             \
         OPTION_WORDS,                                                                             \
         0,                                                                                        \
         (place) + offsetof(struct suite_options, at),                                             \
         .doc = "looks at the runs with this value of a sweep only; may be repeated"},             \
    {                                                                                              \
        "failed", 0, "above|left-out", OPTION_CHOICE, 0,                                           \
            (place) + offsetof(struct suite_options, request.failed),                              \
            .doc = "runs that failed count as above every value (the default), or not at all"      \
    }

struct suite_options {
    struct suite_request request;
    struct words at;
    const char *limits;              // "VALUE,VALUE"; NULL: none
    const struct option_row *first;  // the first of these options that was given; NULL: none
};

// The request, complete once the command line is read.
const struct suite_request *suite_options_request(struct suite_options *o);

// The limits, in the units of the EDP, from the arena of `s`; *n is 0 where none is given. Errors:
// those of edp_limit, STATUS_SYSTEM.
int suite_options_limits(const struct suite_options *o, const struct suite *s, double **limit,
                         int *n, struct error *e);

// Warns on stderr of a limit on a drift ratio, read from `text`, that a percentage without its sign
// seems to be.
void suite_options_warn_limit(const struct edp *p, const char *text, double limit);

// What EDP can be, a line each.
void suite_options_print_edps(void);

// Warns on stderr of runs that are missing or failed, and says how they count.
void suite_options_warn(const struct suite *s);

#endif
