// SPDX-License-Identifier: GPL-3.0-or-later
// Newton sweeps (sweep.c) over the live contacts of runs in lockstep: what that file says of one
// link of one run holds here for a contact in each lane, by the same arithmetic (link_terms.h).
// Lanes in which a contact is not live, or that have converged, look on.
//
// Only the usual case is here: contacts that were closed, whose forces Newton steps find within a
// few sweeps, and for which steps are short enough (resolve.c). A lane in which anything else
// happens gives up, and its run is solved alone from the start of the step.
#include <math.h>

#include "solve/contact/resolve.h"
#include "solve/ensemble/ensemble_contacts.h"

#define LINKS_IN_LANES
#include "solve/contact/link_terms.h"

// As struct progress, and what runs have in common.
struct sweeps {
    struct ensemble_lanes *e;
    struct ensemble_contacts *contacts;
    wide tolerance, enough, loosest, largest, moved[2], echo, clear;
    wide_bits well;  // the lane has not given up,
    wide_bits busy;  // nor converged
};

// Contact number i of those that act.
LANES_WHOLE_INLINE int acting(const struct sweeps *s, int i) {
    return s->contacts->acting[i];
}

// All bits of the lanes of `runs`.
LANES_WHOLE_INLINE void lanes_of(unsigned runs, wide_bits *flags) {
    static const wide_bits bit = {1, 2, 4, 8, 16, 32, 64, 128};
    *flags = (wide_bits)(((long long)runs & bit) == bit);
}

LANES_WHOLE_INLINE void see(const struct sweeps *s, int k, wide *x) {
    const int *end = s->e->end[k];
    *x = s->e->correction[end[0]] - s->e->correction[end[1]];
}

// Asks the law at d and v.
LANES_WHOLE_INLINE void ask_law(const struct ensemble_grip *grip, const wide *d, const wide *v,
                                wide *force, wide *dfdd, wide *dfdv) {
    struct contact_lanes law;
    grip->law->force_lanes((const double *)grip->constant, (const double *)d, (const double *)v,
                           &law);
    *force = (wide)LANES_AT(law.force, 0);
    *dfdd = (wide)LANES_AT(law.dfdd, 0);
    *dfdv = (wide)LANES_AT(law.dfdv, 0);
}

// Takes a tangent in the lanes `which`.
LANES_WHOLE_INLINE void take_tangent(struct tangent_lanes *to, const struct tangent_lanes *t,
                                     const wide_bits *which) {
    to->base = WIDE_CHOOSE(*which, t->base, to->base);
    to->rate = WIDE_CHOOSE(*which, t->rate, to->rate);
    to->asked = WIDE_CHOOSE(*which, t->asked, to->asked);
    to->reach = WIDE_CHOOSE(*which, t->reach, to->reach);
    to->near = WIDE_CHOOSE(*which, t->near, to->near);
    to->damped = WIDE_CHOOSE(*which, t->damped, to->damped);
}

// Asks the law at x, for the lanes `which`.
LANES_WHOLE_INLINE void ask(struct sweeps *s, int k, const wide *x, const wide_bits *which) {
    struct closed_contact *j = &s->contacts->contact[k];
    const struct ensemble_grip *grip = &s->e->grip[k];
    const struct ensemble_factors *w = s->e->factors;
    const wide d = END(j->d_trial, w->b, *x), v = END(j->v_trial, w->g, *x);
    wide force, dfdd, dfdv;
    ask_law(grip, &d, &v, &force, &dfdd, &dfdv);
    const wide near = LINK_NEAR * d * w->per_b;
    const struct link_asked law = {*x, v, near, j->force, s->enough, force, dfdd, dfdv};
    const wide share = grip->flexibility * SLOPE(w, &law);
    struct tangent_lanes tangent;
    link_linearise(w, &law, &share, grip->law->traits & CONTACT_SMOOTH, &tangent);
    take_tangent(&j->tangent, &tangent, which);
    j->dfdd = WIDE_CHOOSE(*which, dfdd, j->dfdd);
    j->dfdv = WIDE_CHOOSE(*which, dfdv, j->dfdv);
    j->ask &= ~*which;
    s->well &= ~*which | (WIDE_LESS(0.0, d) & IS_SHALLOW(share));
    const wide echo = share * grip->others;
    s->echo = WIDE_CHOOSE(*which & WIDE_LESS(s->echo, echo), echo, s->echo);
}

