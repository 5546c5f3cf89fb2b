// SPDX-License-Identifier: GPL-3.0-or-later
// Quick sweeps (quick.c) over the live contacts of runs in lockstep: what that file says of one
// link of one run holds here for a contact in each lane, with the same operations in the same
// order, so that the bits are those of a run alone. With x the difference of the corrections at the
// ends of a contact, its law is taken for the line df = base + rate (x - asked), and
//     df = (F - f) / (1 + S_ll t),   q -= df times the columns of A^-1.
// Lanes in which a contact is not live, or that have converged, look on.
//
// Only the usual is done here: contacts that were closed, that Newton steps lead to their forces
// within a few sweeps, and that stay as well resolved as they were (resolve_suffices). A
// lane in which anything else happens gives up, and its run is solved alone from where it began.
#include "solve/ensemble_sweeps.h"

#include <float.h>
#include <math.h>
#include <string.h>

#include "solve/quick.h"
#include "solve/resolve.h"

// For all functions that have lanes in them: compilers take lanes apart that the processor they are
// compiled for does not have, before they expand one function in another.
#ifdef LANES_WIDEST
#define WIDEST __attribute__((target("arch=" LANES_WIDEST)))
#else
#define WIDEST
#endif
#define INLINE WIDEST LANES_INLINE

#define LESS(a, b) ((wide_bits)((a) < (b)))
#define AT_MOST(a, b) ((wide_bits)((a) <= (b)))
#define SMALLER(a, b) WIDE_CHOOSE(LESS(a, b), a, b)
#define LARGER(a, b) WIDE_CHOOSE(LESS(b, a), a, b)

INLINE bool any(const wide_bits *flags) {
    const wide_bytes b = __builtin_convertvector(*flags, wide_bytes);
    long long all;
    static_assert(sizeof all == sizeof b, "a byte a lane");
    memcpy(&all, &b, sizeof all);
    return all != 0;
}

// All bits of the lanes of `runs`.
INLINE void lanes_of(unsigned runs, wide_bits *flags) {
    static const wide_bits bit = {1, 2, 4, 8, 16, 32, 64, 128};
    *flags = (wide_bits)(((long long)runs & bit) == bit);
}

INLINE void see(const struct sweeps *s, const struct joint *j, wide *x) {
    const int *end = s->e->end[j->contact];
    *x = s->e->correction[end[0]] - s->e->correction[end[1]];
}

// Asks the law in the lanes `which`, where x is seen.
INLINE void ask(struct sweeps *s, struct joint *j, const wide *x, const wide_bits *which) {
    const struct ensemble_grip *grip = j->grip;
    const wide b = s->e->factors->b, g = s->e->factors->g;
    const wide d = j->d_trial + b * *x;
    const wide v = j->v_trial + g * *x;
    struct contact_lanes law;
    grip->law->force_lanes((const double *)grip->constant, (const double *)&d, (const double *)&v,
                           &law);
    const wide force = (wide)LANES_AT(law.force, 0);
    const wide dfdd = (wide)LANES_AT(law.dfdd, 0), dfdv = (wide)LANES_AT(law.dfdv, 0);
    const wide slope = b * dfdd + g * dfdv;
    const wide share = grip->flexibility * slope;
    s->well &= ~*which | (LESS(0.0, d) & AT_MOST(0.0, share) & AT_MOST(share, QUICK_STEEPEST));
    const wide steep = WIDE_ABSOLUTE(b * dfdd) + WIDE_ABSOLUTE(g * dfdv) + DBL_MIN;
    const wide inverse = 1.0 / ((1.0 + share) * steep);
    const wide damped = inverse * steep;
    const wide near = QUICK_NEAR * d * s->per_b;
    wide straight = QUICK_STRAIGHT * s->enough * WIDE_ABSOLUTE(force), reach = -1.0 - (wide){0.0};
    if (grip->law->traits & CONTACT_SMOOTH) {
        for (int lane = 0; lane < WIDE_RUNS; lane++) {
            straight[lane] = sqrt(straight[lane]);
        }
        straight = straight * inverse * (1.0 + share);
        const wide turn = WIDE_ABSOLUTE(v) * s->per_g;
        const wide nearer = SMALLER(near, turn);
        reach = SMALLER(nearer, straight);
    }
    const wide echo = share * grip->others;
    j->asked = WIDE_CHOOSE(*which, *x, j->asked);
    j->dfdd = WIDE_CHOOSE(*which, dfdd, j->dfdd);
    j->dfdv = WIDE_CHOOSE(*which, dfdv, j->dfdv);
    j->damped = WIDE_CHOOSE(*which, damped, j->damped);
    j->rate = WIDE_CHOOSE(*which, slope * damped, j->rate);
    j->base = WIDE_CHOOSE(*which, (force - j->force) * damped, j->base);
    j->near = WIDE_CHOOSE(*which, near, j->near);
    j->reach = WIDE_CHOOSE(*which, reach, j->reach);
    j->ask &= ~*which;
    s->echo = WIDE_CHOOSE(*which & LESS(s->echo, echo), echo, s->echo);
}

