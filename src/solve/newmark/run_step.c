// SPDX-License-Identifier: GPL-3.0-or-later
// A step of Newmark's method: taken, committed and accounted for, and split at events. An event is
// an instant at which a force or a velocity jumps: closures and openings of contact laws whose
// force jumps there, and closures of rigid ones. Passing over a jump is an error of the first order
// in the step. Adaptive steps are split wherever a contact closes or opens, as forces may begin
// there with an infinite slope.
#include <math.h>
#include <string.h>

#include "core/arena.h"
#include "core/root.h"
#include "solve/event/event.h"
#include "solve/event/hermite.h"
#include "solve/newmark/newmark.h"
#include "solve/run.h"

// At most so many events of one contact in one step of the deck: a contact whose force jumps is
// then left to the step, a rigid one is settled without rebound, and if that does not help, the run
// is ended.
enum { EVENTS_JUMP_MAX = 50, EVENTS_RIGID_MAX = 500, EVENTS_ENDLESS = 100000 };

// An event this close to an end of the step, relative to it, is at that end.
static const double AT_END = 1e-9;

// Attempts to locate an event, and how near d = 0 is near enough, as a share of the way that the
// link would go in the whole step. It is finer for rigid contacts, which keep that penetration.
enum { LOCATIONS_MAX = 40 };
static const double LOCATED_JUMP = 1e-3;
static const double LOCATED_RIGID = 1e-8;

// Bounces shorter than this share of the step are not followed.
static const double SHORTEST_BOUNCE = 0.01;

// Events nearer to each other than this share of their time are at the same instant.
static const double TOGETHER = 1e-6;

// Energy that the opening of a contact may bring, as a share of m v^2. m is the effective mass of
// the contact, and v the largest velocity of any floor so far, or that at which its bodies would
// part after a whole step of the deck.
static const double ABRUPT = 1e-4;

// The factors outlive a step, and floors.c puts off the account of the last one.
static const struct fields_row list[] = {
    FIELD_PARTS(struct run, next, FIELD_AT, state_fields),
    FIELD_PART(struct run, memory, state_memory_fields),
    FIELD_ARRAY(struct run, events, FIELD_LINKS),
    FIELD_VALUE(struct run, has_met),
    FIELD_VALUE(struct run, work.h),
    FIELD_VALUE(struct run, work.factors),
    FIELD_PARTS(struct run, work.home, FIELD_BUILDINGS, effective_fields),
    FIELD_VALUES(struct run, work.floors.account.due, work.floors.account.ground_a),
};
const struct fields run_step_fields = FIELDS(list);

bool run_step_alloc(struct run *r, struct arena *a) {
    const struct model *m = r->model;
    r->events = arena_alloc(a, (size_t)m->n_contact, sizeof *r->events);
    r->meeting = arena_alloc(a, (size_t)m->n_contact, sizeof *r->meeting);
    if (!state_alloc(r->next, m, a) || !state_memory_alloc(&r->memory, m, a) ||
        !work_alloc(&r->work, m, r->results, &r->memory, a)) {
        return false;
    }
    floors_account_to(&r->work, &r->energy, r->results, &r->forces);
    return true;
}

// Takes the peaks of a state in which bodies have met once it lasts or is shown: between impacts at
// one instant there are velocities and accelerations that nobody has for any time.
static void run_step_take_meeting(struct run *r) {
    if (r->has_met) {
        peaks_update(r->results, r->model, r->now);
        impacts_jump(&r->impacts, r->now);
        r->has_met = false;
    }
}

void run_step_complete(struct run *r) {
    run_step_take_meeting(r);
    floors_catch_up(&r->work, r->next, r->now);
    state_complete(r->now, r->model);
}

void run_step_resume(struct run *r) {
    work_resume(&r->work);
    r->flight.factors = 0;
}

// Takes `next`, or the state on the way at which the model collapses, as the new committed state.
static int run_step_commit(struct run *r) {
    int status = r->model->collapse ? collapse_newmark(r) : STATUS_OK;
    if (status != STATUS_OK) {
        return status;
    }
    run_step_take_meeting(r);
    floors_account(&r->work, r->now, r->next);
    if (r->model->storeys_differ) {
        peaks_founded(r->results, r->model, r->next);
    }
    peaks_columns(r->results, r->model, r->next);
    gaps_peaks(&r->work.gaps, r->next);
    status = impacts_step(&r->impacts, r->now, r->next, r->error);
    struct state *old = r->now;
    r->now = r->next;
    r->next = old;
    r->results->totals.steps++;
    force_peaks_note(&r->forces, r->now);
    if (status == STATUS_OK && r->results->collapse.happened) {
        return STATUS_COLLAPSE;
    }
    return status == STATUS_OK ? run_poll(r, r->now->time) : status;
}

