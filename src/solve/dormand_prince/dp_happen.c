// SPDX-License-Identifier: GPL-3.0-or-later
// What happens at the event that ended a step.
#include <math.h>

#include "solve/dormand_prince/dp.h"
#include "solve/excitation.h"

// Step over the one before it where a force begins with an infinite slope.
static const double WHERE_STEEP = 1e-3;

// More events than this in such a share of the duration do not come from bodies that bounce.
enum { RATTLE = 4000, RATTLE_PER_LINK = 4 };
static const double RATTLE_TIME = 1e-7;

// Of the larger force on both sides: a jump.
static const double JUMP = 1e-9;

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
    excitation_at(now, m, now->time);
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
            dp_system_branch(p, i, event->target, event->direction);
            break;
        case DP_UNLOAD:
            dp_system_branch(p, i, p->now.drift[i], event->direction);
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
    if (p->now.delta[k] <= dp_motion_noise(p, k)) {
        return false;  // where d = 0 there is no force
    }
    double change = dp_system_across(&m->link[k], m, p->now.a, p->now.ground_a);
    double after = dp_system_response(p, k, p->now.delta[k], 0.0).force;
    *phase = -*phase;
    double before = dp_system_response(p, k, p->now.delta[k], 0.0).force;
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
    bool turns = event->kind == DP_TURN && p->model->link[event->index].bilateral;
    return event->kind == DP_CLOSE || turns;
}

int dp_happen(struct dp *p, struct error *e) {
    const struct dp_event *event = &p->event;
    if (dp_change(p, event, e) != STATUS_OK) {
        return e->status;
    }
    p->results->totals.events++;
    if (dp_is_steep(p, event)) {
        p->is_steep = true;
        p->trial *= WHERE_STEEP;
    }
    p->trial = fmax(p->trial, p->model->control.shortest);
    dp_step_first(p);
    if (event->kind == DP_TURN && dp_sticks(p, event->index)) {
        return dp_stuck(p, event->index, e);
    }
    dp_step_gaps(p, &p->now, p->rate[0]);
    p->jumped = true;
    return dp_rattles(p, e);
}
