// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/ensemble/ensemble_links.h"

#include <math.h>

#include "solve/account/peaks.h"
#include "solve/contact/contact.h"

// Copies the trial and the corrections of building k from the lane to the run.
static void show_building(const struct ensemble_lanes *e, int lane, const struct run *r, int k) {
    const struct building *g = e->building[k].shape;
    for (int i = g->first; i < g->first + g->n_floor; i++) {
        r->work.u_trial[i] = e->trial[i].u[lane];
        r->work.v_trial[i] = e->trial[i].v[lane];
        r->work.correction[i] = e->correction[i][lane];
    }
}

// Takes the corrections of building k from the run.
static void push_building(const struct ensemble_lanes *e, int lane, const struct run *r, int k) {
    const struct building *g = e->building[k].shape;
    for (int i = g->first; i < g->first + g->n_floor; i++) {
        e->correction[i][lane] = r->work.correction[i];
    }
    e->building[k].pushed = true;
}

// The same for both buildings of contact k.
static void show_ends(const struct ensemble_lanes *e, int lane, const struct run *r, int k) {
    for (int side = 0; side < 2; side++) {
        const int b = r->model->link[k].building[side];
        if (b != WALL) {
            show_building(e, lane, r, b);
        }
    }
}

// The velocities of both ends of contact k.
static void gather_velocities(const struct ensemble_lanes *e, int k, const struct ensemble_state *s,
                              int lane, double *v) {
    for (int i = 0; i < 2; i++) {
        v[e->end[k][i]] = s[e->end[k][i]].v[lane];
    }
}

static double penetration(const struct ensemble_lanes *e, int k, const struct ensemble_state *s,
                          int lane) {
    return s[e->end[k][0]].u[lane] - s[e->end[k][1]].u[lane] - e->gap[k].width[lane];
}

// Penetrations, and velocities of the ends, of the live links of `to` in a state of the lane.
static void gather_ends(const struct ensemble_lanes *e, const struct ensemble_state *s, int lane,
                        struct state *to) {
    for (int i = 0; i < to->n_live; i++) {
        const int k = to->live[i];
        to->delta[k] = penetration(e, k, s, lane);
        gather_velocities(e, k, s, lane, to->v);
    }
}

void ensemble_links_recall(const struct ensemble_lanes *e, int lane, const struct run *r) {
    gather_ends(e, e->now, lane, r->now);
}

void ensemble_links_begin(struct ensemble_lanes *e, int lane, struct run *r, double start,
                          double end) {
    struct state *next = r->next;
    r->work.strictness = STEP_STRICT;
    r->now->time = start;
    next->time = end;
    contact_begin(&r->work, r->now, next);
    for (int i = 0; i < next->n_live; i++) {
        e->gap[next->live[i]].limit[lane] = INFINITY;
    }
}

void ensemble_links_push(struct ensemble_lanes *e, int lane, const struct run *r) {
    for (int i = 0; i < r->next->n_live; i++) {
        const int k = r->next->live[i];
        e->acts[k] = true;
        e->force[k][lane] = r->next->link[k].force;
    }
}

int ensemble_links_close(struct ensemble_lanes *e, int lane, struct run *r) {
    int n = 0;
    for (int i = 0; i < e->n_pressed; i++) {
        const int k = e->pressed[i].contact;
        if (!ensemble_has(e->pressed[i].closed, lane)) {
            continue;
        }
        show_ends(e, lane, r, k);
        gather_velocities(e, k, e->now, lane, r->now->v);
        r->now->delta[k] = penetration(e, k, e->now, lane);
        r->next->delta[k] = penetration(e, k, e->next, lane);
        if (contact_close(&r->work, r->now, r->next, k)) {
            e->gap[k].limit[lane] = INFINITY;
            n++;
        }
    }
    return n;
}

int ensemble_links_solve(struct ensemble_lanes *e, int lane, struct run *r) {
    const struct gaps *g = &r->work.gaps;
    for (int i = 0; i < g->n_touched; i++) {
        show_building(e, lane, r, g->touched[i]);
    }
    if (contact_solve(&r->work, r->now, r->next) != STATUS_OK) {
        return STATUS_RETRY;
    }
    for (int i = 0; i < g->n_touched; i++) {
        push_building(e, lane, r, g->touched[i]);
    }
    return STATUS_OK;
}

int ensemble_links_finish(const struct ensemble_lanes *e, int lane, struct run *r) {
    struct work *w = &r->work;
    gather_ends(e, e->next, lane, r->next);
    contact_finish(w, r->next);
    return event_first(w, r->now, r->next, w->h, r->events, -1).link < 0 ? STATUS_OK : STATUS_RETRY;
}

int ensemble_links_commit(struct ensemble_lanes *e, int lane, struct run *r) {
    struct state *next = r->next;
    for (int i = 0; i < e->n_pressed; i++) {
        const int k = e->pressed[i].contact;
        if (ensemble_has(e->pressed[i].closed, lane)) {
            peaks_penetration(r->results, k, next->delta[k], next->time);
        }
    }
    int status = impacts_step(&r->impacts, r->now, next, r->error);
    r->next = r->now;
    r->now = next;
    ensemble_links_release(e, lane, r);
    return status;
}

void ensemble_links_release(struct ensemble_lanes *e, int lane, const struct run *r) {
    const struct gaps *g = &r->work.gaps;
    for (int i = 0; i < g->n_acting; i++) {
        e->gap[g->acting[i]].limit[lane] = e->nearest[g->acting[i]].depth[lane];
    }
}
