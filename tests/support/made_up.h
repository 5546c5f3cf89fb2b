// SPDX-License-Identifier: GPL-3.0-or-later
// A made-up model with made-up results, for tests of the result file: two buildings of three
// floors, two contacts, one bilateral link.
#ifndef JOSTLE_TEST_MADE_UP_H
#define JOSTLE_TEST_MADE_UP_H

#include "jostle/result.h"

enum { FLOORS = 3, DOF = 6, ROWS = 11 };

struct made_up {
    char folder[64], path[128], part[160];
    struct model model;
    struct results results;
};

// Set-up and tear-down of cmocka: *state is a struct made_up with its own folder.
int made_up_setup(void **state);
int made_up_teardown(void **state);

// Hands `n` rows to the writer. Row k holds 1000 s + 10 i + k / 16 for value i of source s, which
// is exact in single precision.
int made_up_rows(struct result_writer *w, int n, struct error *e);

// Writes the whole file.
int made_up_write(struct made_up *f, enum result_existing existing, struct error *e);

// Writes it and opens it again; fails the test where that does not succeed.
struct result_file *made_up_written(struct made_up *f);

#endif
