// SPDX-License-Identifier: GPL-3.0-or-later
// Contacts on their way into lanes and back.
#include <math.h>

#include "core/arena.h"
#include "solve/contact/sweep.h"
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
            l->building[i] != WALL && m->building[l->building[i]].n_floor > INVERSE_FLOORS_MAX;
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
            const int to = beyond < b->n_floor ? beyond : b->n_floor;
            g->apart |= g->to[i] != 0 && (g->from[i] != from || g->to[i] != to);
            g->from[i] = from;
            g->to[i] = to;
        }
    }
}

// Is closed contact k one that lanes can hold? It has been closed for some steps, and how its ends
// yield is known.
static bool ensemble_contact_suits(struct ensemble_lanes *e, const struct run *r, int k) {
    struct closed_contact *g = &e->contacts->contact[k];
    const struct link_state *l = &r->now->link[k];
    const struct link_scratch *q = &r->work.link[k];
    if (!(l->t_close < r->now->time) || l->n_past == 0 || g->apart ||
        r->memory.resolved[k].step != r->work.h || q->factors != r->work.factors) {
        return false;
    }
    ensemble_reach(g, r->model, q);
    return !g->apart;
}

enum { CONTACT_NUMBERS = 16 };

// What the lanes hold of contact k of a run that changes there, and how its ends yield.
static void ensemble_contact_list(struct closed_contact *j, const struct run *r, int k,
                                  struct ensemble_copy *list) {
    struct link_state *l = &r->now->link[k];
    struct link_peak *p = &r->results->link[k];
    struct impact *i = &r->results->impact[r->impacts.open[k]];
    struct link_scratch *q = &r->work.link[k];
    const struct ensemble_copy all[CONTACT_NUMBERS] = {
        {&j->before, &l->force, 1, 1},
        {j->past, l->past, PAST_STEPS, 1},
        {&j->link.impulse, &p->impulse, 1, 1},
        {&j->link.dissipated, &p->dissipated, 1, 1},
        {&j->link.force, &p->force, 1, 1},
        {&j->link.force_time, &p->force_time, 1, 1},
        {&j->deepest, &r->results->deepest[k], 1, 1},
        {&j->deepest_time, &r->results->deepest_time[k], 1, 1},
        {&j->impact.impulse, &i->impulse, 1, 1},
        {&j->impact.dissipated, &i->dissipated, 1, 1},
        {&j->impact.peak_force, &i->peak_force, 1, 1},
        {&j->impact.max_penetration, &i->max_penetration, 1, 1},
        {&j->depth, &r->memory.resolved[k].depth, 1, 1},
        {&j->flexibility, &q->flexibility, 1, 1},
        {&j->coupling, &q->coupling, 1, 1},
        {&j->per_coupling, &q->per_coupling, 1, 1},
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
        all = !closed || ensemble_contact_suits(e, r, now->live[i]);
        n_closed += closed;
    }
    if (!all || n_closed == 0 || n_closed > SWEEP_GROUP) {
        return;
    }
    for (int i = 0; i < now->n_live; i++) {
        const int k = now->live[i];
        if (now->link[k].closed) {
            struct closed_contact *j = &s->contact[k];
            struct ensemble_copy list[CONTACT_NUMBERS];
            ensemble_contact_list(j, r, k, list);
            ensemble_copy_in(list, CONTACT_NUMBERS, lane);
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
            struct ensemble_copy list[CONTACT_NUMBERS];
            ensemble_contact_list(j, r, k, list);
            ensemble_copy_out(list, CONTACT_NUMBERS, lane);
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
