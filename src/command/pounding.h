// SPDX-License-Identifier: GPL-3.0-or-later
// jostle spectrum --pounding: the pounding force spectrum of a deck.
#ifndef JOSTLE_POUNDING_H
#define JOSTLE_POUNDING_H

#include "command/spectrum.h"

// Runs the deck for every pair of periods, and prints or draws the largest contact forces. Returns
// the exit status.
int pounding_run(const struct spectrum_request *q, struct arena *a);

#endif
