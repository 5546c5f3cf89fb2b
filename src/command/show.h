// SPDX-License-Identifier: GPL-3.0-or-later
// The machine-readable forms of a report.
#ifndef JOSTLE_SHOW_H
#define JOSTLE_SHOW_H

#include "command/printer.h"
#include "jostle/result.h"

// The report as a table of one line a value (show_table.c), which returns EXIT_DONE or, after a
// message, the exit status; and as JSON (show_json.c).
int show_table(const struct report *r, enum printer_form form, FILE *to);
void show_json(const struct report *r, FILE *to);

#endif
