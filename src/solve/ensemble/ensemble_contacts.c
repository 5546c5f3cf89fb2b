// SPDX-License-Identifier: GPL-3.0-or-later
// Contacts on their way into lanes and back.
#include <math.h>
#include <string.h>

#include "core/arena.h"
#include "solve/contact/contact.h"
#include "solve/ensemble/ensemble_lockstep.h"

struct ensemble_contacts *ensemble_contacts_create(const struct model *m, struct arena *a) {
    struct ensemble_contacts *s = lanes_wide_array(a, 1, sizeof *s);
    if (s) {
        s->contact = lanes_wide_array(a, m->n_contact, sizeof *s->contact);
        s->runs = arena_alloc(a, (size_t)m->n_contact, sizeof *s->runs);
        s->acting = arena_alloc(a, (size_t)m->n_contact, sizeof *s->acting);
    }
    return arena_failed(a) ? NULL : s;
}

// Contacts of low buildings go together where their law does: a push reaches all floors there.
void ensemble_contacts_fill(struct ensemble_lanes *e, int lane, const struct model *m, int k) {
    const struct link *l = &m->link[k];
    struct closed_contact *g = &e->contacts->contact[k];
    g->apart |= (g->law && g->law != l->law) || !l->law->force_lanes ||
                l->law->n_constant > ENSEMBLE_CONSTANTS;
    g->law = l->law;
    g->index = k;
    for (int i = 0; i < 2; i++) {
        g->building[i] = l->building[i];
        g->apart |=
            l->building[i] != WALL && m->building[l->building[i]].n_dof > INVERSE_FLOORS_MAX;
    }
    for (int i = 0; !g->apart && i < l->law->n_constant; i++) {
        g->constant[i][lane] = l->constant[i];
    }
}

// Finds the floors that feel the force of a contact. It stays apart where those of other runs
// differ.
static void ensemble_reach(struct closed_contact *g, const struct model *m,
                           const struct link_scratch *q) {
    for (int i = 0; i < 2; i++) {
        if (g->building[i] != WALL) {
            const struct building *b = &m->building[g->building[i]];
            const int from = q->first[i] - b->first, beyond = from + q->lanes[i];
            const int to = beyond < b->n_dof ? beyond : b->n_dof;
            g->apart |= g->to[i] != 0 && (g->from[i] != from || g->to[i] != to);
            g->from[i] = from;
            g->to[i] = to;
        }
    }
}

// How the ends of contact k yield, unless that has stayed. False: it is not known, or lanes cannot
// hold it.
static bool ensemble_yields(struct closed_contact *g, int lane, const struct run *r, int k) {
    const struct link_scratch *q = &r->work.link[k];
    if (g->factors[lane] != r->work.factors && q->factors == r->work.factors) {
        g->factors[lane] = q->factors;
        g->flexibility[lane] = q->flexibility;
        g->coupling[lane] = q->coupling;
        g->per_coupling[lane] = q->per_coupling;
        ensemble_reach(g, r->model, q);
    }
    return g->factors[lane] == r->work.factors && !g->apart;
}

// Is closed contact k one that lanes can hold? It has been closed for some steps.
static bool ensemble_contact_suits(const struct ensemble_lanes *e, int lane, const struct run *r,
                                   int k) {
    struct closed_contact *g = &e->contacts->contact[k];
    const struct link_state *l = &r->now->link[k];
    return l->t_close < r->now->time && l->n_past > 0 && !g->apart &&
           r->memory.resolved[k].step == r->work.h && ensemble_yields(g, lane, r, k);
}

// Numbers of a contact in lanes, and where its run has them.
struct contact_number {
    wide *lanes;
    double *own;
};
enum { CONTACT_NUMBERS = 12 + PAST_STEPS };

