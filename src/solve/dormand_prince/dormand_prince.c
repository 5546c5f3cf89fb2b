// SPDX-License-Identifier: GPL-3.0-or-later
// Dormand & Prince's method with error control, for adaptive analyses: its time loop. A step is
// made as long as the tolerance allows (dp_step.c) and ended at its first event (dp_events.c). It
// is accounted for (dp_account.c, dp_peaks.c), and the event happens at the start of the next one.
#include <math.h>

#include "core/arena.h"
#include "solve/dormand_prince/dp.h"
#include "solve/forcing.h"
#include "solve/run.h"

// Step over the one before it where a force begins with an infinite slope.
static const double WHERE_STEEP = 1e-3;

// More events than this in such a share of the duration do not come from bodies that bounce.
enum { RATTLE = 4000, RATTLE_PER_LINK = 4 };
static const double RATTLE_TIME = 1e-7;

// Of the larger force on both sides: a jump.
static const double JUMP = 1e-9;

static const struct fields_row list[] = {
    FIELD_PART(struct dp, system, dp_system_fields),
    FIELD_PART(struct dp, before, energy_fields),
    FIELD_PART(struct dp, energy, energy_fields),
    FIELD_VALUE(struct dp, h),
    FIELD_PART(struct dp, now, state_fields),
    FIELD_PART(struct dp, next, state_fields),
    FIELD_EACH_PART(struct dp, stage, dp_rates_fields),
    FIELD_ARRAYS(struct dp, rate, FIELD_LINKS),
    FIELD_VALUES(struct dp, fastest.longest, fastest.linked),
    FIELD_VALUE(struct dp, trial),
    FIELD_PART(struct dp, scales, scale_fields),
    FIELD_ARRAY(struct dp, scales.square, FIELD_BUILDINGS),
    FIELD_VALUES(struct dp, noisy, time_before),
    // Scratch.
    FIELD_ARRAYS(struct dp, force, FIELD_FORCES),
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
                     .yielding = &r->forces.yielding,
                     .floors = LANES_WIDEST_OF(&dp_wide, &dp_narrow),
                     .system.forcing.model = m,
                     .last_link = -1};
    if (!fields_alloc(&fields, m, p, a) || !gaps_alloc(&p->gaps, m, r->results, a)) {
        return false;
    }
    p->next.live = p->now.live;  // both ends of a step have the links of its start
    p->next.link = p->now.link;
    p->next.link_history = p->now.link_history;
    return dp_step_alloc(p, a);
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
    dp_bind(&p->stage[0], &p->now);
    dp_bind(&p->stage[DP_LAST], &p->next);
    scale_expect(&p->scales, p->model);
    dp_rates_start(p);
    dp_rates_at(p, p->now.time, DP_ALL, &p->stage[0]);
    dp_step_gaps(p, &p->now, p->rate[0]);
    dp_step_start(p);
    p->grown = p->jumped = true;
    dp_peaks_jump(p);
    p->before = p->energy = r->energy;
}

static int dp_toggle(struct dp *p, int k, struct error *e) {
    struct state *now = &p->now;
    if (now->link[k].closed) {
        state_open_link(now, k);
    } else {
        p->system.phase[k] = PHASE_APPROACH;
        state_close_link(now, p->model, k);
        now->link[k].force = 0.0;  // follows from the branch, and dp_peaks_jump takes it
    }
    return impacts_toggle(p->impacts, now, k, e);
}

// After rigid contacts have met: one that rests is an error, one that has rested and parted at this
// instant is no longer live.
static int dp_part(struct dp *p, struct error *e) {
    const struct model *m = p->model;
    struct state *now = &p->now;
    for (int i = now->n_live - 1; i >= 0; i--) {
        int k = now->live[i];
        if (m->link[k].law->rebound && now->link[k].closed) {
            return error_set(e, STATUS_FAILED,
                             "at t = %.9g %s contact %s comes to rest, which dormand-prince does "
                             "not follow; use integrator newmark or step fixed DT",
                             now->time, m->deck->units.time_name, m->link[k].name);
        }
        if (m->link[k].law->rebound) {
            state_open_link(now, k);
        }
    }
    return STATUS_OK;
}