static double event_snap(double time, double h) {
    return time <= AT_END * h ? 0.0 : time >= (1.0 - AT_END) * h ? h : time;
}

// Has contact k closed or opened in the step, in a way that steps are split at?
static bool event_splits(const struct work *w, const struct state *now, const struct state *next,
                         int k) {
    const struct contact_law *law = w->model->link[k].law;
    bool jumps =
        (law->traits & CONTACT_JUMPS) && (now->link[k].force != 0.0 || next->link[k].force != 0.0);
    return now->link[k].closed != next->link[k].closed && !law->rebound &&
           (jumps || w->model->adaptive);
}

// Time from the start of the step at which the force of link k jumps.
static double event_jump_time(const struct model *m, const struct state *now,
                              const struct state *next, double h, int k) {
    if (next->link[k].closed) {
        return next->link[k].t_close - now->time;
    }
    double rate;
    return impacts_opening(m, now, next, h, k, &rate);
}

// Time from the start of the step at which the bodies of rigid contact k meet; infinite if they do
// not, but for rounding.
static double event_meeting_time(const struct model *m, const struct state *now,
                                 const struct state *next, double h, int k) {
    struct path path = {now->delta[k], state_rate(now, m, k), next->delta[k],
                        state_rate(next, m, k), h};
    double inside = fmax(path.d0, 0.0);  // by an error of rounding or integration
    double rate;
    path.d0 -= inside;
    path.d1 -= inside;
    if (path.d1 > state_rounding(&m->link[k], next->u)) {
        return hermite_crossing(&path, &rate);
    }
    if (!(path.d0 < 0.0 && path.v0 > 0.0 && path.v1 < 0.0)) {
        return INFINITY;
    }
    struct path rising = path;  // to its summit
    rising.h = hermite_summit(&path, &rising.d1);
    rising.v1 = 0.0;
    return rising.d1 > 0.0 ? hermite_crossing(&rising, &rate) : INFINITY;
}

// Do the bodies of rigid contact k, which meet at the instant of `s`, neither approach nor press?
// Such a meeting changes nothing: it is the step that is long.
static bool event_is_idle(const struct state *s, const struct model *m, int k) {
    const struct link *l = &m->link[k];
    double rate = state_rate(s, m, k);
    double rounding = rest_rounding(l, s->v);
    double pressing = state_pressing(s, m, k);
    return rate < -rounding || (rate <= rounding && pressing <= rest_rounding(l, s->a));
}

static void event_take_earlier(struct event *first, int k, double time, double h) {
    if (time < first->time) {
        *first = (struct event){.link = k, .time = event_snap(time, h)};
    }
}

struct event run_step_first_event(const struct work *w, const struct state *now,
                                  const struct state *next, double h, const int *count,
                                  int except) {
    const struct model *m = w->model;
    static const struct event none = {.link = -1, .time = INFINITY};
    struct event first = none, otherwise = none;
    for (int i = 0; i < w->n_toggled; i++) {
        int k = w->toggled[i];
        if (k != except && event_splits(w, now, next, k) && count[k] < EVENTS_JUMP_MAX) {
            double time = event_jump_time(m, now, next, h, k);
            // What makes a contact close that neither moves nor presses inwards at the start of the
            // step comes later in it. Closed before, it would open again, to and fro at one
            // instant.
            bool is_idle =
                event_snap(time, h) == 0.0 && next->link[k].closed && event_is_idle(now, m, k);
            event_take_earlier(is_idle ? &otherwise : &first, k, time, h);
        }
    }
    for (int i = 0; i < w->n_rigid; i++) {
        int k = w->rigid[i];
        if (k != except && !now->link[k].closed) {
            event_take_earlier(&first, k, event_meeting_time(m, now, next, h, k), h);
        }
    }
    return first.link < 0 ? otherwise : first;
}

