// SPDX-License-Identifier: GPL-3.0-or-later
// Two histories of one quantity beside each other: a computed one, and another program's or a
// measured one, which is the reference.
#ifndef JOSTLE_COMPARISON_H
#define JOSTLE_COMPARISON_H

#include "motion/time_series.h"

struct comparison {
    double peak[2], peak_time[2];  // largest absolute values within the time of both: computed,
                                   // reference
    double difference;             // largest difference over the peak of the reference
    double difference_time;
    double first_time;   // of the first difference above the tolerance; NAN: there is none
    double error;        // root of sum (x - r)^2 over sum r^2: Jankowski (2005), eq. 10-11
    double correlation;  // of both, as they are; NAN: one of them is constant
    double shift;        // by how much the computed one is late where both match best
};

// Two histories and what tells them apart.
struct comparison_pair {
    const char *name;
    struct time_series computed, reference;
    struct comparison result;
};

// Compares at the times of the reference that are within those of the computed history. Between its
// rows the computed one is a curve of third order without overshoot (Steffen 1990). `tolerance` is
// a share of the peak of the reference. Errors: STATUS_INPUT (fewer than three instants in common),
// STATUS_SYSTEM.
int comparison_make(const struct time_series *computed, const struct time_series *reference,
                    double tolerance, struct comparison *out, struct error *e);

#endif
