// SPDX-License-Identifier: GPL-3.0-or-later
// The first lines of the summary of a run.
#ifndef JOSTLE_REPORT_HEAD_H
#define JOSTLE_REPORT_HEAD_H

#include "jostle/result.h"

// Prints the title, the number of a run of a study with its parameters, units, duration and step,
// and the collapse that ended the run.
void report_head(const struct report *r, FILE *to);

#endif