// Has a rigid contact at rest opened in the step just taken while its force was large? The force,
// taken to fall evenly over the step, then pushes bodies that already part, which makes energy of
// nothing: f d / 2, which is small where the step is short. memory.unresolved says which contact.
static bool event_is_abrupt(struct work *w, const struct state *now, const struct state *next) {
    for (int i = 0; i < w->n_toggled; i++) {
        int k = w->toggled[i];
        const struct link *l = &w->model->link[k];
        if (!l->law->rebound || next->link[k].closed) {
            continue;
        }
        double way = now->delta[k] - next->delta[k];
        double parting = fabs(state_rate(next, w->model, k));
        double speed = fmax(floors_speed(w, now), parting * w->model->dt / w->h);
        if (now->link[k].force * way > ABRUPT * l->mass * speed * speed) {
            w->memory->unresolved = k;
            return true;
        }
    }
    return false;
}

// Steps to the instant of an event with its link held as it was. In a long step the instant is only
// an estimate; it is improved by Newton's method, safeguarded by bisection, until the link stands
// near d = 0 (or, if a rounding error had it inside at the start, where it stood). Where other
// contacts make it jump past that, the instant before the jump is taken. STATUS_RETRY: not found.
static int event_step_to(struct run *r, struct event *event, double end, double h) {
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

// Lets the force of the event's link jump: it closes or opens, with the accelerations that follow.
static int event_jump(struct run *r, const struct event *event) {
    struct state *s = r->now;
    if (s->link[event->link].closed) {
        s->link[event->link].closed = false;
        s->link[event->link].force = 0.0;
    } else {
        state_close_link(s, r->model, event->link);
    }
    state_complete(s, r->model);
    rest_equilibrium(s, r->model);
    peaks_update(r->results, r->model, s);
    impacts_part(&r->impacts, s);
    return impacts_toggle(&r->impacts, s, event->link, r->error);
}

// Lets the bodies of a rigid contact meet.
static int event_meet(struct run *r, const struct event *event) {
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
        .velocity = m->adaptive ? m->control.tolerance * floors_speed(&r->work, r->now) : 0.0,
    };
    impulse_meet(r->now, m, event->link, rebound, &least, r->meeting);
    energy_meet(&r->energy, m, r->now, r->meeting);
    return impacts_meet(&r->impacts, r->now, r->meeting, r->error);
}

// Steps to the first event, which may turn out to be another one than was seen from the whole step.
static int event_step_to_first(struct run *r, struct event *event, double end, double h) {
    for (int i = 0; i < LOCATIONS_MAX; i++) {
        int status = event_step_to(r, event, end, h);
        if (status != STATUS_OK) {
            return status;
        }
        struct event other =
            run_step_first_event(&r->work, r->now, r->next, event->time, r->events, event->link);
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

// Steps to the event and lets the force jump or the bodies meet.
static int event_pass(struct run *r, struct event *event, double end, double h) {
    int status = STATUS_OK;
    if (r->events[event->link] == EVENTS_ENDLESS) {
        return error_set(r->error, STATUS_FAILED, "contact %s meets without end at t = %.9g",
                         r->model->link[event->link].name, r->now->time);
    }
    if (event->time > 0.0) {
        status = event_step_to_first(r, event, end, h);
        status = status == STATUS_OK && event->time > 0.0 ? run_step_commit(r) : status;
    }
    if (status == STATUS_OK) {
        floors_catch_up(&r->work, r->next, r->now);
        r->results->totals.events++;
        r->events[event->link]++;
        status =
            r->model->link[event->link].law->rebound ? event_meet(r, event) : event_jump(r, event);
    }
    return status == STATUS_OK ? run_poll_now(r, r->now->time) : status;
}

int run_step(struct run *r, double end, double h, int halvings, double *rest) {
    const bool strict = halvings < RUN_HALVINGS_MAX;
    r->work.strictness = strict ? STEP_STRICT : STEP_ACCEPT;
    *rest = 0.0;
    int status = newmark_step(&r->work, r->now, r->next, end, h, r->error);
    if (status == STATUS_OK && r->model->adaptive) {
        status = adaptive_judge(r, h);
    } else if (status == STATUS_OK && strict && event_is_abrupt(&r->work, r->now, r->next)) {
        status = STATUS_RETRY;
    }
    if (status != STATUS_OK) {
        return status;
    }
    struct event event = run_step_first_event(&r->work, r->now, r->next, h, r->events, -1);
    if (event.link < 0) {
        return run_step_commit(r);
    }
    status = event_pass(r, &event, end, h);
    *rest = h - event.time;
    return status;
}

void run_forget_events(struct run *r) {
    memset(r->events, 0, (size_t)r->model->n_contact * sizeof *r->events);
}
