// SPDX-License-Identifier: GPL-3.0-or-later
// Free flight of models with few floors, all on one ground: what floors.c does, but from step to
// step, with the state in registers.
#ifndef JOSTLE_FEW_H
#define JOSTLE_FEW_H

#include "solve/account.h"
#include "solve/work.h"

enum { FEW_MAX = 2 * LANES_WIDTH };

// What a step reads besides the state, side by side in memory; each (FEW_MAX), by floor.
struct few_table {
    double mass[FEW_MAX], stiffness[FEW_MAX], joint[FEW_MAX], joint_above[FEW_MAX];
    double damping_below[FEW_MAX], damping[FEW_MAX], damping_above[FEW_MAX];
    double back[FEW_MAX], spring[FEW_MAX], rest[FEW_MAX], limit[FEW_MAX];
    double peak[PEAK_COUNT][FEW_MAX];
    double inverse[FEW_MAX][FEW_MAX];  // A^-1 of all buildings
};

struct few {
    bool possible;            // with this model
    long factors;             // work.factors that the inverse is of
    struct few_table *table;  // from where a line of the cache begins
    // For LANES_WIDTH columns each, the rows of the inverse that they have, in fours.
    struct few_rows {
        int from, to;
    } rows[FEW_MAX / LANES_WIDTH];
};

struct flight;

// Room for the model of a flight; false: no memory.
bool few_alloc(struct few *few, const struct flight *f, struct arena *a);

// Takes the inverses of the buildings, which must be there, unless that has been done.
void few_factor(struct few *few, const struct work *w);

// Takes steps from number `n`, whose state is `s`, as far as `end`, but stops before one in which a
// contact closes or a storey leaves its line. What is computed ahead for the flight must reach that
// far. Returns the step reached, the state of which is then in `s`.
long few_take(const struct flight *f, struct state *s, long n, long end);

#endif