static void ensemble_contact_list(struct closed_contact *j, const struct run *r, int k,
                                  struct contact_number *list) {
    struct link_state *l = &r->now->link[k];
    struct link_peak *p = &r->results->link[k];
    struct impact *i = &r->results->impact[r->impacts.open[k]];
    const struct contact_number all[CONTACT_NUMBERS] = {
        {&j->before, &l->force},
        {&j->past[0], &l->past[0]},
        {&j->past[1], &l->past[1]},
        {&j->past[2], &l->past[2]},
        {&j->link.impulse, &p->impulse},
        {&j->link.dissipated, &p->dissipated},
        {&j->link.force, &p->force},
        {&j->link.force_time, &p->force_time},
        {&j->deepest, &r->results->deepest[k]},
        {&j->deepest_time, &r->results->deepest_time[k]},
        {&j->impact.impulse, &i->impulse},
        {&j->impact.dissipated, &i->dissipated},
        {&j->impact.peak_force, &i->peak_force},
        {&j->impact.max_penetration, &i->max_penetration},
        {&j->depth, &r->memory.resolved[k].depth},
    };
    memcpy(list, all, sizeof all);
}

// Lists the contacts that are live in some lane.
static void ensemble_list_acting(const struct ensemble_lanes *e) {
    struct ensemble_contacts *s = e->contacts;
    s->n_acting = 0;
    for (int k = 0; k < e->n_contact; k++) {
        if (s->runs[k] != 0) {
            s->acting[s->n_acting++] = k;
        }
    }
}

void ensemble_contacts_enter(struct ensemble_lanes *e, int lane, const struct run *r) {
    struct ensemble_contacts *s = e->contacts;
    const struct state *now = r->now;
    bool all = e->steps->solves && r->model->iterations >= ENSEMBLE_SWEEPS;
    int n_closed = 0;
    for (int i = 0; all && i < now->n_live; i++) {
        const bool closed = now->link[now->live[i]].closed;
        all = !closed || ensemble_contact_suits(e, lane, r, now->live[i]);
        n_closed += closed;
    }
    if (!all || n_closed == 0 || n_closed > SWEEP_GROUP) {
        return;
    }
    for (int i = 0; i < now->n_live; i++) {
        const int k = now->live[i];
        if (now->link[k].closed) {
            struct closed_contact *j = &s->contact[k];
            struct contact_number list[CONTACT_NUMBERS];
            ensemble_contact_list(j, r, k, list);
            for (int q = 0; q < CONTACT_NUMBERS; q++) {
                (*list[q].lanes)[lane] = *list[q].own;
            }
            j->live[lane] = -1;
            j->n_past[lane] = now->link[k].n_past;
            s->runs[k] |= 1U << lane;
            e->gap[k].limit[lane] = INFINITY;
        }
    }
    s->active |= 1U << lane;
    s->tolerance[lane] = r->model->tolerance;
    s->alone[lane] = n_closed == 1 ? -1 : 0;
    s->work[lane] = r->energy.contact;
    s->steps[lane] = s->sweeps[lane] = 0;
    ensemble_list_acting(e);
}

void ensemble_contacts_leave(struct ensemble_lanes *e, int lane, struct run *r) {
    struct ensemble_contacts *s = e->contacts;
    if (!ensemble_has(s->active, lane)) {
        return;
    }
    for (int i = 0; i < s->n_acting; i++) {
        const int k = s->acting[i];
        if (ensemble_has(s->runs[k], lane)) {
            struct closed_contact *j = &s->contact[k];
            struct contact_number list[CONTACT_NUMBERS];
            ensemble_contact_list(j, r, k, list);
            for (int q = 0; q < CONTACT_NUMBERS; q++) {
                *list[q].own = (*list[q].lanes)[lane];
            }
            j->live[lane] = 0;
            r->now->link[k].n_past = (int)j->n_past[lane];
            r->results->impact[r->impacts.open[k]].steps += s->steps[lane];
            s->runs[k] &= ~(1U << lane);
        }
    }
    r->energy.contact = s->work[lane];
    r->results->totals.iterations += s->sweeps[lane];
    r->results->totals.fast += s->steps[lane];
    s->active &= ~(1U << lane);
    ensemble_list_acting(e);
}

void ensemble_contacts_give(struct ensemble_lanes *e, int lane, struct run *r) {
    struct ensemble_contacts *s = e->contacts;
    if (!ensemble_has(s->solved, lane)) {
        return;
    }
    for (int i = 0; i < r->next->n_live; i++) {
        const int k = r->next->live[i];
        r->next->link[k].force = s->contact[k].force[lane];
    }
    r->results->totals.iterations += s->count[lane];
    r->results->totals.fast++;
    s->solved &= ~(1U << lane);
}
