// SPDX-License-Identifier: GPL-3.0-or-later
// A study whose results are known: free oscillators.
#ifndef JOSTLE_TEST_SUITE_H
#define JOSTLE_TEST_SUITE_H

#include "jostle/study_file.h"

// Runs the study of the deck `text` on one thread and opens its file.
struct study_file *suite_ran(const char *text);

// One storey of mass 1 and stiffness k, with an initial velocity of im: the largest displacement is
// im / sqrt(k). Runs with im / sqrt(k) > 0.25 fail. k is 100 400 900 1600 2500, im 3 1 2.
extern const char suite_oscillators[];

#endif
