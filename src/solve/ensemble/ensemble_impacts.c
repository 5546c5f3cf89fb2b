// SPDX-License-Identifier: GPL-3.0-or-later
// Forces that contacts in lanes begin a step with, and what they have done in it: contact_step.c
// and impacts.c for contacts that stay closed.
#include "solve/ensemble/ensemble_contacts.h"

#define LINKS_IN_LANES
#include "solve/contact/link_terms.h"

// The polynomial through the forces of the last steps: `guess` of contact_step.c.
LANES_WHOLE void ensemble_contacts_begin(struct ensemble_lanes *e) {
    const wide none = {0.0};
    for (int i = 0; i < e->contacts->n_acting; i++) {
        const int k = e->contacts->acting[i];
        struct closed_contact *j = &e->contacts->contact[k];
        wide next = CUBIC_GUESS(j->before, j->past);
        next = WIDE_CHOOSE(j->n_past == 2, PARABOLIC_GUESS(j->before, j->past), next);
        next = WIDE_CHOOSE(j->n_past == 1, LINEAR_GUESS(j->before, j->past), next);
        const wide above = WIDE_LARGER(next, none);
        j->force = WIDE_CHOOSE(WIDE_LESS(none, j->before), above, j->before);
        e->force[k] = (wide)((wide_bits)j->force & j->live);
        e->acts[k] = true;
    }
}

// What impacts.c does for a live link that stays closed; *contact is the work on all of its run.
LANES_WHOLE_INLINE void account(const struct ensemble_lanes *e, int k, double time, double h,
                                wide *contact) {
    struct closed_contact *j = &e->contacts->contact[k];
    const wide start = ENSEMBLE_PENETRATION(e, k, e->now);
    const wide end = ENSEMBLE_PENETRATION(e, k, e->next);
    const wide now = time - (wide){0.0};
    const wide_bits stronger = WIDE_LESS(j->peak_force, j->force),
                    deeper = WIDE_LESS(j->deepest, end);
    j->peak_force = WIDE_CHOOSE(stronger, j->force, j->peak_force);
    j->peak_force_time = WIDE_CHOOSE(stronger, now, j->peak_force_time);
    j->deepest = WIDE_CHOOSE(deeper, end, j->deepest);
    j->deepest_time = WIDE_CHOOSE(deeper, now, j->deepest_time);
    const wide mean = (j->before + j->force) / 2.0;
    const wide impulse = mean * h, work = mean * (end - start);
    j->impulse += impulse;
    j->work += work;
    j->impact_impulse += impulse;
    j->impact_work += work;
    j->impact_force = WIDE_LARGER(j->impact_force, j->force);
    j->impact_depth = WIDE_LARGER(j->impact_depth, end);
    *contact += (wide)((wide_bits)work & j->live);
}

LANES_WHOLE void ensemble_contacts_commit(struct ensemble_lanes *e, double time, double h) {
    struct ensemble_contacts *s = e->contacts;
    wide contact = {0.0};
    for (int i = 0; i < s->n_acting; i++) {
        struct closed_contact *j = &s->contact[s->acting[i]];
        account(e, s->acting[i], time, h, &contact);
        j->past[2] = j->past[1];
        j->past[1] = j->past[0];
        j->past[0] = j->before;
        j->before = j->force;
        j->n_past -= j->n_past < PAST_STEPS;
    }
    s->work += contact;
    s->sweeps += s->count;
    s->steps += 1;
}