// Lets the bodies of rigid contact k meet.
static int dp_meet(struct dp *p, int k, struct error *e) {
    const struct model *m = p->model;
    struct state *now = &p->now;
    const struct least_bounce least = {.velocity = m->control.tolerance * p->scales.most_v};
    forcing_at(now, m, now->time);
    impulse_meet(now, m, k, REBOUND_BY_LAW, &least, p->meeting);
    energy_meet(&p->energy, m, now, p->meeting);
    if (dp_part(p, e) != STATUS_OK) {
        return e->status;
    }
    return impacts_meet(p->impacts, now, p->meeting, e);
}

// Changes the branch or the contact of the event.
static int dp_change(struct dp *p, const struct dp_event *event, struct error *e) {
    const int i = event->index;
    p->last_link = dp_events_is_of_storey(event) ? p->last_link : i;
    switch (event->kind) {
        case DP_MEET:
            return dp_meet(p, i, e);
        case DP_CLOSE:
        case DP_OPEN:
            return dp_toggle(p, i, e);
        case DP_TURN:
            p->system.phase[i] = event->direction > 0.0 ? PHASE_APPROACH : PHASE_RELEASE;
            break;
        case DP_BRANCH:
            dp_rates_branch(p, i, event->target, event->direction);
            break;
        case DP_COLLAPSE:
            p->results->collapse =
                (struct collapse){true, i, p->now.time, foundation_across(p->model, i, p->now.u)};
            return STATUS_COLLAPSE;
        case DP_UNLOAD:
            dp_rates_branch(p, i, p->now.drift[i], event->direction);
            break;
        default:
            break;
    }
    return STATUS_OK;
}

static int dp_rattles(struct dp *p, struct error *e) {
    const struct model *m = p->model;
    const struct totals *t = &p->results->totals;
    if (p->now.time - p->time_before > RATTLE_TIME * m->duration) {
        p->time_before = p->now.time;
        p->events_before = t->events;
    }
    if (t->events - p->events_before <= RATTLE + RATTLE_PER_LINK * (long)m->n_link) {
        return STATUS_OK;
    }
    return error_set(e, STATUS_FAILED,
                     "at t = %.9g %s %s rattles: %ld events within %.2g %s; use a softer or a "
                     "damped contact, integrator newmark or step fixed DT",
                     p->now.time, m->deck->units.time_name,
                     p->last_link < 0 ? "a storey" : m->link[p->last_link].name,
                     t->events - p->events_before, p->now.time - p->time_before,
                     m->deck->units.time_name);
}

// Has the velocity of closed contact k, now on the other branch, come to 0 where its force jumps,
// so that either branch leads back there?
static bool dp_sticks(struct dp *p, int k) {
    const struct model *m = p->model;
    enum phase *phase = &p->system.phase[k];
    const int sign = *phase;
    if (p->now.delta[k] <= dp_events_noise(p, k)) {
        return false;  // where d = 0 there is no force
    }
    double change = state_pressing(&p->now, m, k);
    double after = dp_rates_response(p, k, p->now.delta[k], 0.0).force;
    *phase = -*phase;
    double before = dp_rates_response(p, k, p->now.delta[k], 0.0).force;
    *phase = -*phase;
    return sign * change < 0.0 && fabs(after - before) > JUMP * fmax(fabs(after), fabs(before));
}

static int dp_stuck(const struct dp *p, int k, struct error *e) {
    const struct model *m = p->model;
    return error_set(e, STATUS_FAILED,
                     "at t = %.9g %s the bodies of contact %s stick together, where %s jumps at "
                     "v = 0, which dormand-prince does not follow; use integrator newmark or step "
                     "fixed DT",
                     p->now.time, m->deck->units.time_name, m->link[k].name, m->link[k].law->name);
}

// Does a force begin with an infinite slope there? That of a contact may (d^(1/4)), and that of a
// damper with an event at v = 0 does.
static bool dp_is_steep(const struct dp *p, const struct dp_event *event) {
    const struct link *l = event->kind == DP_TURN ? &p->model->link[event->index] : NULL;
    return event->kind == DP_CLOSE || (l && bilateral_is_steep(l->law, l->constant));
}

