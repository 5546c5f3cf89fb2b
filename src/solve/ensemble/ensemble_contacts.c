// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/ensemble/ensemble_contacts.h"

#include <assert.h>
#include <math.h>
#include <string.h>

#include "core/arena.h"
#include "solve/contact/sweep.h"

struct ensemble_contacts *ensemble_contacts_create(const struct model *m, struct arena *a) {
    struct ensemble_contacts *s = lanes_wide_array(a, 1, sizeof *s);
    if (s) {
        s->contact = lanes_wide_array(a, m->n_contact, sizeof *s->contact);
        s->runs = arena_alloc(a, (size_t)m->n_contact, sizeof *s->runs);
        s->acting = arena_alloc(a, (size_t)m->n_contact, sizeof *s->acting);
        s->touched = arena_alloc(a, (size_t)m->n_building, sizeof *s->touched);
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

// Finds the floors that feel the force of a contact; false: those of other runs differ.
static bool ensemble_reaches(struct closed_contact *g, const struct ensemble_building *building,
                             const struct link_scratch *q) {
    bool same = true;
    for (int i = 0; i < 2; i++) {
        if (g->building[i] != WALL) {
            const struct building *b = building[g->building[i]].shape;
            const int from = q->first[i] - b->first, beyond = from + q->lanes[i];
            const int to = beyond < b->n_floor ? beyond : b->n_floor;
            same = same && (g->to[i] == 0 || (g->from[i] == from && g->to[i] == to));
            g->from[i] = from;
            g->to[i] = to;
        }
    }
    return same;
}

// How the ends of contact k yield, unless that has stayed; false: it is not known.
static bool ensemble_yields(struct ensemble_lanes *e, int k, int lane, const struct work *w) {
    struct closed_contact *g = &e->contacts->contact[k];
    const struct link_scratch *q = &w->link[k];
    if (g->factors[lane] != w->factors && q->factors == w->factors) {
        g->factors[lane] = w->factors;
        g->flexibility[lane] = q->flexibility;
        g->coupling[lane] = q->coupling;
        g->per_coupling[lane] = q->per_coupling;
        g->apart |= !ensemble_reaches(g, e->building, q);
    }
    return g->factors[lane] == w->factors && !g->apart;
}

// Is live contact k one that lanes can hold?
static bool ensemble_contact_suits(struct ensemble_lanes *e, int lane, const struct run *r, int k) {
    const struct link_state *l = &r->now->link[k];
    return l->t_close < r->now->time && l->n_past > 0 && !e->contacts->contact[k].apart &&
           r->memory.resolved[k].step == r->work.h && ensemble_yields(e, k, lane, &r->work);
}

// Numbers of a contact in lanes, and where its run has them.
struct lane_number {
    wide *lanes;
    double *own;
};
enum { CONTACT_NUMBERS = 12 + PAST_STEPS };

static void ensemble_contact_numbers(struct closed_contact *j, const struct run *r, int k,
                                     struct lane_number *number) {
    struct link_state *l = &r->now->link[k];
    struct link_peak *p = &r->results->link[k];
    struct impact *i = &r->results->impact[r->impacts.open[k]];
    const struct lane_number all[] = {
        {&j->before, &l->force},
        {&j->past[0], &l->past[0]},
        {&j->past[1], &l->past[1]},
        {&j->past[2], &l->past[2]},
        {&j->impulse, &p->impulse},
        {&j->work, &p->dissipated},
        {&j->peak_force, &p->force},
        {&j->peak_force_time, &p->force_time},
        {&j->deepest, &r->results->deepest[k]},
        {&j->deepest_time, &r->results->deepest_time[k]},
        {&j->impact_impulse, &i->impulse},
        {&j->impact_work, &i->dissipated},
        {&j->impact_force, &i->peak_force},
        {&j->impact_depth, &i->max_penetration},
        {&j->depth, &r->memory.resolved[k].depth},
    };
    static_assert(sizeof all / sizeof all[0] == CONTACT_NUMBERS, "all of them");
    memcpy(number, all, sizeof all);
}

static void ensemble_put_in(struct closed_contact *j, int lane, const struct run *r, int k) {
    struct lane_number number[CONTACT_NUMBERS];
    ensemble_contact_numbers(j, r, k, number);
    for (int i = 0; i < CONTACT_NUMBERS; i++) {
        (*number[i].lanes)[lane] = *number[i].own;
    }
    j->live[lane] = -1;
    j->n_past[lane] = r->now->link[k].n_past;
}

static void ensemble_take_out(struct closed_contact *j, int lane, const struct run *r, int k,
                              long n_step) {
    struct lane_number number[CONTACT_NUMBERS];
    ensemble_contact_numbers(j, r, k, number);
    for (int i = 0; i < CONTACT_NUMBERS; i++) {
        *number[i].own = (*number[i].lanes)[lane];
    }
    j->live[lane] = 0;
    r->now->link[k].n_past = (int)j->n_past[lane];
    r->results->impact[r->impacts.open[k]].steps += n_step;
}

static void ensemble_touch(struct ensemble_contacts *s, int building) {
    int i = 0;
    while (i < s->n_touched && s->touched[i] != building) {
        i++;
    }
    if (building != WALL && i == s->n_touched) {
        s->touched[s->n_touched++] = building;
    }
}

// Lists contacts that are live in some lane, and their buildings.
static void ensemble_list_acting(struct ensemble_lanes *e) {
    struct ensemble_contacts *s = e->contacts;
    s->n_acting = s->n_touched = 0;
    for (int k = 0; k < e->n_contact; k++) {
        if (s->runs[k] != 0) {
            s->acting[s->n_acting++] = k;
            ensemble_touch(s, e->contacts->contact[k].building[0]);
            ensemble_touch(s, e->contacts->contact[k].building[1]);
        }
    }
}

void ensemble_contacts_enter(struct ensemble_lanes *e, int lane, const struct run *r) {
    struct ensemble_contacts *s = e->contacts;
    const struct state *now = r->now;
    bool all = e->steps->solve && r->model->iterations >= ENSEMBLE_SWEEPS;
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
            ensemble_put_in(&s->contact[k], lane, r, k);
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
    const struct state *now = r->now;
    for (int i = 0; i < now->n_live; i++) {
        const int k = now->live[i];
        if (now->link[k].closed) {
            ensemble_take_out(&s->contact[k], lane, r, k, s->steps[lane]);
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

void ensemble_contacts_work(const struct ensemble_lanes *e, int lane, struct energy_account *a) {
    a->contact = ensemble_has(e->contacts->active, lane) ? e->contacts->work[lane] : a->contact;
}