// q += f times column `floor` of A^-1, on the side of a contact that has it.
INLINE void push_as(wide *q, const struct ensemble_building *b, enum ensemble_held held, int floor,
                    const wide *f) {
    const int n = b->shape->n_floor;
    for (int i = 0; i < n; i++) {
        q[i] += *f * ENSEMBLE_AT(b->inverse, floor * n + i);
    }
}

INLINE void push(struct sweeps *s, const struct joint *j, int side, const wide *f) {
    const int building = j->grip->building[side];
    if (building != WALL) {
        const struct ensemble_building *b = &s->e->building[building];
        const int floor = s->e->end[j->contact][side] - b->shape->first;
        wide *q = s->e->correction + b->shape->first;
        b->held == HELD_ONCE ? push_as(q, b, HELD_ONCE, floor, f)
                             : push_as(q, b, HELD_BY_EACH, floor, f);
    }
}

// Takes note of changes df of forces in lanes that `move`.
INLINE void note(struct sweeps *s, const struct joint *j, const wide *df, const wide_bits *move) {
    const struct ensemble_lanes *e = s->e;
    const int *end = e->end[j->contact];
    const struct ensemble_trial *left = &e->trial[end[0]], *right = &e->trial[end[1]];
    const wide q = WIDE_ABSOLUTE(e->correction[end[0]]) + WIDE_ABSOLUTE(e->correction[end[1]]);
    const wide d = WIDE_ABSOLUTE(left->u) + WIDE_ABSOLUTE(right->u) + e->contact[j->contact].gap +
                   e->factors->b * q;
    const wide v = WIDE_ABSOLUTE(left->v) + WIDE_ABSOLUTE(right->v) + e->factors->g * q;
    const wide rounding =
        4.0 * DBL_EPSILON * (WIDE_ABSOLUTE(j->dfdd) * d + WIDE_ABSOLUTE(j->dfdv) * v);
    const wide size = WIDE_ABSOLUTE(*df);
    const wide_bits matters = *move & LESS(s->enough, size) & ~AT_MOST(size, rounding * j->damped);
    s->change = WIDE_CHOOSE(matters & j->ask & LESS(s->change, size), size, s->change);
    s->moved = WIDE_CHOOSE(matters & ~j->ask & LESS(s->moved, size), size, s->moved);
}

// A Newton step where x is seen.
INLINE void step(struct sweeps *s, struct joint *j, const wide *x) {
    const wide_bits here = j->live & s->busy & s->well;
    const wide dx = *x - j->asked;
    const wide df = j->base + j->rate * dx;
    const wide_bits idle = AT_MOST(WIDE_ABSOLUTE(df), QUICK_NEGLECTED * s->enough) &
                           AT_MOST(WIDE_ABSOLUTE(dx), j->reach);
    const wide led = WIDE_ABSOLUTE(dx - j->grip->flexibility * df);
    const wide_bits safe =
        AT_MOST(led, j->near) & AT_MOST(WIDE_ABSOLUTE(df), QUICK_NEAR * WIDE_ABSOLUTE(j->force));
    s->well &= ~here | idle | safe;
    const wide_bits move = here & ~idle & safe;
    const wide far = WIDE_CHOOSE(idle, WIDE_ABSOLUTE(dx), led);
    const wide left = j->reach - far;
    const wide room = LARGER(left, (wide){0.0}) * j->grip->unmoved;
    s->clear = WIDE_CHOOSE(here & LESS(room, s->clear), room, s->clear);
    const wide done = (wide)((wide_bits)df & move), undone = -done;
    j->force = WIDE_CHOOSE(move, j->force + df, j->force);
    j->base -= j->damped * done;
    j->ask = (move & ~AT_MOST(led, j->reach)) | (~move & j->ask);
    push(s, j, 0, &undone);
    push(s, j, 1, &done);
    note(s, j, &done, &move);
    const wide size = WIDE_ABSOLUTE(j->force);
    s->largest = WIDE_CHOOSE(here & LESS(s->largest, size), size, s->largest);
}

INLINE void visit(struct sweeps *s, struct joint *j) {
    wide x;
    see(s, j, &x);
    const wide dx = x - j->asked;
    const wide_bits known =
        ~j->ask & (AT_MOST(WIDE_ABSOLUTE(dx), j->reach) | (wide_bits)(dx == 0.0));
    const wide_bits unknown = j->live & s->busy & ~known;
    if (any(&unknown)) {
        ask(s, j, &x, &unknown);
    }
    step(s, j, &x);
}

