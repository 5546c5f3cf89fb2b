// SPDX-License-Identifier: GPL-3.0-or-later
// The options by which `plot` and `fragility` choose what of a study they look at.
#ifndef JOSTLE_SUITE_OPTIONS_H
#define JOSTLE_SUITE_OPTIONS_H

#include "command/option.h"
#include "study/plan.h"
#include "study/suite.h"

struct suite_options {
    struct suite_request request;
    struct words at;
    const char *limits;              // "VALUE,VALUE"; NULL: none
    int collapse;                    // not 0: --collapse
    const struct option_row *first;  // the first of these options that was given; NULL: none
};

// The options that both have, of a struct suite_options.
extern const struct option_row suite_options_rows[];

// Gives --collapse its demand and its limit. Returns what is wrong with the options, NULL if
// nothing.
const char *suite_options_collapse(struct suite_options *o);

// The request, complete once the command line is read.
const struct suite_request *suite_options_request(struct suite_options *o);

// The limits, in the units of the EDP, from the arena of `s`; *n is 0 where none is given. Errors:
// those of edp_limit, STATUS_SYSTEM.
int suite_options_limits(const struct suite_options *o, const struct suite *s, double **limit,
                         int *n, struct error *e);

// Reads "EDP=VALUE", a demand of the runs of a plan and its limit. Returns EXIT_DONE or, after a
// message, the exit status.
int suite_options_edp_limit(const struct command *c, const struct plan *p, const char *text,
                            struct edp *edp, double *limit);

// What EDP can be, a line each.
void suite_options_print_edps(void);

// Warns on stderr of runs that are missing or failed, and says how they count.
void suite_options_warn(const struct suite *s);

#endif
