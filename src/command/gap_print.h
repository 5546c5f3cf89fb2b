// SPDX-License-Identifier: GPL-3.0-or-later
// The tables of `jostle gap`, on stdout.
#ifndef JOSTLE_GAP_PRINT_H
#define JOSTLE_GAP_PRINT_H

#include "study/apart.h"
#include "study/gap_search.h"

// Closing displacements and what the rules give. `scratch` has room for the runs.
void gap_print_apart(const struct plan *p, const struct apart *a, double *scratch);
// The same run by run, separated by tabs.
void gap_print_apart_tsv(const struct plan *p, const struct apart *a);

// The gaps looked at, and the one found.
void gap_print_search(const struct gap_search_request *q, const struct gap_search *s);
void gap_print_search_tsv(const struct gap_search_request *q, const struct gap_search *s);

#endif
