// SPDX-License-Identifier: GPL-3.0-or-later
// A step of the live contacts of runs in lockstep, by the arithmetic of sweep_step.h for a contact
// in each lane: the forces that it begins with, Newton sweeps, and what they have done. Lanes in
// which a contact is not live, or that have converged, are masked.
//
// Only the usual case is here: contacts that were closed, whose forces Newton steps find within a
// few sweeps, and for which steps are short enough (contact.c). A lane in which anything else
// happens gives up, and its run is solved alone from the start of the step.
#define LANES_OF_RUNS
#include <string.h>

#include "core/masks.h"
#include "solve/ensemble/ensemble_lockstep.h"

// As struct progress, and what runs have in common.
struct progress_lanes {
    wide tolerance, law_tolerance, largest, moved[2], feedback, margin;
    wide_bits going;      // lanes that have not given up,
    wide_bits iterating;  // nor converged
};

// What sweep_step.h asks for with eight lanes.
LANE_INLINE void sweep_see(const struct ensemble_lanes *e, const struct closed_contact *p,
                           wide *x) {
    const int *end = e->end[p->index];
    *x = e->correction[end[0]] - e->correction[end[1]];
}

LANE_INLINE void sweep_law(const struct closed_contact *p, const wide *d, const wide *v,
                           struct response_lanes *law) {
    struct contact_lanes all;
    p->law->force_lanes((const double *)p->constant, (const double *)d, (const double *)v, &all);
    law->force = (wide)LANES_AT(all.force, 0);
    law->dfdd = (wide)LANES_AT(all.dfdd, 0);
    law->dfdv = (wide)LANES_AT(all.dfdv, 0);
}

LANE_INLINE void sweep_sizes(const struct ensemble_lanes *e, const struct closed_contact *p,
                             wide *u, wide *v, wide *q) {
    const int *end = e->end[p->index];
    const struct ensemble_trial *left = &e->trial[end[0]], *right = &e->trial[end[1]];
    *u = ABSOLUTE(left->u) + ABSOLUTE(right->u) + e->gap[p->index].width;
    *v = ABSOLUTE(left->v) + ABSOLUTE(right->v);
    *q = ABSOLUTE(e->correction[end[0]]) + ABSOLUTE(e->correction[end[1]]);
}

// q += f times column `floor` of A^-1, from floor `from` on.
LANE_INLINE void ensemble_add_column(wide *q, const struct ensemble_building *b, bool once,
                                     int floor, int from, int to, const wide *f) {
    for (int i = from, at = floor * b->shape->n_dof; i < to; i++) {
        q[i] += *f * ENSEMBLE_AT(b->inverse, at + i);
    }
}

LANE_INLINE void ensemble_push(const struct ensemble_lanes *e, const struct closed_contact *p,
                               int side, const wide *f) {
    if (p->building[side] != WALL) {
        const struct ensemble_building *b = &e->building[p->building[side]];
        const int floor = e->end[p->index][side] - b->shape->first;
        const int from = p->from[side], to = p->to[side];
        wide *q = e->correction + b->shape->first;
        b->once ? ensemble_add_column(q, b, true, floor, from, to, f)
                : ensemble_add_column(q, b, false, floor, from, to, f);
    }
}

LANE_INLINE void sweep_push(const struct ensemble_lanes *e, const struct closed_contact *p,
                            const wide *df) {
    const wide reaction = -*df;
    ensemble_push(e, p, 0, &reaction);
    ensemble_push(e, p, 1, df);
}

#include "solve/account/impact_step.h"
#include "solve/contact/sweep_step.h"

// Number i of the contacts that are live in some lane.
LANE_INLINE struct closed_contact *ensemble_acting(const struct ensemble_lanes *e, int i) {
    return &e->contacts->contact[e->contacts->acting[i]];
}

LANES_WHOLE void ensemble_contacts_begin(struct ensemble_lanes *e) {
    for (int i = 0; i < e->contacts->n_acting; i++) {
        struct closed_contact *p = ensemble_acting(e, i);
        const wide next = SWEEP_GUESS(p->before, p->past, p->n_past);
        const wide above = LARGER(next, EVERYWHERE(0.0));
        p->force = CHOOSE(LESS(0.0, p->before), above, p->before);
        e->force[p->index] = CHOOSE(p->live, p->force, EVERYWHERE(0.0));
        e->acts[p->index] = true;
    }
}

// Where the contacts are without corrections.
LANE_INLINE void ensemble_gather(const struct ensemble_lanes *e, struct progress_lanes *s) {
    s->largest = s->feedback = EVERYWHERE(0.0);
    for (int i = 0; i < e->contacts->n_acting; i++) {
        struct closed_contact *p = ensemble_acting(e, i);
        const struct ensemble_trial *left = &e->trial[e->end[p->index][0]];
        const struct ensemble_trial *right = &e->trial[e->end[p->index][1]];
        p->tangent = (struct tangent_lanes){.base = EVERYWHERE(0.0)};
        p->dfdd = p->dfdv = EVERYWHERE(0.0);
        p->d_trial = ENSEMBLE_PENETRATION(e, p->index, e->trial);
        p->v_trial = left->v - right->v;
        const wide size = ABSOLUTE(p->force);
        s->largest = CHOOSE(p->live & LESS(s->largest, size), size, s->largest);
    }
}