INLINE void renew(struct sweeps *s) {
    s->enough = s->tolerance * s->largest;
    s->largest = s->change = s->moved = (wide){0.0};
    s->clear = INFINITY - (wide){0.0};
}

// Asks the laws of lanes `which`, wherever they stand.
INLINE void ask_all(struct sweeps *s, const wide_bits *which) {
    for (int i = 0; i < s->n_joint; i++) {
        struct joint *j = &s->joint[i];
        const wide_bits here = j->live & *which;
        wide x;
        see(s, j, &x);
        ask(s, j, &x, &here);
    }
}

// Asks all laws again where what is enough has become much less.
INLINE void ask_again(struct sweeps *s) {
    const wide_bits looser = s->busy & LESS(QUICK_LOOSER * s->enough, s->loosest);
    if (any(&looser)) {
        ask_all(s, &looser);
    }
    s->loosest = WIDE_CHOOSE(looser | LESS(s->loosest, s->enough), s->enough, s->loosest);
}

// Where the contacts are without corrections.
INLINE void gather(struct sweeps *s) {
    const struct ensemble_lanes *e = s->e;
    const wide none = {0.0};
    s->largest = s->echo = none;
    for (int i = 0; i < s->n_joint; i++) {
        struct joint *j = &s->joint[i];
        const struct ensemble_trial *left = &e->trial[e->end[j->contact][0]];
        const struct ensemble_trial *right = &e->trial[e->end[j->contact][1]];
        lanes_of(j->runs, &j->live);
        j->live &= s->well;
        j->ask = j->live;
        j->base = j->rate = j->asked = j->reach = j->near = j->damped = j->dfdd = j->dfdv = none;
        j->d_trial = left->u - right->u - e->contact[j->contact].gap;
        j->v_trial = left->v - right->v;
        const wide size = WIDE_ABSOLUTE(j->force);
        s->largest = WIDE_CHOOSE(j->live & LESS(s->largest, size), size, s->largest);
    }
}

INLINE void converge(struct sweeps *s) {
    const wide tolerance = s->tolerance * s->largest;
    wide echo = SMALLER(s->echo, 1.0 - (wide){0.0});
    echo = (wide)((wide_bits)echo & ~s->alone);
    const wide_bits done = AT_MOST(s->change, tolerance) & AT_MOST(echo * s->moved, tolerance) &
                           ~LESS(s->clear, s->moved) & AT_MOST(s->enough, 4.0 * tolerance);
    s->count -= s->busy;
    s->busy &= s->well & ~done;
}

// Gives up where a contact is not resolved as it was before.
INLINE void judge(struct sweeps *s) {
    const wide b = s->e->factors->b, g = s->e->factors->g;
    for (int i = 0; i < s->n_joint; i++) {
        const struct joint *j = &s->joint[i];
        wide x;
        see(s, j, &x);
        const wide d = j->d_trial + b * x;
        const wide_bits seen =
            ~j->ask & AT_MOST(d, j->fits_to) &
            AT_MOST(g * j->grip->flexibility * j->dfdv, RESOLVE_COARSEST_DASHPOT);
        s->well &= ~j->live | seen;
    }
}

// What e->correction was is kept, and comes back where lanes have given up.
INLINE void keep(const struct sweeps *s) {
    for (int i = 0; i < s->n_touched; i++) {
        const struct building *g = s->e->building[s->touched[i]].shape;
        for (int k = g->first; k < g->first + g->n_floor; k++) {
            s->e->kept[k] = s->e->correction[k];
        }
    }
}

INLINE void restore(const struct sweeps *s) {
    for (int i = 0; i < s->n_touched; i++) {
        const struct building *g = s->e->building[s->touched[i]].shape;
        for (int k = g->first; k < g->first + g->n_floor; k++) {
            s->e->correction[k] = WIDE_CHOOSE(s->well, s->e->correction[k], s->e->kept[k]);
        }
    }
}

WIDEST void ensemble_sweeps(struct sweeps *s, unsigned runs) {
    lanes_of(runs, &s->well);
    s->busy = s->well;
    s->count = (wide_bits){0};
    keep(s);
    gather(s);
    renew(s);
    ask_all(s, &s->busy);
    s->loosest = s->enough;
    for (int i = 0; i < ENSEMBLE_SWEEPS && any(&s->busy); i++) {
        if (i > 0) {
            renew(s);
            ask_again(s);
        }
        for (int k = 0; k < s->n_joint; k++) {
            visit(s, &s->joint[k]);
        }
        converge(s);
    }
    s->well &= ~s->busy;
    judge(s);
    restore(s);
}