// q += f times column `floor` of A^-1, from floor `from` on.
LANES_WHOLE_INLINE void push_as(wide *q, const struct ensemble_building *b, enum ensemble_held held,
                                int floor, int from, int to, const wide *f) {
    for (int i = from, at = floor * b->shape->n_floor; i < to; i++) {
        q[i] += *f * ENSEMBLE_AT(b->inverse, at + i);
    }
}

// The same on the side of a contact that has it.
LANES_WHOLE_INLINE void push(struct sweeps *s, int k, int side, const wide *f) {
    const struct ensemble_grip *g = &s->e->grip[k];
    if (g->building[side] != WALL) {
        const struct ensemble_building *b = &s->e->building[g->building[side]];
        const int floor = s->e->end[k][side] - b->shape->first;
        const int from = g->from[side], to = g->to[side];
        wide *q = s->e->correction + b->shape->first;
        b->held == HELD_ONCE ? push_as(q, b, HELD_ONCE, floor, from, to, f)
                             : push_as(q, b, HELD_BY_EACH, floor, from, to, f);
    }
}

// The lanes of `which` in which changes of that size are no more than rounding.
LANES_WHOLE_INLINE void find_negligible(const struct sweeps *s, int k, const wide *size,
                                        wide_bits *which) {
    const struct ensemble_lanes *e = s->e;
    const struct closed_contact *j = &s->contacts->contact[k];
    const int *end = e->end[k];
    const struct ensemble_trial *left = &e->trial[end[0]], *right = &e->trial[end[1]];
    const wide q = WIDE_ABSOLUTE(e->correction[end[0]]) + WIDE_ABSOLUTE(e->correction[end[1]]);
    const wide d =
        WIDE_ABSOLUTE(left->u) + WIDE_ABSOLUTE(right->u) + e->gap[k].width + e->factors->b * q;
    const wide v = WIDE_ABSOLUTE(left->v) + WIDE_ABSOLUTE(right->v) + e->factors->g * q;
    *which &= AT_MOST(*size, ROUNDING(j->tangent.damped, j->dfdd, d, j->dfdv, v));
}

// Records changes df of forces in lanes that `move`.
LANES_WHOLE_INLINE void note(struct sweeps *s, int k, const wide *df, const wide_bits *move) {
    const struct closed_contact *j = &s->contacts->contact[k];
    const wide size = WIDE_ABSOLUTE(*df);
    wide *known = &s->moved[LAW_KNOWN], *unknown = &s->moved[LAW_UNKNOWN];
    const wide most = WIDE_CHOOSE(j->ask, *unknown, *known);
    const wide_bits larger = *move & WIDE_LESS(s->enough, size) & WIDE_LESS(most, size);
    if (wide_any(&larger)) {
        wide_bits negligible = larger;
        find_negligible(s, k, &size, &negligible);
        const wide_bits matters = larger & ~negligible;
        *unknown = WIDE_CHOOSE(matters & j->ask, size, *unknown);
        *known = WIDE_CHOOSE(matters & ~j->ask, size, *known);
    }
}

// Changes forces by df in lanes that `move`, led by so much from where their laws were asked.
LANES_WHOLE_INLINE void change(struct sweeps *s, int k, const wide *df, const wide *led,
                               const wide_bits *move) {
    struct closed_contact *j = &s->contacts->contact[k];
    const wide done = (wide)((wide_bits)*df & *move), undone = -done;
    j->force = WIDE_CHOOSE(*move, j->force + *df, j->force);
    j->tangent.base -= j->tangent.damped * done;
    j->ask = (*move & ~AT_MOST(*led, j->tangent.reach)) | (~*move & j->ask);
    push(s, k, 0, &undone);
    push(s, k, 1, &done);
    note(s, k, &done, move);
}

