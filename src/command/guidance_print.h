// SPDX-License-Identifier: GPL-3.0-or-later
// What `check` says of the step.
#ifndef JOSTLE_GUIDANCE_PRINT_H
#define JOSTLE_GUIDANCE_PRINT_H

#include "model/guidance.h"

// Prints how long contacts and periods are, how many of the model's steps cover them, and the step
// that resolves them.
void guidance_print(const struct model *m, const struct guidance *g);

#endif
