// SPDX-License-Identifier: GPL-3.0-or-later
// Definitions of parameters, by a param, a sweep, or both.
#ifndef JOSTLE_DEFINITION_H
#define JOSTLE_DEFINITION_H

#include "deck/reader.h"

// A parameter may have one param and one sweep. The number of paired sweeps counts as both.
enum definition { BY_PARAM = 1, BY_SWEEP = 2, BY_BUNDLE = BY_PARAM | BY_SWEEP };

// False after having reported that `name` cannot be defined `by` this statement.
bool parameter_is_free(struct deck *d, const struct word *name, enum definition by);
// Defines the parameter `name` with `value`. If a -D gives the parameter, the value of the -D
// replaces *value, and the function returns true.
bool parameter_keep(struct deck *d, const struct word *name, enum definition by,
                    struct parameter *value);
// param NAME VALUE. A sweep over the same parameter, above or below, or a -D replaces the value.
void parameter_define(struct deck *d, const struct word *name, const struct word *value);

// The sweep over `name` in the first reading of the deck; *choice is the number of its value in
// this run. NULL: there is no such sweep, or this is the first reading.
const struct sweep *sweep_bound(const struct deck *d, const char *name, int *choice);
// Sets the value of `p` to value number `choice` (from 0) of `s`.
void sweep_choose(const struct sweep *s, int choice, struct parameter *p);

#endif