// A sweep, in lanes that are iterating. Laws are evaluated before it in lanes `which`. Lanes that
// converge do not iterate any more.
LANE_INLINE void ensemble_sweep(const struct ensemble_lanes *e, const wide_bits *which,
                                struct progress_lanes *s) {
    struct ensemble_contacts *all = e->contacts;
    for (int i = 0; ANY(*which) && i < all->n_acting; i++) {
        struct closed_contact *p = ensemble_acting(e, i);
        const wide_bits here = p->live & *which;
        wide_bits safe;
        wide x;
        sweep_see(e, p, &x);
        sweep_evaluate(e, p, &x, &here, s, &safe);
        s->going &= ~here | safe;
    }
    for (int i = 0; i < all->n_acting; i++) {
        struct closed_contact *p = ensemble_acting(e, i);
        const wide_bits here = p->live & s->iterating & s->going;
        wide_bits safe = here;
        sweep_visit(e, p, &safe, s);
        s->going &= ~here | safe;
    }
    const wide most = SMALLER(s->feedback, EVERYWHERE(1.0));
    const wide feedback = CHOOSE(all->alone, EVERYWHERE(0.0), most);
    wide_bits settled, measured;
    sweep_settled(s, &all->tolerance, &feedback, &settled);
    sweep_measured(s, &all->tolerance, &measured);
    all->count -= s->iterating;
    s->iterating &= s->going & ~(settled & measured);
}

// Gives up where steps are not short enough for a contact, or where its law is not known.
LANE_INLINE void ensemble_resolve(const struct ensemble_lanes *e, struct progress_lanes *s) {
    for (int i = 0; i < e->contacts->n_acting; i++) {
        struct closed_contact *p = ensemble_acting(e, i);
        const struct response_lanes law = {.dfdd = p->dfdd, .dfdv = p->dfdv};
        wide_bits fits = p->live & s->going & ~p->stale & SWEEP_FITS_DASHPOT(e, p, p->dfdv);
        wide x;
        sweep_see(e, p, &x);
        const wide d = p->d_trial + e->scheme.b * x;
        sweep_fit_spring(p, e->scheme.h, &law, &d, &fits);
        s->going &= ~p->live | fits;
    }
}

// The lanes in which flags are set, a bit each.
LANE_INLINE unsigned ensemble_runs_of(const wide_bits *flags) {
    unsigned runs = 0;
    for (int lane = 0; lane < WIDE_RUNS; lane++) {
        runs |= (*flags)[lane] ? 1U << lane : 0U;
    }
    return runs;
}

LANES_WHOLE void ensemble_contacts_solve(struct ensemble_lanes *e) {
    static const wide_bits bit = {1, 2, 4, 8, 16, 32, 64, 128};
    struct progress_lanes s;
    const wide_bits began = (wide_bits)(((long long)e->contacts->active & bit) == bit);
    s.iterating = s.going = began;
    e->contacts->count = (wide_bits){0};
    memcpy(e->kept, e->correction, (size_t)e->n_floor * sizeof *e->kept);
    ensemble_gather(e, &s);
    for (int i = 0; i < ENSEMBLE_SWEEPS && ANY(s.iterating); i++) {
        wide_bits which = s.iterating;
        sweep_renew(&e->contacts->tolerance, &s);
        if (i == 0) {
            s.law_tolerance = s.tolerance;
        } else {
            sweep_tighten(&s, &which);
        }
        ensemble_sweep(e, &which, &s);
    }
    s.going &= ~s.iterating;
    ensemble_resolve(e, &s);
    const wide_bits refused = began & ~s.going;
    for (int i = 0; ANY(refused) && i < e->n_floor; i++) {
        e->correction[i] = CHOOSE(s.going, e->correction[i], e->kept[i]);
    }
    e->contacts->solved = ensemble_runs_of(&s.going);
    for (int i = 0; e->contacts->solved && i < e->contacts->n_acting; i++) {
        const int *at = ensemble_acting(e, i)->building;
        for (int side = 0; side < 2; side++) {
            if (at[side] != WALL) {
                e->building[at[side]].pushed = true;
            }
        }
    }
}

// Raises a peak, and its time, to x where that is greater.
LANE_INLINE void ensemble_raise(const wide *x, double time, wide *peak, wide *peak_time) {
    const wide_bits more = LESS(*peak, *x);
    *peak = CHOOSE(more, *x, *peak);
    *peak_time = CHOOSE(more, EVERYWHERE(time), *peak_time);
}

// Takes a contact that stays closed through the step; *contact is the work on all of its run.
LANE_INLINE void ensemble_account(const struct ensemble_lanes *e, struct closed_contact *p,
                                  double time, double h, wide *contact) {
    const wide start = ENSEMBLE_PENETRATION(e, p->index, e->now);
    const wide end = ENSEMBLE_PENETRATION(e, p->index, e->next);
    struct impact_share_lanes share;
    ensemble_raise(&p->force, time, &p->link.force, &p->link.force_time);
    ensemble_raise(&end, time, &p->deepest, &p->deepest_time);
    impact_find_share(&p->before, &p->force, &start, &end, h, &share);
    impact_add_share(&p->link, &p->impact, &share);
    *contact += CHOOSE(p->live, share.work, EVERYWHERE(0.0));
}

LANES_WHOLE void ensemble_contacts_commit(struct ensemble_lanes *e, double time, double h) {
    struct ensemble_contacts *s = e->contacts;
    wide contact = {0.0};
    for (int i = 0; i < s->n_acting; i++) {
        struct closed_contact *p = ensemble_acting(e, i);
        ensemble_account(e, p, time, h, &contact);
        for (int j = PAST_STEPS - 1; j > 0; j--) {
            p->past[j] = p->past[j - 1];
        }
        p->past[0] = p->before;
        p->before = p->force;
        p->n_past -= p->n_past < PAST_STEPS;
    }
    s->work += contact;
    s->sweeps += s->count;
    s->steps += 1;
}
