// SPDX-License-Identifier: GPL-3.0-or-later
// Signals of the statements `ground` and `load`.
#ifndef JOSTLE_SIGNALS_H
#define JOSTLE_SIGNALS_H

#include "model/builder.h"

// Allowed frequencies of sines [Hz]. The largest is far above the frequencies of buildings, and
// small enough that the phase of the sine has no large rounding error.
extern const struct range signals_frequency_range;

// Options of a sine. They are the first rows of a table of rows. The table adds the row of the
// amplitude, whose dimension differs.
enum sine_row { SINE_AMPLITUDE, SINE_FREQUENCY, SINE_PHASE, SINE_CYCLES, SINE_ROWS };
#define SINE_SHAPE_ROWS                                                                            \
    [SINE_FREQUENCY] =                                                                             \
        {"frequency", ROW_NUMBER, ROW_REQUIRED, OF_FREQUENCY, &signals_frequency_range,            \
         NAN,         "frequency"},                                                                \
    [SINE_PHASE] = {"phase", ROW_NUMBER, 0, OF_NONE, NULL, 0.0, "phase in radians"},               \
    [SINE_CYCLES] = {                                                                              \
        "cycles", ROW_NUMBER, 0, {0}, &range_positive, NAN, "number of cycles; default: no end"}

// Makes a sine from these options, from the time `start` on. Without -cycles it never ends. Warns
// about a phase in degrees.
struct signal signals_sine(struct builder *b, const struct argument *a, double start);

// Notes the end of a signal for the default duration.
void signals_longest(struct builder *b, const struct signal *s);

// Allowed periods [s] and damping ratios of the oscillator of -sa.
extern const struct range signals_period_range, signals_damping_range;

#endif
