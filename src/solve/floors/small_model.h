// SPDX-License-Identifier: GPL-3.0-or-later
// Steps of small models, of few floors and all on one ground: what floors.c does, but on vectors
// that hold all floors, and in free flight from step to step, with the state in registers.
#ifndef JOSTLE_SMALL_MODEL_H
#define JOSTLE_SMALL_MODEL_H

#include "solve/floors/effective.h"
#include "solve/state.h"

enum { SMALL_MAX = 2 * LANES_WIDTH };  // floors

// What a step reads besides the state, side by side in memory; each (SMALL_MAX), by floor.
struct small_table {
    double inertia[SMALL_MAX], stiffness[SMALL_MAX];  // minus the mass
    double joint[SMALL_MAX], joint_above[SMALL_MAX];  // all bits are 1 where there is one
    double damping_below[SMALL_MAX], damping[SMALL_MAX], damping_above[SMALL_MAX];
    // As of struct storey_branch:
    double back[SMALL_MAX], spring[SMALL_MAX], rest[SMALL_MAX], limit[SMALL_MAX];
    double peak[PEAK_COUNT][SMALL_MAX];
    double inverse[SMALL_MAX][SMALL_MAX];  // A^-1 of all buildings
};

struct flight;
struct work;

// What the end of a step brings besides the state.
enum small_news {
    SMALL_NOTHING,
    SMALL_NEAR,      // a contact may close or be nearer than ever; penetrations are not right
    SMALL_INFINITE,  // what should be numbers
};

// How steps are taken.
struct small_steps {
    // small_take where all storeys are elastic, and where they follow lines.
    long (*fly)(const struct flight *f, struct state *s, long n, long end);
    long (*fly_on_lines)(const struct flight *f, struct state *s, long n, long end);
    // Where it `serves`: floors_move, and what the corrections in `w` lead to, both with the
    // penetrations; and floors_account.
    enum small_news (*move)(struct work *w, const struct state *now, struct state *next);
    enum small_news (*correct)(const struct work *w, const struct state *now, struct state *next);
    void (*account)(const struct work *w, const struct state *now, const struct state *next);
};
extern const struct small_steps small_narrow, small_wide;

struct small_model {
    bool possible;  // with this model
    bool serves;    // the step in hand: of the model's size, and all linear but for the links
    const struct small_steps *steps;
    const struct flight *flight;  // borrowed: groups of contacts; NULL: not all links are in one
    long factors;                 // work.factors that the inverse is of
    struct small_table *table;    // from where a line of the cache begins
    // For LANES_WIDTH columns each, the rows of the inverse that they have.
    struct small_rows {
        int from, to;
    } rows[SMALL_MAX / LANES_WIDTH];
};

// Room for a model; false: no memory.
bool small_alloc(struct small_model *small, const struct model *m, struct arena *a);

// Takes the inverses of the buildings, which must be there, unless that has been done.
void small_factor(struct work *w);

// Takes steps from number `n`, whose state is `s`, as far as `end`, but stops before one in which a
// contact closes or a storey leaves its line. What is computed ahead for the flight must reach that
// far. Returns the step reached, the state of which is then in `s`.
long small_take(const struct flight *f, struct state *s, long n, long end);

#endif