// A Newton step at x.
LANES_WHOLE_INLINE void step(struct sweeps *s, int k, const wide *x) {
    const struct closed_contact *j = &s->contacts->contact[k];
    const struct tangent_lanes *t = &j->tangent;
    const struct ensemble_grip *grip = &s->e->grip[k];
    const wide_bits here = j->live & s->busy & s->well;
    const wide dx = *x - t->asked;
    const wide df = CHANGE(t, dx);
    const wide led = LED(dx, grip->flexibility, df);
    const wide_bits idle = IS_IDLE(t, dx, df, s->enough), safe = IS_SAFE(t, led, df, j->force);
    s->well &= ~here | idle | safe;
    const wide_bits move = here & ~idle & safe;
    const wide far = WIDE_CHOOSE(idle, ABSOLUTE(dx), led);
    const wide left = t->reach - far;
    const wide room = WIDE_LARGER(left, (wide){0.0}) * grip->unmoved;
    s->clear = WIDE_CHOOSE(here & WIDE_LESS(room, s->clear), room, s->clear);
    if (wide_any(&move)) {
        change(s, k, &df, &led, &move);
    }
    const wide size = WIDE_ABSOLUTE(j->force);
    s->largest = WIDE_CHOOSE(here & WIDE_LESS(s->largest, size), size, s->largest);
}

LANES_WHOLE_INLINE void visit(struct sweeps *s, int k) {
    const struct closed_contact *j = &s->contacts->contact[k];
    wide x;
    see(s, k, &x);
    const wide dx = x - j->tangent.asked;
    const wide_bits known = ~j->ask & IS_ON_TANGENT(&j->tangent, dx);
    const wide_bits unknown = j->live & s->busy & ~known;
    if (wide_any(&unknown)) {
        ask(s, k, &x, &unknown);
    }
    step(s, k, &x);
}

LANES_WHOLE_INLINE void renew(struct sweeps *s) {
    s->enough = s->tolerance * s->largest;
    s->largest = s->moved[LAW_KNOWN] = s->moved[LAW_UNKNOWN] = (wide){0.0};
    s->clear = INFINITY - (wide){0.0};
}

// Asks the laws of lanes `which`, wherever they stand.
LANES_WHOLE_INLINE void ask_all(struct sweeps *s, const wide_bits *which) {
    for (int i = 0; i < s->contacts->n_acting; i++) {
        const int k = acting(s, i);
        const wide_bits here = s->contacts->contact[k].live & *which;
        wide x;
        see(s, k, &x);
        ask(s, k, &x, &here);
    }
}

// Asks all laws again where what is enough has become much less.
LANES_WHOLE_INLINE void ask_again(struct sweeps *s) {
    const wide_bits looser = s->busy & WIDE_LESS(LINK_LOOSER * s->enough, s->loosest);
    if (wide_any(&looser)) {
        ask_all(s, &looser);
    }
    s->loosest = WIDE_CHOOSE(looser | WIDE_LESS(s->loosest, s->enough), s->enough, s->loosest);
}

// Where the contacts are without corrections.
LANES_WHOLE_INLINE void gather(struct sweeps *s) {
    const struct ensemble_lanes *e = s->e;
    const wide none = {0.0};
    s->largest = s->echo = none;
    for (int i = 0; i < s->contacts->n_acting; i++) {
        const int k = acting(s, i);
        struct closed_contact *j = &s->contacts->contact[k];
        const struct ensemble_trial *left = &e->trial[e->end[k][0]];
        const struct ensemble_trial *right = &e->trial[e->end[k][1]];
        j->ask = j->live;
        j->tangent = (struct tangent_lanes){.base = none};
        j->dfdd = j->dfdv = none;
        j->d_trial = left->u - right->u - e->gap[k].width;
        j->v_trial = left->v - right->v;
        const wide size = WIDE_ABSOLUTE(j->force);
        s->largest = WIDE_CHOOSE(j->live & WIDE_LESS(s->largest, size), size, s->largest);
    }
}

LANES_WHOLE_INLINE void converge(struct sweeps *s) {
    const wide tolerance = s->tolerance * s->largest;
    wide echo = WIDE_SMALLER(s->echo, 1.0 - (wide){0.0});
    echo = (wide)((wide_bits)echo & ~s->contacts->alone);
    const wide_bits done = IS_SETTLED(s, echo, tolerance) &
                           ~WIDE_LESS(s->clear, s->moved[LAW_KNOWN]) &
                           IS_MEASURED(s->enough, tolerance);
    s->contacts->count -= s->busy;
    s->busy &= s->well & ~done;
}

