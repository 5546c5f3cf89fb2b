// SPDX-License-Identifier: GPL-3.0-or-later
// A step of Newmark's method: taken, committed and accounted for, and split where forces jump or
// bodies meet.
#include <math.h>
#include <string.h>

#include "core/arena.h"
#include "core/root.h"
#include "solve/account/peaks.h"
#include "solve/newmark/event.h"
#include "solve/newmark/newmark.h"
#include "solve/run.h"

// Attempts to locate an event, and how near d = 0 is near enough, as a share of the way that the
// link would go in the whole step. It is finer for rigid contacts, which keep that penetration.
enum { LOCATIONS_MAX = 40 };
static const double LOCATED_JUMP = 1e-3;
static const double LOCATED_RIGID = 1e-8;
// Bounces shorter than this share of the step are not followed.
static const double SHORTEST_BOUNCE = 0.01;
// Events nearer to each other than this share of their time are at the same instant.
static const double TOGETHER = 1e-6;

// The factors outlive a step, and floors.c puts off the account of the last one.
static const struct fields_row list[] = {
    FIELD_PARTS(struct run, next, FIELD_AT, state_fields),
    FIELD_PART(struct run, memory, memory_fields),
    FIELD_ARRAY(struct run, events, FIELD_LINKS),
    FIELD_VALUE(struct run, events_before),
    FIELD_VALUE(struct run, has_met),
    FIELD_VALUE(struct run, work.h),
    FIELD_VALUE(struct run, work.factors),
    FIELD_PARTS(struct run, work.home, FIELD_BUILDINGS, effective_fields),
    FIELD_VALUE(struct run, work.floors.account.due),
    FIELD_VALUE(struct run, work.floors.account.ground_a),
};
const struct fields run_step_fields = FIELDS(list);

bool run_step_alloc(struct run *r, struct arena *a) {
    const struct model *m = r->model;
    r->events = arena_alloc(a, (size_t)m->n_contact, sizeof *r->events);
    r->meeting = arena_alloc(a, (size_t)m->n_contact, sizeof *r->meeting);
    if (!state_alloc(r->next, m, a) || !memory_alloc(&r->memory, m, a) ||
        !work_alloc(&r->work, m, r->results, &r->memory, a)) {
        return false;
    }
    floors_account_to(&r->work, &r->energy, r->results);
    return true;
}

// Takes the peaks of a state in which bodies have met once it lasts or is shown: between impacts at
// one instant there are velocities and accelerations that nobody has for any time.
static void take_peaks_of_meeting(struct run *r) {
    if (r->has_met) {
        peaks_update(r->results, r->model, r->now);
        impacts_jump(&r->impacts, r->now);
        r->has_met = false;
    }
}

void run_step_complete(struct run *r) {
    take_peaks_of_meeting(r);
    floors_catch_up(&r->work, r->next, r->now);
    state_complete(r->now, r->model);
}

void run_step_resume(struct run *r) {
    work_resume(&r->work);
    r->flight.factors = 0;
}

// Takes `next` as the new committed state.
static int commit(struct run *r) {
    take_peaks_of_meeting(r);
    floors_account(&r->work, r->now, r->next);
    gaps_peaks(&r->work.gaps, r->next);
    int status = impacts_step(&r->impacts, r->now, r->next, r->error);
    struct state *old = r->now;
    r->now = r->next;
    r->next = old;
    r->results->totals.steps++;
    return status == STATUS_OK ? run_poll(r, r->now->time) : status;
}

// Steps to the instant of an event with its link held as it was. In a long step the instant is only
// an estimate; it is improved by Newton's method, safeguarded by bisection, until the link stands
// near d = 0 (or, if a rounding error had it inside at the start, where it stood). Where other
// contacts make it jump past that, the instant before the jump is taken. STATUS_RETRY: not found.
static int step_to_event(struct run *r, struct event *event, double end, double h) {
    bool opens = r->now->link[event->link].closed;
    double sign = opens ? -1.0 : 1.0;
    double start = opens ? 0.0 : fmax(r->now->delta[event->link], 0.0);
    double located = r->model->link[event->link].law->rebound ? LOCATED_RIGID : LOCATED_JUMP;
    struct root within = {0.0, h, sign};
    for (int i = 0; i < LOCATIONS_MAX; i++) {
        double instant = event->time < h ? r->now->time + event->time : end;
        r->work.held = event->link;
        int status = newmark_step(&r->work, r->now, r->next, instant, event->time, r->error);
        r->work.held = -1;
        double d = r->next->delta[event->link] - start;
        double v = state_rate(r->next, r->model, event->link);
        root_narrow(&within, event->time, d);
        bool near = fabs(d) <= located * fabs(v) * h;
        bool narrow = within.high - within.low <= 1e-9 * h;
        if (status != STATUS_OK || near || (narrow && (sign * d <= 0.0 || within.low == 0.0))) {
            return status;
        }
        event->time = narrow ? within.low : root_step(&within, event->time, d, v);
    }
    return r->work.strictness == STEP_ACCEPT ? STATUS_OK : STATUS_RETRY;
}

