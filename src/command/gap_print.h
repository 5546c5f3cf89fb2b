// SPDX-License-Identifier: GPL-3.0-or-later
// The tables of `jostle gap`, on stdout.
#ifndef JOSTLE_GAP_PRINT_H
#define JOSTLE_GAP_PRINT_H

#include "command/printer.h"
#include "study/contact_free.h"
#include "study/gap_search.h"

// All return EXIT_DONE or, after a message, the exit status.

// Closing displacements and what the rules give. `scratch` has room for the runs.
int gap_print_contact_free(const struct plan *p, const struct contact_free *a,
                           const struct separation_site *site, double *scratch);
// The same run by run, as data.
int gap_print_runs(const struct plan *p, const struct contact_free *a, enum printer_form form);

// The gaps looked at, and in text the one found.
int gap_print_search(const struct gap_search_request *q, const struct gap_search *s,
                     enum printer_form form);

#endif
