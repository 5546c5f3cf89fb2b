// SPDX-License-Identifier: GPL-3.0-or-later
// Dormand & Prince's method with error control, for adaptive analyses. The time loop within the
// time loop: a step is made as long as the tolerance allows and taken (dp_step.c), ended at its
// first event (dp_events.c), and accounted for (dp_account.c, dp_peaks.c); what happens at the
// event (dp_happen.c) belongs to the next.
#include <float.h>
#include <math.h>

#include "core/arena.h"
#include "solve/dormand_prince/dp.h"
#include "solve/method.h"

// Times that differ by less than this share of them are the same: of steps, corners and rows.
static const double SAME_TIME = 8.0 * DBL_EPSILON;

static const struct fields_row list[] = {
    FIELD_PART(struct dp, system, dp_system_fields),
    FIELD_PART(struct dp, before, energy_fields),
    FIELD_PART(struct dp, energy, energy_fields),
    FIELD_VALUE(struct dp, h),
    FIELD_PART(struct dp, now, state_fields),
    FIELD_PART(struct dp, next, state_fields),
    FIELD_PARTS(struct dp, stage[0], FIELD_AT, dp_rates_fields),
    FIELD_PARTS(struct dp, stage[1], FIELD_AT, dp_rates_fields),
    FIELD_PARTS(struct dp, stage[2], FIELD_AT, dp_rates_fields),
    FIELD_PARTS(struct dp, stage[3], FIELD_AT, dp_rates_fields),
    FIELD_PARTS(struct dp, stage[4], FIELD_AT, dp_rates_fields),
    FIELD_PARTS(struct dp, stage[5], FIELD_AT, dp_rates_fields),
    FIELD_PARTS(struct dp, stage[6], FIELD_AT, dp_rates_fields),
    FIELD_ARRAY(struct dp, rate[0], FIELD_LINKS),
    FIELD_ARRAY(struct dp, rate[1], FIELD_LINKS),
    FIELD_VALUE(struct dp, fastest.longest),
    FIELD_VALUE(struct dp, fastest.linked),
    FIELD_VALUE(struct dp, trial),
    FIELD_PART(struct dp, scales, scale_fields),
    FIELD_ARRAY(struct dp, scales.square, FIELD_BUILDINGS),
    FIELD_VALUE(struct dp, noisy),
    FIELD_VALUE(struct dp, grown),
    FIELD_VALUE(struct dp, jumped),
    FIELD_VALUE(struct dp, is_steep),
    FIELD_VALUE(struct dp, pace),
    FIELD_VALUE(struct dp, event),
    FIELD_VALUE(struct dp, last_link),
    FIELD_VALUE(struct dp, events_before),
    FIELD_VALUE(struct dp, time_before),
    // Scratch.
    FIELD_ARRAY(struct dp, reach, FIELD_LINKS),
    FIELD_ARRAY(struct dp, meeting, FIELD_LINKS),
    FIELD_ARRAY(struct dp, fastest.spring, FIELD_FLOORS),
    FIELD_ARRAY(struct dp, fastest.dashpot, FIELD_FLOORS),
};
static const struct fields fields = FIELDS(list);
static const struct fields_row of_run[] = {FIELD_PARTS(struct run, dp, FIELD_AT, fields)};
static const struct fields run_fields = FIELDS(of_run);

static bool dp_alloc(struct run *r, struct arena *a) {
    const struct model *m = r->model;
    struct dp *p = arena_alloc(a, 1, sizeof *p);
    if (!p) {
        return false;
    }
    r->dp = p;
    *p = (struct dp){.model = m,
                     .results = r->results,
                     .impacts = &r->impacts,
                     .floors = LANES_WIDEST_OF(&dp_wide, &dp_narrow),
                     .last_link = -1};
    forcing_init(&p->system.forcing, m);
    for (int s = 0; s < DP_STAGES; s++) {
        fields_alloc(&dp_rates_fields, m, &p->rates[s], a);
        p->stage[s] = &p->rates[s];
    }
    return fields_alloc(&fields, m, p, a) && gaps_alloc(&p->gaps, m, r->results, a) &&
           dp_step_alloc(p, a);
}

// The first and the last stage stand at the ends of the step.
static void dp_bind(struct dp_rates *r, const struct state *end) {
    r->u = end->u;
    r->v = end->v;
    r->a = end->a;
    r->ground = (struct forcing_values){end->ground_a, end->ground_v, end->ground_u};
}

// Begins at the state of the run. Rigid contacts that are pressed together there meet at once,
// which is an error.
static void dp_start(struct run *r) {
    struct dp *p = r->dp;
    fields_copy(&state_fields, p->model, &p->now, r->now);
    state_open_where(&p->now, p->model, state_rests);
    dp_bind(p->stage[0], &p->now);
    dp_bind(p->stage[DP_STAGES - 1], &p->next);
    dp_system_start(p);
    dp_step_first(p);
    dp_step_gaps(p, &p->now, p->rate[0]);
    dp_step_start(p);
    scale_expect(&p->scales, p->model);
    p->grown = p->jumped = true;
    dp_peaks_jump(p);
    p->before = p->energy = r->energy;
}

