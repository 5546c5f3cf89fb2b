// SPDX-License-Identifier: GPL-3.0-or-later
// Dormand & Prince's method with error control, for adaptive analyses. The time loop within the
// time loop: a step is made as long as the tolerance allows (dp_control.c), taken (dp_stages.c),
// ended at its first event (dp_event.c, dp_locate.c), and accounted for (dp_account.c, dp_peaks.c);
// what happens at the event (dp_happen.c) belongs to the next.
#include <float.h>
#include <math.h>
#include <string.h>

#include "core/arena.h"
#include "core/lanes.h"
#include "solve/dormand_prince/dp_account.h"
#include "solve/dormand_prince/dp_control.h"
#include "solve/dormand_prince/dp_event.h"
#include "solve/dormand_prince/dp_happen.h"
#include "solve/dormand_prince/dp_locate.h"
#include "solve/dormand_prince/dp_peaks.h"
#include "solve/dormand_prince/dp_stages.h"
#include "solve/method.h"

// Times that differ by less than this share of them are the same: of steps, corners and rows.
static const double SAME_TIME = 8.0 * DBL_EPSILON;

static bool alloc(struct run *r, struct arena *a) {
    const struct model *m = r->model;
    size_t n_rate = (size_t)m->n_link + LANES_WIDTH;
    struct dp *p = arena_alloc(a, 1, sizeof *p);
    if (!p) {
        return false;
    }
    r->dp = p;
    *p = (struct dp){.model = m, .results = r->results, .impacts = &r->impacts, .last_link = -1};
    p->floors = LANES_WIDEST_OF(&dp_wide, &dp_narrow);
    p->rate[0] = arena_alloc(a, n_rate, sizeof(double));
    p->rate[1] = arena_alloc(a, n_rate, sizeof(double));
    p->reach = arena_alloc(a, n_rate, sizeof(double));
    p->meeting = arena_alloc(a, (size_t)m->n_contact, sizeof *p->meeting);
    for (int s = 0; s < DP_STAGES; s++) {
        dp_rates_alloc(&p->rates[s], m, a);
    }
    return gaps_alloc(&p->gaps, m, a) && scale_alloc(&p->scales, m, a) &&
           dp_system_alloc(&p->system, m, a) && state_alloc(&p->now, m, a) &&
           state_alloc(&p->next, m, a);
}

// The first and the last stage stand at the ends of the step.
static void bind(struct dp *p) {
    const struct state *end[2] = {&p->now, &p->next};
    for (int s = 0; s < DP_STAGES; s++) {
        p->stage[s] = &p->rates[s];
    }
    for (int i = 0; i < 2; i++) {
        struct dp_rates *r = p->stage[i == 0 ? 0 : DP_STAGES - 1];
        r->u = end[i]->u;
        r->v = end[i]->v;
        r->a = end[i]->a;
        r->ground = (struct forcing_values){end[i]->ground_a, end[i]->ground_v, end[i]->ground_u};
    }
}

// Makes the state of the run that of the integrator. Rigid contacts that are pressed together at
// the start meet there at once, which is an error.
static void adopt(struct dp *p, const struct state *start) {
    const struct model *m = p->model;
    struct state *now = &p->now;
    size_t n_dof = (size_t)m->n_dof * sizeof(double);
    now->time = start->time;
    memcpy(now->u, start->u, n_dof);
    memcpy(now->v, start->v, n_dof);
    memcpy(now->drift, start->drift, n_dof);
    memcpy(now->delta, start->delta, (size_t)m->n_link * sizeof *now->delta);
    for (int i = 0; i < start->n_live; i++) {
        state_enliven(now, start->live[i]);
    }
    memcpy(now->link, start->link, (size_t)m->n_link * sizeof *now->link);
    state_open_where(now, m, state_rests);
    memcpy(now->ground_v, start->ground_v, (size_t)m->n_ground * sizeof *now->ground_v);
    memcpy(now->storey_history, start->storey_history,
           (size_t)m->n_storey_history * sizeof(double));
    memcpy(now->link_history, start->link_history, (size_t)m->n_link_history * sizeof(double));
}

static void start(struct run *r) {
    struct dp *p = r->dp;
    struct state *now = &p->now;
    adopt(p, r->now);
    bind(p);
    dp_system_start(&p->system, now);
    dp_stages_first(p);
    dp_stages_gaps(p, now, p->rate[0]);
    scale_expect(&p->scales, p->model);
    p->grown = p->jumped = true;
    dp_peaks_jump(p);
    p->energy = r->energy;
    dp_control_start(p);
}

static void swap(double **x, double **y) {
    double *z = *x;
    *x = *y;
    *y = z;
}