// Is a step short enough for the spring in the lanes `which`, at penetrations d? As fits_spring of
// resolve.c.
LANES_WHOLE_INLINE void refit(struct sweeps *s, int k, const wide *d, const wide_bits *which) {
    struct closed_contact *j = &s->contacts->contact[k];
    const struct ensemble_grip *grip = &s->e->grip[k];
    const double h = s->e->h;
    const wide none = {0.0};
    wide force, still, dashpot;
    ask_law(grip, d, &none, &force, &still, &dashpot);
    const wide_bits simple = (wide_bits)(j->dfdv == 0.0) & WIDE_LESS(0.0, j->dfdd);
    const wide stiffness = WIDE_CHOOSE(simple, j->dfdd, still);
    const wide coarse = SPRING_COARSENESS(stiffness, grip->flexibility, h);
    const double farthest = grip->law->traits & CONTACT_SMOOTH ? RESOLVE_DEEPER : 0.0;
    const wide coarsest = RESOLVE_COARSEST_SPRING - none;
    const wide to =
        (wide)((wide_bits)(farthest * *d) & WIDE_AT_MOST(RESOLVE_STIFFER * coarse, coarsest));
    j->fits_to = WIDE_CHOOSE(*which, to, j->fits_to);
    s->well &= ~*which | WIDE_AT_MOST(coarse, coarsest);
}

// Gives up where steps are not short enough for a contact, or where its law is not known.
LANES_WHOLE_INLINE void judge(struct sweeps *s) {
    const wide b = s->e->factors->b, g = s->e->factors->g;
    for (int i = 0; i < s->contacts->n_acting; i++) {
        const int k = acting(s, i);
        const struct closed_contact *j = &s->contacts->contact[k];
        wide x;
        see(s, k, &x);
        const wide d = j->d_trial + b * x;
        const wide dashpot = DASHPOT_COARSENESS(j->dfdv, s->e->grip[k].flexibility, g);
        s->well &= ~j->live | (~j->ask & WIDE_AT_MOST(dashpot, RESOLVE_COARSEST_DASHPOT));
        const wide_bits deeper = j->live & s->well & ~WIDE_AT_MOST(d, j->fits_to);
        if (wide_any(&deeper)) {
            refit(s, k, &d, &deeper);
        }
    }
}

// Keeps e->correction, to restore it in lanes that give up.
LANES_WHOLE_INLINE void keep(const struct sweeps *s) {
    for (int i = 0; i < s->contacts->n_touched; i++) {
        const struct building *g = s->e->building[s->contacts->touched[i]].shape;
        for (int k = g->first; k < g->first + g->n_floor; k++) {
            s->e->kept[k] = s->e->correction[k];
        }
    }
}

LANES_WHOLE_INLINE void restore(const struct sweeps *s) {
    for (int i = 0; i < s->contacts->n_touched; i++) {
        const struct building *g = s->e->building[s->contacts->touched[i]].shape;
        for (int k = g->first; k < g->first + g->n_floor; k++) {
            s->e->correction[k] = WIDE_CHOOSE(s->well, s->e->correction[k], s->e->kept[k]);
        }
    }
}

// The lanes in which flags are set, a bit each.
LANES_WHOLE_INLINE unsigned runs_of(const wide_bits *flags) {
    unsigned runs = 0;
    for (int lane = 0; lane < WIDE_RUNS; lane++) {
        runs |= (*flags)[lane] ? 1U << lane : 0U;
    }
    return runs;
}

LANES_WHOLE void ensemble_contacts_solve(struct ensemble_lanes *e) {
    struct sweeps s;
    s.e = e;
    s.contacts = e->contacts;
    s.tolerance = e->contacts->tolerance;
    lanes_of(e->contacts->active, &s.well);
    s.busy = s.well;
    e->contacts->count = (wide_bits){0};
    keep(&s);
    gather(&s);
    renew(&s);
    ask_all(&s, &s.busy);
    s.loosest = s.enough;
    for (int i = 0; i < ENSEMBLE_SWEEPS && wide_any(&s.busy); i++) {
        if (i > 0) {
            renew(&s);
            ask_again(&s);
        }
        for (int k = 0; k < e->contacts->n_acting; k++) {
            visit(&s, acting(&s, k));
        }
        converge(&s);
    }
    s.well &= ~s.busy;
    judge(&s);
    restore(&s);
    e->contacts->solved = runs_of(&s.well);
    for (int i = 0; e->contacts->solved && i < e->contacts->n_touched; i++) {
        e->building[e->contacts->touched[i]].pushed = true;
    }
}
