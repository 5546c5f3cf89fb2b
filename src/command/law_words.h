// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef JOSTLE_LAW_WORDS_H
#define JOSTLE_LAW_WORDS_H

#include <stddef.h>

#include "jostle/contact_law.h"

// A law and the values of its rows as a deck would give them, "hertz -k 2.75e+09 -n 1.5", cut where
// `text` ends.
void law_words(const struct contact_law *law, const double *value, char *text, size_t size);

#endif
