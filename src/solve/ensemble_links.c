// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/ensemble_links.h"

#include <math.h>

#include "solve/contact.h"
#include "solve/event.h"

// The committed state of building k, its trial, and the corrections that it has so far.
static void gather_building(const struct ensemble_lanes *e, int lane, struct run *r, int k) {
    const struct building *g = &r->model->building[k];
    for (int i = g->first; i < g->first + g->n_floor; i++) {
        const struct ensemble_state *s = &e->now[i];
        r->now->u[i] = s->u[lane];
        r->now->v[i] = s->v[lane];
        r->now->a[i] = s->a[lane];
        r->work.correction[i] = e->correction[i][lane];
    }
    floors_trial(&r->work, r->now, k);
}

// The state that they lead to now.
static void scatter_building(struct ensemble_lanes *e, int lane, struct run *r, int k) {
    const struct building *g = &r->model->building[k];
    const struct work *w = &r->work;
    for (int i = g->first; i < g->first + g->n_floor; i++) {
        const double q = w->correction[i];
        const double u = w->u_trial[i] + w->b * q;
        const double v = w->v_trial[i] + w->g * q;
        r->next->v[i] = v;
        e->next[i].u[lane] = u;
        e->next[i].v[lane] = v;
        e->next[i].a[lane] = r->now->a[i] + q;
    }
}

static double penetration(const struct ensemble_lanes *e, int k, const struct ensemble_state *s,
                          int lane) {
    return s[e->end[k][0]].u[lane] - s[e->end[k][1]].u[lane] - e->contact[k].gap[lane];
}

void ensemble_links_begin(struct ensemble_lanes *e, int lane, struct run *r, double start,
                          double end) {
    struct state *next = r->next;
    r->work.strictness = STEP_STRICT;
    contact_begin(&r->work, r->now, next);
    r->now->time = start;
    next->time = end;
    for (int i = 0; i < next->n_live; i++) {
        const int k = next->live[i];
        e->contact[k].limit[lane] = INFINITY;
        e->residual[e->end[k][0]][lane] -= next->force[k];
        e->residual[e->end[k][1]][lane] += next->force[k];
    }
}

void ensemble_links_gather(const struct ensemble_lanes *e, int lane, struct run *r) {
    const struct gaps *g = &r->work.gaps;
    for (int i = 0; i < g->n_touched; i++) {
        gather_building(e, lane, r, g->touched[i]);
    }
}

// Those of a link that no other has touched.
static void gather_ends(const struct ensemble_lanes *e, int lane, struct run *r,
                        const struct link *l) {
    for (int side = 0; side < 2; side++) {
        const int k = l->building[side];
        if (k != WALL && !r->work.gaps.is_touched[k]) {
            gather_building(e, lane, r, k);
        }
    }
}

int ensemble_links_close(struct ensemble_lanes *e, int lane, struct run *r) {
    int n = 0;
    for (int i = 0; i < e->n_pressed; i++) {
        const int k = e->pressed[i].contact;
        if (!(e->pressed[i].lanes >> lane & 1U)) {
            continue;
        }
        gather_ends(e, lane, r, &r->model->link[k]);
        r->now->delta[k] = penetration(e, k, e->now, lane);
        r->next->delta[k] = penetration(e, k, e->next, lane);
        if (contact_close(&r->work, r->now, r->next, k)) {
            e->contact[k].limit[lane] = INFINITY;
            n++;
        }
    }
    return n;
}

int ensemble_links_solve(struct ensemble_lanes *e, int lane, struct run *r) {
    const struct gaps *g = &r->work.gaps;
    if (contact_solve(&r->work, r->now, r->next) != STATUS_OK) {
        return STATUS_RETRY;
    }
    for (int i = 0; i < g->n_touched; i++) {
        scatter_building(e, lane, r, g->touched[i]);
    }
    for (int i = 0; i < r->next->n_live; i++) {
        const int k = r->next->live[i];
        r->next->delta[k] = penetration(e, k, e->next, lane);
    }
    return STATUS_OK;
}

int ensemble_links_finish(struct run *r) {
    struct work *w = &r->work;
    contact_finish(w, r->now, r->next);
    if (event_is_abrupt(w, r->now, r->next)) {
        return STATUS_RETRY;
    }
    return event_first(w, r->now, r->next, w->h, r->events, -1).link < 0 ? STATUS_OK : STATUS_RETRY;
}

int ensemble_links_commit(struct ensemble_lanes *e, int lane, struct run *r) {
    struct state *next = r->next;
    for (int i = 0; i < e->n_pressed; i++) {
        const int k = e->pressed[i].contact;
        if (e->pressed[i].lanes >> lane & 1U) {
            peaks_penetration(r->results, k, next->delta[k], next->time);
        }
    }
    int status =
        impacts_step(&r->impacts, &r->energy, r->results, r->model, r->now, next, r->error);
    r->next = r->now;
    r->now = next;
    ensemble_links_release(e, lane, r);
    return status;
}

void ensemble_links_release(struct ensemble_lanes *e, int lane, const struct run *r) {
    const struct gaps *g = &r->work.gaps;
    for (int i = 0; i < g->n_acting; i++) {
        e->contact[g->acting[i]].limit[lane] = 0.0;
    }
}
