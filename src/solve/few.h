// SPDX-License-Identifier: GPL-3.0-or-later
// Steps of models with few floors, all on one ground: what floors.c does, but on vectors that hold
// all floors, and in free flight from step to step, with the state in registers.
#ifndef JOSTLE_FEW_H
#define JOSTLE_FEW_H

#include "solve/effective.h"
#include "solve/state.h"

enum { FEW_MAX = 2 * LANES_WIDTH };

// What a step reads besides the state, side by side in memory; each (FEW_MAX), by floor.
struct few_table {
    double inertia[FEW_MAX], stiffness[FEW_MAX];  // minus the mass
    double joint[FEW_MAX], joint_above[FEW_MAX];  // all bits are 1 where there is one
    double damping_below[FEW_MAX], damping[FEW_MAX], damping_above[FEW_MAX];
    double back[FEW_MAX], spring[FEW_MAX], rest[FEW_MAX], limit[FEW_MAX];  // struct storey_branch
    double peak[PEAK_COUNT][FEW_MAX];
    double inverse[FEW_MAX][FEW_MAX];  // A^-1 of all buildings
};

struct flight;
struct work;

// What the end of a step brings besides the state.
enum few_news {
    FEW_NOTHING,
    FEW_NEAR,      // a contact may close or be nearer than ever; penetrations are not right
    FEW_INFINITE,  // what should be numbers
};

// How steps are taken.
struct few_steps {
    // few_take where all storeys are elastic, and where they follow lines.
    long (*fly)(const struct flight *f, struct state *s, long n, long end);
    long (*fly_on_lines)(const struct flight *f, struct state *s, long n, long end);
    // Where it `serves`: floors_move, and what the corrections in `w` lead to, both with the
    // penetrations; and floors_account.
    enum few_news (*move)(struct work *w, const struct state *now, struct state *next);
    enum few_news (*correct)(const struct work *w, const struct state *now, struct state *next);
    void (*account)(const struct work *w, const struct state *now, const struct state *next);
};
extern const struct few_steps few_narrow, few_wide;

struct few {
    bool possible;  // with this model
    bool serves;    // the step in hand: of the model's size, and all linear but for the links
    const struct few_steps *steps;
    const struct flight *flight;  // borrowed: groups of contacts; NULL: not all links are in one
    long factors;                 // work.factors that the inverse is of
    struct few_table *table;      // from where a line of the cache begins
    // For LANES_WIDTH columns each, the rows of the inverse that they have.
    struct few_rows {
        int from, to;
    } rows[FEW_MAX / LANES_WIDTH];
};

// Room for a model; false: no memory.
bool few_alloc(struct few *few, const struct model *m, struct arena *a);

// Takes the inverses of the buildings, which must be there, unless that has been done.
void few_factor(struct work *w);

// Takes steps from number `n`, whose state is `s`, as far as `end`, but stops before one in which a
// contact closes or a storey leaves its line. What is computed ahead for the flight must reach that
// far. Returns the step reached, the state of which is then in `s`.
long few_take(const struct flight *f, struct state *s, long n, long end);

#endif