// Lets p->event happen at `now`, and begins again from there. STATUS_SYSTEM: no memory;
// STATUS_FAILED: what dormand-prince does not follow, or events without end.
static int dp_happen(struct dp *p, struct error *e) {
    const struct dp_event *event = &p->event;
    const int status = dp_change(p, event, e);
    if (status != STATUS_OK) {
        return status;
    }
    p->results->totals.events++;
    if (dp_is_steep(p, event)) {
        p->is_steep = true;
        p->trial *= WHERE_STEEP;
    }
    p->trial = fmax(p->trial, p->model->control.shortest);
    dp_rates_at(p, p->now.time, DP_ALL, &p->stage[0]);
    if (event->kind == DP_TURN && dp_sticks(p, event->index)) {
        return dp_stuck(p, event->index, e);
    }
    dp_step_gaps(p, &p->now, p->rate[0]);
    p->jumped = true;
    return dp_rattles(p, e);
}

// Makes the end of the step the start of the next.
static void dp_swap_ends(struct dp *p) {
    const struct state state = p->now;
    const struct dp_rates rates = p->stage[0];
    double *rate = p->rate[0];
    p->now = p->next;
    p->next = state;
    p->next.storey_history = p->now.storey_history;  // histories and links stay in `now`
    p->now.storey_history = state.storey_history;
    p->now.n_live = state.n_live;
    p->stage[0] = p->stage[DP_LAST];
    p->stage[DP_LAST] = rates;
    p->rate[0] = p->rate[1];
    p->rate[1] = rate;
}

// Does the last step end at a corner of the forcing?
static bool dp_is_at_corner(const struct dp *p) {
    double corner = dp_step_limit(p);
    return p->h > 0.0 && corner - p->next.time <= FORCING_SAME_TIME * corner;
}

// Arrives at the end of the last step, and lets happen there what has to happen.
static int dp_arrive(struct dp *p, struct error *e) {
    if (p->h == 0.0) {
        return STATUS_OK;
    }
    bool turns = dp_is_at_corner(p);
    dp_swap_ends(p);
    p->h = 0.0;
    dp_rates_commit(p);
    if (p->yielding->n > 0) {
        yielding_note(p->yielding, &p->now);
    }
    if (turns) {
        p->now.time = dp_step_limit(p);
        if (forcing_turn(&p->system.forcing, p->now.time)) {
            dp_rates_at(p, p->now.time, DP_ALL, &p->stage[0]);
            p->jumped = true;
        }
    }
    return p->event.kind == DP_NONE ? STATUS_OK : dp_happen(p, e);
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
    if (p->now.time + p->event.place * p->h == p->now.time) {  // no time passes before it
        p->trial = fmin(p->trial, p->h / 2.0);  // in a long one events may undo each other for ever
        p->h = 0.0;
        return dp_happen(p, e);
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

// Makes the state of the run that at `time`, unless the steps to it have failed. Returns `status`.
static int dp_row(struct run *r, double time, int status) {
    if (status == STATUS_OK || status == STATUS_COLLAPSE) {
        if (r->dp->h == 0.0) {
            dp_peaks_jump(r->dp);
        }
        dp_account_row(r->dp, time, r->now, &r->energy);
    }
    return status;
}

// Steps go on beyond the row, whose state is interpolated; one at a jump of the forcing shows what
// is after it.
static int dp_advance(struct run *r, long *n, long end) {
    double time = model_time(r->model, end);
    while (dp_reached(r->dp) < time) {
        int status = dp_step(r->dp, r->error);
        status = status == STATUS_OK ? run_poll(r, dp_reached(r->dp)) : status;
        if (status != STATUS_OK) {
            return dp_row(r, r->dp->now.time, status);
        }
    }
    *n = end;
    const bool arrives =
        dp_is_at_corner(r->dp) && r->dp->next.time - time <= FORCING_SAME_TIME * time;
    return dp_row(r, time, arrives ? dp_arrive(r->dp, r->error) : STATUS_OK);
}

const struct method dormand_prince = {
    .fields = &run_fields,
    .integrator = INTEGRATOR_DORMAND_PRINCE,
    .adaptive = true,
    .alloc = dp_alloc,
    .start = dp_start,
    .advance = dp_advance,
};
