// SPDX-License-Identifier: GPL-3.0-or-later
// Newmark's method with adaptive steps, each of them a step of the fixed kind: what the contact
// iteration, events and accounts do is the same. How long they are is told by step_length.h.
#ifndef JOSTLE_ADAPTIVE_NEWMARK_H
#define JOSTLE_ADAPTIVE_NEWMARK_H

#include "solve/run.h"

// Takes the state of `r` to the time `end`, by struct run's `advance`.
int adaptive_newmark_advance(struct run *r, double end, double h);

#endif
