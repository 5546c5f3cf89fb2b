// SPDX-License-Identifier: GPL-3.0-or-later
#include "model/signals.h"

#include <gsl/gsl_math.h>
#include <string.h>

const struct range signals_frequency_range = {
    .min = 0.0, .max = 1e6, .min_open = true, .text = "> 0 and <= 1e6 Hz"};
const struct range signals_period_range = {
    .min = 0.001, .max = 1000.0, .text = ">= 0.001 s and <= 1000 s"};
const struct range signals_damping_range = {
    .min = 0.0, .max = 1.0, .max_open = true, .text = ">= 0 and < 1"};

struct signal signals_sine(struct builder *b, const struct argument *a, double start) {
    // A bare number beyond a full turn is rather in degrees.
    const struct argument *phase = &a[SINE_PHASE];
    const double value = phase->number[0];
    const char *text = phase->given ? phase->word[0].text : "$";
    if (fabs(value) > 2.0 * M_PI && text[strspn(text, "+-.0123456789")] == '\0') {
        deck_warning(b->deck, &phase->word[0], "the phase is %g rad; write %gdeg for degrees",
                     value, value);
    }
    double frequency = a[SINE_FREQUENCY].number[0];
    double end = INFINITY;
    if (a[SINE_CYCLES].given) {
        end = start + a[SINE_CYCLES].number[0] / frequency;
    }
    return (struct signal){
        .start = start,
        .end = end,
        .amplitude = a[SINE_AMPLITUDE].number[0],
        .omega = 2.0 * M_PI * frequency,
        .phase = a[SINE_PHASE].number[0],
        .name = "sine",
    };
}

void signals_longest(struct builder *b, const struct signal *s) {
    if (isfinite(s->end)) {
        b->longest = fmax(b->longest, s->end);
    }
}
