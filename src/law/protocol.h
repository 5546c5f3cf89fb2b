// SPDX-License-Identifier: GPL-3.0-or-later
// Cyclic protocols of tests: steps of rising amplitude, each of some full cycles.
#ifndef JOSTLE_PROTOCOL_H
#define JOSTLE_PROTOCOL_H

enum { PROTOCOL_STEPS_MAX = 12, PROTOCOL_TARGETS_MAX = 128 };

struct protocol {
    const char *name, *source;
    int n;
    double amplitude[PROTOCOL_STEPS_MAX];  // (n) over the largest
    int cycles[PROTOCOL_STEPS_MAX];
};

extern const struct protocol protocols[];
extern const int n_protocol;

// Sets the targets of a protocol with the largest amplitude `amplitude`, the last of them 0.
// Returns how many.
int protocol_targets(const struct protocol *p, double amplitude,
                     double target[PROTOCOL_TARGETS_MAX]);

#endif
