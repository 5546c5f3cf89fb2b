// SPDX-License-Identifier: GPL-3.0-or-later
// The time loop: step, commit, account, and show a row to the observer now and then.
#include "jostle/analysis.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "core/arena.h"
#include "solve/adaptive_newmark.h"
#include "solve/dormand_prince.h"
#include "solve/event.h"
#include "solve/flight.h"
#include "solve/newmark.h"
#include "solve/run.h"

// A step that is not solved is halved at most this often; 2^-30 of a step is then taken as it is.
enum { CUTS_MAX = 30, POLL_STEPS = 4096 };

// Tries at the instant of an event, and how near d = 0 is near enough, as a share of the way that
// the link would make in the whole step. Rigid contacts keep what they penetrate.
enum { LOCATIONS_MAX = 40 };
static const double LOCATED_JUMP = 1e-3;
static const double LOCATED_RIGID = 1e-8;
// Bounces shorter than this share of the step are not followed.
static const double SHORTEST_BOUNCE = 0.01;
// Events nearer to each other than this share of their time are at the same instant.
static const double TOGETHER = 1e-6;

// A run in which steps were cut more often than this, and this often per step of the deck, will not
// end in a reasonable time.
enum { CUTS_BUDGET = 2000000, CUTS_BUDGET_PER_STEP = 100 };

// Asks the observer now and then whether to go on.
static int poll(struct run *r, double time) {
    const struct observer *o = r->observer;
    bool due = o && o->poll && r->results->totals.steps % POLL_STEPS == 0;
    return due ? o->poll(o->context, time, r->error) : STATUS_OK;
}

// Takes `next` as the new committed state.
static int commit(struct run *r) {
    struct results *out = r->results;
    account_step(&r->energy, out, r->model, r->now, r->next);
    gaps_peaks(&r->work.gaps, r->next);
    int status = impacts_step(&r->impacts, &r->energy, out, r->model, r->now, r->next, r->error);
    struct state *old = r->now;
    r->now = r->next;
    r->next = old;
    out->totals.steps++;
    return status == STATUS_OK ? poll(r, r->now->time) : status;
}

static int give_up(struct run *r, double h) {
    const struct model *m = r->model;
    const char *unit = m->deck->units.time_name;
    int k = r->work.unresolved;
    return error_set(
        r->error, STATUS_FAILED,
        "at t = %.6g %s a step of %.3g %s is still too long for contact %s, after %ld cuts; "
        "it wants a softer or a damped contact, or a much shorter step",
        r->now->time, unit, h, unit, k < 0 ? "forces" : m->link[k].name, r->results->totals.cuts);
}

// May a step of size h, itself of so many cuts, be cut once more?
static int spend_cut(struct run *r, double h, int cuts) {
    if (cuts == CUTS_MAX) {
        return error_set(
            r->error, STATUS_FAILED,
            "no step is short enough at t = %.9g: the numbers are beyond double precision",
            r->now->time);
    }
    long budget = CUTS_BUDGET + CUTS_BUDGET_PER_STEP * r->model->n_step;
    return r->results->totals.cuts++ < budget ? STATUS_OK : give_up(r, h);
}

// Steps to the instant of an event with its link held as it was. Where the step is long the instant
// is only an estimate: it is mended until the link stands near d = 0, or where it stood before if
// it was inside by an error. STATUS_RETRY: not found.
static int step_to_event(struct run *r, struct event *event, double end, double h) {
    bool opens = r->now->closed[event->link];
    double sign = opens ? -1.0 : 1.0;
    double start = opens ? 0.0 : fmax(r->now->delta[event->link], 0.0);
    double located = r->model->link[event->link].law->rebound ? LOCATED_RIGID : LOCATED_JUMP;
    double low = 0.0;
    double high = h;
    for (int i = 0; i < LOCATIONS_MAX; i++) {
        double instant = event->time < h ? r->now->time + event->time : end;
        r->work.held = event->link;
        int status = newmark_step(&r->work, r->now, r->next, instant, event->time, r->error);
        r->work.held = -1;
        double d = r->next->delta[event->link] - start;
        double v = state_rate(r->next, r->model, event->link);
        *(sign * d < 0.0 ? &low : &high) = event->time;
        bool near = fabs(d) <= located * fabs(v) * h || high - low <= 1e-9 * h;
        if (status != STATUS_OK || near) {
            return status;
        }
        double time = event->time - d / v;
        event->time = time > low && time < high ? time : 0.5 * (low + high);
    }
    return r->work.strictness == STEP_ACCEPT ? STATUS_OK : STATUS_RETRY;
}

// Lets the force of the event's link jump.
static int jump(struct run *r, const struct event *event) {
    event_apply(r->now, r->model, event->link);
    return impacts_toggle(&r->impacts, r->results, r->model, r->now, event->link, r->error);
}