static void dp_swap(double **x, double **y) {
    double *z = *x;
    *x = *y;
    *y = z;
}

// Makes the end of the step the start of the next. Histories and links stay in `now`.
static void dp_swap_ends(struct dp *p) {
    static const size_t swapped[] = {
        offsetof(struct state, u),        offsetof(struct state, v),
        offsetof(struct state, a),        offsetof(struct state, drift),
        offsetof(struct state, delta),    offsetof(struct state, ground_a),
        offsetof(struct state, ground_v), offsetof(struct state, ground_u)};
    for (size_t i = 0; i < sizeof swapped / sizeof swapped[0]; i++) {
        dp_swap((double **)((char *)&p->now + swapped[i]),
                (double **)((char *)&p->next + swapped[i]));
    }
    dp_swap(&p->rate[0], &p->rate[1]);
    struct dp_rates *first = p->stage[0];
    p->stage[0] = p->stage[DP_STAGES - 1];
    p->stage[DP_STAGES - 1] = first;
    p->now.time = p->next.time;
}

// Does the last step end at a corner of the forcing?
static bool dp_is_at_corner(const struct dp *p) {
    double corner = dp_step_limit(p);
    return p->h > 0.0 && corner - p->next.time <= SAME_TIME * corner;
}

// Arrives at the end of the last step, and lets happen there what has to happen.
static int dp_arrive(struct dp *p, struct error *e) {
    if (p->h == 0.0) {
        return STATUS_OK;
    }
    bool turns = dp_is_at_corner(p);
    dp_swap_ends(p);
    p->h = 0.0;
    dp_system_commit(p);
    if (turns) {
        p->now.time = dp_step_limit(p);
        if (forcing_turn(&p->system.forcing, p->now.time)) {
            dp_step_first(p);
            p->jumped = true;
        }
    }
    return p->event.kind == DP_NONE ? STATUS_OK : dp_happen(p, e);
}

// Lets the event of a step happen where the step would have begun, as no time passes before it.
static int dp_happen_at_once(struct dp *p, struct error *e) {
    p->trial = fmin(p->trial, p->h / 2.0);  // in a long one events may undo each other for ever
    p->h = 0.0;
    return dp_happen(p, e);
}

// Tries a step up to its first event, if there is any. *taken: that is the step.
static int dp_try(struct dp *p, bool *taken, struct error *e) {
    if (dp_step_attempt(p, e) != STATUS_OK) {
        return e->status;
    }
    dp_step_gaps(p, &p->next, p->rate[1]);
    dp_events_first(p);
    *taken = p->event.kind == DP_NONE;
    if (*taken) {
        return STATUS_OK;
    }
    if (p->now.time + p->event.place * p->h == p->now.time) {
        return dp_happen_at_once(p, e);
    }
    dp_events_locate(p);
    // The step is part of one that met the tolerance. But beyond the event the laws are not what
    // they were, and may have made up for an error before it.
    const double error = dp_step_error(p);
    *taken = error <= 1.0;
    return *taken ? STATUS_OK : dp_step_reject(p, error, e);
}

static int dp_step(struct dp *p, struct error *e) {
    int status = dp_arrive(p, e);
    for (bool taken = false; status == STATUS_OK && !taken;) {
        status = dp_try(p, &taken, e);
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
static double dp_reached(const struct dp *p) {
    return p->h > 0.0 ? p->next.time : p->now.time;
}

// Steps go on beyond the row, whose state is interpolated; one at a jump of the forcing shows what
// is after it.
static int dp_advance(struct run *r, long *n, long end) {
    double time = model_time(r->model, end);
    while (dp_reached(r->dp) < time) {
        int status = dp_step(r->dp, r->error);
        status = status == STATUS_OK ? run_poll(r, dp_reached(r->dp)) : status;
        if (status != STATUS_OK) {
            return status;
        }
    }
    *n = end;
    if (dp_is_at_corner(r->dp) && r->dp->next.time - time <= SAME_TIME * time &&
        dp_arrive(r->dp, r->error) != STATUS_OK) {
        return r->error->status;
    }
    if (r->dp->h == 0.0) {
        dp_peaks_jump(r->dp);
    }
    dp_account_row(r->dp, time, r->now, &r->energy);
    return STATUS_OK;
}

const struct method dormand_prince = {
    .fields = &run_fields,
    .integrator = INTEGRATOR_DORMAND_PRINCE,
    .adaptive = true,
    .alloc = dp_alloc,
    .start = dp_start,
    .advance = dp_advance,
};