// Lets the force of the event's link jump.
static int let_jump(struct run *r, const struct event *event) {
    event_apply(r->now, r->model, event->link);
    peaks_update(r->results, r->model, r->now);
    impacts_part(&r->impacts, r->now);
    return impacts_toggle(&r->impacts, r->now, event->link, r->error);
}

// Lets the bodies of a rigid contact meet.
static int let_meet(struct run *r, const struct event *event) {
    const struct model *m = r->model;
    r->has_met = true;
    if (event_is_idle(r->now, m, event->link)) {
        impulse_hold(r->now, m, event->link, r->meeting);
        return impacts_meet(&r->impacts, r->now, r->meeting, r->error);
    }
    bool chatters = r->events[event->link] > EVENTS_RIGID_MAX;
    enum rebound rebound = chatters ? REBOUND_NONE : REBOUND_BY_LAW;
    const struct least_bounce least = {
        .time = m->adaptive ? 0.0 : SHORTEST_BOUNCE * m->dt,
        .velocity = m->adaptive ? m->control.tolerance * r->results->totals.speed : 0.0,
    };
    impulse_meet(r->now, m, event->link, rebound, &least, r->meeting);
    energy_meet(&r->energy, m, r->now, r->meeting);
    return impacts_meet(&r->impacts, r->now, r->meeting, r->error);
}

// Steps to the first event, which may turn out to be another one than was seen from the whole step.
static int step_to_first(struct run *r, struct event *event, double end, double h) {
    for (int i = 0; i < LOCATIONS_MAX; i++) {
        int status = step_to_event(r, event, end, h);
        if (status != STATUS_OK) {
            return status;
        }
        struct event other =
            event_first(&r->work, r->now, r->next, event->time, r->events, event->link);
        if (other.link < 0 || other.time >= (1.0 - TOGETHER) * event->time) {
            return STATUS_OK;
        }
        *event = other;
        if (event->time == 0.0) {
            return STATUS_OK;
        }
    }
    return r->work.strictness == STEP_ACCEPT ? STATUS_OK : STATUS_RETRY;
}

static int endless(const struct run *r, const struct event *event) {
    return error_set(r->error, STATUS_FAILED, "contact %s meets without end at t = %.9g",
                     r->model->link[event->link].name, r->now->time);
}

// Steps to the event and lets the force jump or the bodies meet.
static int pass_event(struct run *r, struct event *event, double end, double h) {
    int status = STATUS_OK;
    if (r->events[event->link] == EVENTS_ENDLESS) {
        return endless(r, event);
    }
    if (event->time > 0.0) {
        status = step_to_first(r, event, end, h);
        status = status == STATUS_OK && event->time > 0.0 ? commit(r) : status;
    }
    if (status == STATUS_OK) {
        floors_catch_up(&r->work, r->next, r->now);
        r->results->totals.events++;
        r->events[event->link]++;
        status = r->model->link[event->link].law->rebound ? let_meet(r, event) : let_jump(r, event);
    }
    return status == STATUS_OK ? run_poll_now(r, r->now->time) : status;
}

// Is the step of size h short enough for what was found in it? STATUS_RETRY: no.
static int judge(struct run *r, double h) {
    struct work *w = &r->work;
    if (!r->model->adaptive) {
        bool strict = w->strictness == STEP_STRICT;
        return strict && event_is_abrupt(w, r->now, r->next) ? STATUS_RETRY : STATUS_OK;
    }
    int status = step_length_judge(&r->length, r->now, r->next, h);
    if (status != STATUS_OK) {
        r->memory.unresolved = -1;
    }
    return status;
}

int run_step(struct run *r, double end, double h, int halvings, double *rest) {
    r->work.strictness = halvings < RUN_HALVINGS_MAX ? STEP_STRICT : STEP_ACCEPT;
    *rest = 0.0;
    int status = newmark_step(&r->work, r->now, r->next, end, h, r->error);
    status = status == STATUS_OK ? judge(r, h) : status;
    if (status != STATUS_OK) {
        return status;
    }
    if (r->work.n_toggled == 0 && r->work.n_rigid == 0) {
        return commit(r);
    }
    struct event event = event_first(&r->work, r->now, r->next, h, r->events, -1);
    if (event.link < 0) {
        return commit(r);
    }
    status = pass_event(r, &event, end, h);
    *rest = h - event.time;
    return status;
}

void run_forget_events(struct run *r) {
    if (r->results->totals.events > r->events_before) {
        memset(r->events, 0, (size_t)r->model->n_contact * sizeof *r->events);
        r->events_before = r->results->totals.events;
    }
}
