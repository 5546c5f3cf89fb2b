// SPDX-License-Identifier: GPL-3.0-or-later
// Signals that `ground` and `load` read from a deck.
#ifndef JOSTLE_SIGNALS_H
#define JOSTLE_SIGNALS_H

#include "model/builder.h"

// Frequencies of sines [Hz]: far beyond what any building feels, and 2 pi of them times any time
// can be told from its neighbour.
extern const struct range signals_frequency_range;

// Options of a sine, to be put first into a table of rows, which has the row of the amplitude, with
// its dimension, of its own.
enum sine_row { SINE_AMPLITUDE, SINE_FREQUENCY, SINE_PHASE, SINE_CYCLES, SINE_ROWS };
#define SINE_SHAPE_ROWS                                                                            \
    [SINE_FREQUENCY] =                                                                             \
        {"frequency", ROW_NUMBER, ROW_REQUIRED, OF_FREQUENCY, &signals_frequency_range,            \
         NAN,         "frequency"},                                                                \
    [SINE_PHASE] = {"phase", ROW_NUMBER, 0, OF_NONE, NULL, 0.0, "phase in radians"},               \
    [SINE_CYCLES] = {"cycles",                                                                     \
                     ROW_NUMBER,                                                                   \
                     0,                                                                            \
                     {0},                                                                          \
                     &range_positive,                                                              \
                     NAN,                                                                          \
                     "number of cycles; endless if not given"}

// A sine made from those options, starting at `start`; without cycles it never ends.
// Warns of a phase in degrees.
struct signal signals_sine(struct builder *b, const struct argument *a, double start);

// Remembers when a signal ends, for the default duration.
void signals_longest(struct builder *b, const struct signal *s);

// Periods of oscillators that a record may be scaled by [s], and their damping ratios.
extern const struct range signals_period_range, signals_damping_range;

#endif