// Lets the bodies of a rigid contact meet.
static int meet(struct run *r, const struct event *event) {
    const struct model *m = r->model;
    bool chatters = r->events[event->link] > EVENTS_RIGID_MAX;
    enum rebound rebound = chatters ? REBOUND_NONE : REBOUND_BY_LAW;
    const struct least_bounce least = {
        .time = m->adaptive ? 0.0 : SHORTEST_BOUNCE * m->dt,
        .velocity = m->adaptive ? m->control.tolerance * r->results->totals.speed : 0.0,
    };
    impulse_meet(r->now, m, event->link, rebound, &least, r->meeting);
    energy_meet(&r->energy, m, r->now, r->meeting);
    return impacts_meet(&r->impacts, r->results, m, r->now, r->meeting, r->error);
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

// Goes to the event and lets happen what happens there.
static int pass(struct run *r, struct event *event, double end, double h) {
    int status = STATUS_OK;
    if (r->events[event->link] == EVENTS_ENDLESS) {
        return endless(r, event);
    }
    if (event->time > 0.0) {
        status = step_to_first(r, event, end, h);
        status = status == STATUS_OK && event->time > 0.0 ? commit(r) : status;
    }
    if (status == STATUS_OK) {
        r->results->totals.events++;
        r->events[event->link]++;
        status = r->model->link[event->link].law->rebound ? meet(r, event) : jump(r, event);
        peaks_update(r->results, r->model, r->now);
    }
    return status;
}

int run_step(struct run *r, double end, double h, int cuts, double *rest) {
    r->work.strictness = cuts < CUTS_MAX ? STEP_STRICT : STEP_ACCEPT;
    *rest = 0.0;
    int status = newmark_step(&r->work, r->now, r->next, end, h, r->error);
    if (status != STATUS_OK) {
        return status;
    }
    if (r->model->adaptive && step_length_judge(&r->length, r->now, r->next, h) != STATUS_OK) {
        r->work.unresolved = -1;
        return STATUS_RETRY;
    }
    struct event event = event_first(&r->work, r->now, r->next, h, r->events, -1);
    if (event.link < 0) {
        return commit(r);
    }
    status = pass(r, &event, end, h);
    *rest = h - event.time;
    return status;
}

// Goes from the committed state to `end`, h later; a step that is not solved is cut in two.
static int advance(struct run *r, double end, double h, int cuts) {
    while (h > 0.0) {
        double rest;
        int status = run_step(r, end, h, cuts, &rest);
        if (status == STATUS_RETRY) {
            status = spend_cut(r, h, cuts++);
            rest = h / 2.0;
            status = status == STATUS_OK ? advance(r, end - rest, rest, cuts) : status;
        }
        if (status != STATUS_OK) {
            return status;
        }
        h = rest;
    }
    return STATUS_OK;
}

void run_forget_events(struct run *r) {
    if (r->results->totals.events > r->events_before) {
        memset(r->events, 0, (size_t)r->model->n_contact * sizeof *r->events);
        r->events_before = r->results->totals.events;
    }
}

static int advance_fixed(struct run *r, double end, double h) {
    run_forget_events(r);
    return advance(r, end, h, 0);
}

// The steps need not end at `end`: `now` is the state within the last of them, which nobody asks
// for between the start and the end of a run that is not observed.
static int advance_dormand_prince(struct run *r, double end, double h) {
    (void)h;
    while (dormand_prince_time(r->adaptive) < end) {
        int status = dormand_prince_step(r->adaptive, r->error);
        status = status == STATUS_OK ? poll(r, dormand_prince_time(r->adaptive)) : status;
        if (status != STATUS_OK) {
            return status;
        }
    }
    if (r->observer || end == r->model->duration) {
        dormand_prince_row(r->adaptive, end, r->now, &r->energy);
    }
    return STATUS_OK;
}

int analysis_balanced(struct run *r) {
    struct results *out = r->results;
    double residual = fabs(out->energy[ENERGY_RESIDUAL]);
    if (!isfinite(residual)) {
        return error_set(r->error, STATUS_FAILED, "the energy is not finite at t = %.9g",
                         r->now->time);
    }
    out->residual_peak = fmax(out->residual_peak, residual);
    return STATUS_OK;
}

static int observe(struct run *r) {
    if (!r->adaptive) {
        state_complete(r->now, r->model);
    }
    const struct state *s = r->now;
    energy_balance(&r->energy, r->model, s, r->results->energy);
    int status = analysis_balanced(r);
    const struct observer *o = r->observer;
    if (status != STATUS_OK || !o || !o->row) {
        return status;
    }
    const struct row_view row = {
        .time = s->time,
        .displacement = s->u,
        .velocity = s->v,
        .acceleration = s->total,
        .drift = s->drift,
        .storey_shear = s->shear,
        .force = s->force,
        .penetration = s->delta,
        .ground = s->ground_a,
        .energy = r->results->energy,
    };
    return o->row(o->context, &row, r->error);
}

// Steps from n of the deck as far as the next row of the output, or the next poll.
static long stretch_end(const struct run *r, long n) {
    long every = r->model->output.every;
    long row = (n / every + 1) * every;
    long asked = n + POLL_STEPS - r->results->totals.steps % POLL_STEPS;
    return row < asked ? row : asked;
}

// Goes from step n of the deck to a later one, which is returned in n: through as many as are in
// free flight, or through one.
static int proceed(struct run *r, long *n) {
    const struct model *m = r->model;
    long reached = flight_take(&r->flight, &r->now, &r->next, *n, stretch_end(r, *n));
    if (reached > *n) {
        *n = reached;
        return poll(r, r->now->time);
    }
    double end = model_time(m, ++*n);
    return r->advance(r, end, *n < m->n_step ? m->dt : end - r->now->time);
}

static int loop(struct run *r) {
    const struct model *m = r->model;
    int status = STATUS_OK;
    for (long n = 0; status == STATUS_OK && n < m->n_step;) {
        status = proceed(r, &n);
        bool shown = r->observer && n % m->output.every == 0;
        if (status == STATUS_OK && (shown || n == m->n_step)) {
            status = observe(r);
        }
    }
    return status;
}

int analysis_step(struct run *r, long n) {
    const struct model *m = r->model;
    double end = model_time(m, n);
    int status = r->advance(r, end, n < m->n_step ? m->dt : end - r->now->time);
    bool row = (r->observer && n % m->output.every == 0) || n == m->n_step;
    return status == STATUS_OK && row ? observe(r) : status;
}

static bool run_alloc(struct run *r, struct arena *a) {
    const struct model *m = r->model;
    r->now = &r->store[0];
    r->next = &r->store[1];
    if (!energy_alloc(&r->energy, m, a) || !state_alloc(r->now, m, a) ||
        !impacts_alloc(&r->impacts, m, a) || !peaks_alloc(r->results, m, a)) {
        return false;
    }
    if (m->integrator == INTEGRATOR_DORMAND_PRINCE) {
        r->advance = advance_dormand_prince;
        r->adaptive = dormand_prince_create(m, r->results, &r->impacts, a);
        return r->adaptive != NULL;
    }
    r->advance = m->adaptive ? adaptive_newmark_advance : advance_fixed;
    r->events = arena_alloc(a, (size_t)m->n_contact, sizeof *r->events);
    r->meeting = arena_alloc(a, (size_t)m->n_contact, sizeof *r->meeting);
    r->flight = (struct flight){.work = &r->work, .results = r->results, .energy = &r->energy};
    return r->events && r->meeting && state_alloc(r->next, m, a) &&
           work_alloc(&r->work, m, &r->results->totals, a) &&
           (m->adaptive ? step_length_alloc(&r->length, m, r->results, a)
                        : flight_alloc(&r->flight, m, a));
}

static int run_start(struct run *r) {
    state_start(r->now, r->model);
    energy_start(&r->energy, r->model, r->now);
    peaks_update(r->results, r->model, r->now);
    struct link_peak *link = r->results->link;
    if (energy_start_links(&r->energy, r->model, r->now, link, r->error) != STATUS_OK) {
        return r->error->status;
    }
    if (r->adaptive) {
        dormand_prince_start(r->adaptive, r->now, &r->energy);
    } else if (r->model->adaptive) {
        step_length_start(&r->length, r->now);
    }
    return impacts_start(&r->impacts, r->results, r->model, r->now, r->error);
}

static double seconds_now(void) {
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

int analysis_begin(struct run *r, const struct model *m, const struct observer *observer,
                   struct error *e) {
    struct arena *a = arena_create();
    struct results *results = a ? arena_alloc(a, 1, sizeof *results) : NULL;
    *r = (struct run){.model = m, .observer = observer, .results = results, .error = e};
    r->start = seconds_now();
    if (!results) {
        arena_free(a);
        error_no_memory(e);
        return STATUS_SYSTEM;
    }
    results->arena = a;
    int status = run_alloc(r, a) ? run_start(r) : error_no_memory(e);
    return status == STATUS_OK ? observe(r) : status;
}

int analysis_end(struct run *r, int status, struct results **out) {
    struct results *results = r->results;
    if (status != STATUS_OK) {
        results_free(results);
        return status;
    }
    gaps_finish(&r->work.gaps, results);
    impacts_finish(&r->impacts, results, r->model, r->now);
    results->initial_energy = r->energy.initial;
    results->totals.seconds = seconds_now() - r->start;
    *out = results;
    return STATUS_OK;
}

int analysis_run(const struct model *m, const struct observer *observer, struct results **out,
                 struct error *e) {
    struct run r;
    int status = analysis_begin(&r, m, observer, e);
    return analysis_end(&r, status == STATUS_OK ? loop(&r) : status, out);
}

void results_free(struct results *r) {
    if (r) {
        free(r->impact);
        arena_free(r->arena);
    }
}
