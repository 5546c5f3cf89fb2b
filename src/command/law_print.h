// SPDX-License-Identifier: GPL-3.0-or-later
// The results of `jostle law` as text.
#ifndef JOSTLE_LAW_PRINT_H
#define JOSTLE_LAW_PRINT_H

#include <stddef.h>

#include "command/law_impacts.h"
#include "command/printer.h"
#include "jostle/contact_law.h"

// "25000 kg at 0.5 m/s against 40000 kg".
void law_print_bodies(const struct law_impacts *l, char *text, size_t size);

// The energy lost as a reader is shown it: 0 where it is less than the rounding of the kinetic
// energy.
double law_print_dissipated(const struct law_impacts *l, const struct law_impact *i);

// Warnings of a fit: parameters that the record does not determine, a record that is cut off.
void law_print_warnings(const struct law_impacts *l, FILE *to);

// Text is for readers, at most 100 columns wide. Data has a line for each quantity in SI: its name,
// and a value for each law; TSV names the laws where there are several, the other forms always.
// Returns EXIT_DONE or, after a message, the exit status.
int law_print(const struct law_impacts *l, enum printer_form form, FILE *to);

// The points of one impact as TSV. Returns as law_print.
int law_print_history(const struct law_impact *i, FILE *to);

// A law and the values of its rows as a deck would give them, "hertz -k 2.75e+09 -n 1.5", cut where
// `text` ends.
void law_print_words(const struct contact_law *law, const double *value, char *text, size_t size);

#endif