// Makes the end of the step the start of the next.
static void swap_ends(struct dp *p) {
    struct state *now = &p->now;
    struct state *next = &p->next;
    double **of_now[] = {&now->u,     &now->v,        &now->a,        &now->drift,
                         &now->delta, &now->ground_a, &now->ground_v, &now->ground_u};
    double **of_next[] = {&next->u,     &next->v,        &next->a,        &next->drift,
                          &next->delta, &next->ground_a, &next->ground_v, &next->ground_u};
    for (size_t i = 0; i < sizeof of_now / sizeof of_now[0]; i++) {
        swap(of_now[i], of_next[i]);
    }
    swap(&p->rate[0], &p->rate[1]);
    struct dp_rates *first = p->stage[0];
    p->stage[0] = p->stage[DP_STAGES - 1];
    p->stage[DP_STAGES - 1] = first;
    now->time = next->time;
}

// Does the last step end at a corner of the forcing?
static bool is_at_corner(const struct dp *p) {
    double corner = dp_control_limit(p);
    return p->h > 0.0 && corner - p->next.time <= SAME_TIME * corner;
}

// Arrives at the end of the last step, and lets happen there what has to happen.
static int arrive(struct dp *p, struct error *e) {
    if (p->h == 0.0) {
        return STATUS_OK;
    }
    bool turns = is_at_corner(p);
    swap_ends(p);
    p->h = 0.0;
    dp_system_commit(&p->system, &p->now);
    if (turns) {
        p->now.time = dp_control_limit(p);
        if (forcing_turn(&p->system.forcing, p->now.time)) {
            dp_stages_first(p);
            p->jumped = true;
        }
    }
    return p->event.kind == DP_NONE ? STATUS_OK : dp_happen(p, e);
}

// Does the event come before any time has passed?
static bool at_once(const struct dp *p) {
    return p->event.kind != DP_NONE && p->now.time + p->event.place * p->h == p->now.time;
}

// Takes the step back, and lets its event happen where it would have begun.
static int happen_at_once(struct dp *p, struct error *e) {
    p->trial = fmin(p->trial, p->h / 2.0);  // in a long one events may undo each other for ever
    p->h = 0.0;
    return dp_happen(p, e);
}

// Makes the step end at its event. It is part of one that met the tolerance, but beyond the event
// the laws are not what they were, and may have made up for an error before it: then the step is
// rejected. *taken: it is not.
static int stop_at_event(struct dp *p, bool *taken, struct error *e) {
    dp_locate(p);
    double error = dp_control_error(p);
    *taken = error <= 1.0;
    return *taken ? STATUS_OK : dp_control_reject(p, error, e);
}

// Tries a step up to its first event, if there is any. *taken: that is the step.
static int try(struct dp *p, bool *taken, struct error *e) {
    if (dp_control_attempt(p, e) != STATUS_OK) {
        return e->status;
    }
    dp_stages_gaps(p, &p->next, p->rate[1]);
    dp_event_first(p);
    if (at_once(p)) {
        return happen_at_once(p, e);
    }
    if (p->event.kind != DP_NONE) {
        return stop_at_event(p, taken, e);
    }
    *taken = true;
    return STATUS_OK;
}

static int step(struct dp *p, struct error *e) {
    int status = arrive(p, e);
    for (bool taken = false; status == STATUS_OK && !taken;) {
        status = try(p, &taken, e);
    }
    if (status != STATUS_OK) {
        return status;
    }
    dp_peaks_jump(p);
    dp_account_step(p);
    dp_peaks_step(p);
    p->is_steep = false;
    p->results->totals.steps++;
    return STATUS_OK;
}

// The time that has been reached.
static double reached(const struct dp *p) {
    return p->h > 0.0 ? p->next.time : p->now.time;
}

// Steps go on beyond the row, whose state is interpolated; one at a jump of the forcing shows what
// is after it.
static int advance(struct run *r, long *n, long end) {
    double time = model_time(r->model, end);
    while (reached(r->dp) < time) {
        int status = step(r->dp, r->error);
        status = status == STATUS_OK ? run_poll(r, reached(r->dp)) : status;
        if (status != STATUS_OK) {
            return status;
        }
    }
    *n = end;
    if (is_at_corner(r->dp) && r->dp->next.time - time <= SAME_TIME * time &&
        arrive(r->dp, r->error) != STATUS_OK) {
        return r->error->status;
    }
    if (r->dp->h == 0.0) {
        dp_peaks_jump(r->dp);
    }
    dp_account_row(r->dp, time, r->now, &r->energy);
    return STATUS_OK;
}

const struct method dormand_prince = {
    .integrator = INTEGRATOR_DORMAND_PRINCE,
    .adaptive = true,
    .alloc = alloc,
    .start = start,
    .advance = advance,
};
