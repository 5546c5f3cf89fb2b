// SPDX-License-Identifier: GPL-3.0-or-later
// The part of a report's summary that tells the largest forces of the members of frames and walls.
#ifndef JOSTLE_REPORT_MEMBERS_H
#define JOSTLE_REPORT_MEMBERS_H

#include "jostle/result.h"

// Prints a line for the columns, the beams and the walls of each of these buildings (n) that has
// such members.
void report_print_members(const struct report *r, const struct report_building *const *building,
                          int n, FILE *to);

#endif
