// SPDX-License-Identifier: GPL-3.0-or-later
// Forces that contacts in lanes begin a step with, and what they have done in it: contact_step.c
// and impacts.c for contacts that stay closed.
#define LINKS_IN_LANES
#include "solve/ensemble_contacts.h"
#include "solve/link_terms.h"

// The polynomial through the forces of the last steps: `guess` of contact_step.c.
LANES_WHOLE void ensemble_contacts_begin(struct ensemble_lanes *e) {
    const wide none = {0.0};
    for (int i = 0; i < e->contacts->n_acting; i++) {
        const int k = e->contacts->acting[i];
        struct closed_contact *j = &e->contacts->contact[k];
        wide next = CUBIC_GUESS(j->was, j->past);
        next = WIDE_CHOOSE(j->n_past == 2, PARABOLIC_GUESS(j->was, j->past), next);
        next = WIDE_CHOOSE(j->n_past == 1, LINEAR_GUESS(j->was, j->past), next);
        const wide above = WIDE_LARGER(next, none);
        j->force = WIDE_CHOOSE(WIDE_LESS(none, j->was), above, j->was);
        e->force[k] = (wide)((wide_bits)j->force & j->live);
        e->acts[k] = true;
    }
}

LANES_WHOLE_INLINE void penetration(const struct ensemble_lanes *e, int k,
                                    const struct ensemble_state *s, wide *delta) {
    *delta = s[e->end[k][0]].u - s[e->end[k][1]].u - e->gap[k].width;
}

// What impacts.c does for a live link that stays closed; *contact is the work on all of its run.
LANES_WHOLE_INLINE void account(const struct ensemble_lanes *e, int k, double time, double h,
                                wide *contact) {
    struct closed_contact *j = &e->contacts->contact[k];
    wide before, after;
    penetration(e, k, e->now, &before);
    penetration(e, k, e->next, &after);
    const wide now = time - (wide){0.0};
    const wide_bits stronger = WIDE_LESS(j->most, j->force), deeper = WIDE_LESS(j->deep, after);
    j->most = WIDE_CHOOSE(stronger, j->force, j->most);
    j->most_time = WIDE_CHOOSE(stronger, now, j->most_time);
    j->deep = WIDE_CHOOSE(deeper, after, j->deep);
    j->deep_time = WIDE_CHOOSE(deeper, now, j->deep_time);
    const wide mean = (j->was + j->force) / 2.0;
    const wide impulse = mean * h, work = mean * (after - before);
    j->impulse += impulse;
    j->work += work;
    j->own_impulse += impulse;
    j->own_work += work;
    j->own_force = WIDE_LARGER(j->own_force, j->force);
    j->own_depth = WIDE_LARGER(j->own_depth, after);
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
        j->past[0] = j->was;
        j->was = j->force;
        j->n_past -= j->n_past < PAST_STEPS;
    }
    s->work += contact;
    s->sweeps += s->count;
    s->steps += 1;
}
