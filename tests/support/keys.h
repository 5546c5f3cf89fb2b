// SPDX-License-Identifier: GPL-3.0-or-later
// Keys of runs that do not exist.
#ifndef JOSTLE_TEST_KEYS_H
#define JOSTLE_TEST_KEYS_H

#include "study/keys.h"

// The keys of `n` runs, to be closed by keys_close. Run i has the key of the number byte[i], from 1
// to 255; 0: its key is not known. byte NULL: run i has the key i + 1. The keys belong at one place
// of the table.
void keys_made_up(struct keys *keys, long n, const int *byte);

#endif
