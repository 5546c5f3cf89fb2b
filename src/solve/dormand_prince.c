// SPDX-License-Identifier: GPL-3.0-or-later
// The control of the steps. Their length follows from the estimated error, of order 5 in the step:
// Hairer, Norsett & Wanner (1993), Solving Ordinary Differential Equations I, eq. II.4.13. (The PI
// controller of volume II, section IV.2, rejects fewer steps and takes a tenth more of them.) Steps
// end at the corners of the forcing, in equal parts from one to the next, and at events
// (dp_event.c).
#include "solve/dormand_prince.h"

#include <float.h>
#include <math.h>
#include <string.h>

#include "core/arena.h"
#include "core/lanes.h"
#include "core/number.h"
#include "solve/dp.h"

static const double SAFETY = 0.9;
static const double SHRINK_MOST = 0.2, GROW_MOST = 5.0;
static const double NEGLIGIBLE = 1e-4;  // less than (SAFETY / GROW_MOST)^5

// What makes the bits of a number, taken as its logarithm, err as much to both sides.
static const int64_t NEAREST = -60 * (INT64_C(1) << 52) / 1000;

// Step after a closure over the one before it, as forces begin with an infinite slope
// (d^(1/4)).
static const double AFTER_CLOSURE = 1e-3;

// The error of the first step after a closure over its estimate, where the force grows like
// t^(1/4). For sum b_i c_i^(1/4) - 4/5 over sum e_i c_i^(1/4), with the nodes and weights of the
// method and of its estimate, it is 51.5.
static const double UNSEEN = 51.5;

// First step over the shortest period of a building over 2 pi, or over the duration.
static const double FIRST_OF_PERIOD = 1e-2, FIRST_OF_DURATION = 1e-6;

// More events than this in such a share of the duration do not come from bodies that bounce.
enum { CROWD = 4000, CROWD_PER_LINK = 4 };
static const double CROWD_TIME = 1e-7;

static bool alloc_stages(struct dp *p, struct arena *a) {
    bool good = true;
    for (int s = 0; s < DP_STAGES; s++) {
        good = good && dp_system_alloc_rates(&p->rates[s], p->model, a);
    }
    return good;
}

struct dp *dormand_prince_create(const struct model *m, struct results *r, struct impact_log *log,
                                 struct arena *a) {
    size_t n_rate = (size_t)m->n_link + LANES_WIDTH;
    struct dp *p = arena_alloc(a, 1, sizeof *p);
    if (!p) {
        return NULL;
    }
    *p = (struct dp){.model = m, .results = r, .impacts = log, .last_link = -1};
    p->floors = LANES_WIDEST_OF(&dp_wide, &dp_narrow);
    p->rate[0] = arena_alloc(a, n_rate, sizeof(double));
    p->rate[1] = arena_alloc(a, n_rate, sizeof(double));
    p->reach = arena_alloc(a, n_rate, sizeof(double));
    p->meeting = arena_alloc(a, (size_t)m->n_contact, sizeof *p->meeting);
    bool good = p->meeting && p->rate[0] && p->rate[1] && p->reach && gaps_alloc(&p->gaps, m, a) &&
                scale_alloc(&p->scales, m, a) && dp_system_alloc(&p->system, m, a) &&
                state_alloc(&p->now, m, a) && state_alloc(&p->next, m, a) && alloc_stages(p, a);
    return good ? p : NULL;
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

static void rates_now(struct dp *p) {
    dp_system_rates(&p->system, &p->now, p->now.time, p->stage[0]);
}

static double largest_omega(const struct model *m) {
    double omega = 0.0;
    for (int k = 0; k < m->n_building; k++) {
        const struct building *g = &m->building[k];
        omega = fmax(omega, g->omega[g->n_floor - 1]);
    }
    return omega;
}

void dormand_prince_start(struct dp *p, const struct state *start,
                          const struct energy_account *energy) {
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
    memcpy(now->ground_v, start->ground_v, (size_t)m->n_ground * sizeof *now->ground_v);
    memcpy(now->storey_history, start->storey_history,
           (size_t)m->n_storey_history * sizeof(double));
    memcpy(now->link_history, start->link_history, (size_t)m->n_link_history * sizeof(double));
    bind(p);
    dp_system_start(&p->system, now);
    rates_now(p);
    dp_stages_gaps(p, now, p->rate[0]);
    scale_expect(&p->scales, m);
    p->grown = true;
    dp_peaks_now(p);
    p->energy = *energy;
    double omega = largest_omega(m);
    double first = omega > 0.0 ? FIRST_OF_PERIOD / omega : FIRST_OF_DURATION * m->duration;
    p->trial = fmax(first, m->control.shortest);
}

double dormand_prince_time(const struct dp *p) {
    return p->h > 0.0 ? p->next.time : p->now.time;
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

static int too_crowded(struct dp *p, struct error *e) {
    const struct model *m = p->model;
    const struct totals *t = &p->results->totals;
    if (p->now.time - p->time_before > CROWD_TIME * m->duration) {
        p->time_before = p->now.time;
        p->events_before = t->events;
    }
    if (t->events - p->events_before <= CROWD + CROWD_PER_LINK * (long)m->n_link) {
        return STATUS_OK;
    }
    return error_set(e, STATUS_FAILED,
                     "at t = %.9g %s %s rattles: %ld events within %.2g %s; it wants a softer or a "
                     "damped contact, integrator newmark or step fixed DT",
                     p->now.time, m->deck->units.time_name,
                     p->last_link < 0 ? "a storey" : m->link[p->last_link].name,
                     t->events - p->events_before, p->now.time - p->time_before,
                     m->deck->units.time_name);
}

static int stuck(const struct dp *p, int k, struct error *e) {
    const struct model *m = p->model;
    return error_set(e, STATUS_FAILED,
                     "at t = %.9g %s the bodies of contact %s stick together, where %s jumps at "
                     "v = 0, which dormand-prince does not follow; use integrator newmark or step "
                     "fixed DT",
                     p->now.time, m->deck->units.time_name, m->link[k].name, m->link[k].law->name);
}

// Lets an event at `now` happen, and starts again from there.
static int happen(struct dp *p, struct error *e) {
    const struct dp_event *event = &p->event;
    if (dp_event_apply(p, event, e) != STATUS_OK) {
        return e->status;
    }
    p->results->totals.events++;
    p->closed_now |= event->kind == DP_CLOSE;
    if (event->kind == DP_CLOSE) {
        p->trial *= AFTER_CLOSURE;
    }
    p->trial = fmax(p->trial, p->model->control.shortest);
    rates_now(p);
    if (event->kind == DP_TURN && dp_kink_sticks(p, event->index)) {
        return stuck(p, event->index, e);
    }
    dp_stages_gaps(p, &p->now, p->rate[0]);
    dp_peaks_now(p);
    return too_crowded(p, e);
}

// The next instant at which a step has to end.
static double limit(const struct dp *p) {
    return number_min(p->system.forcing.corner, p->model->duration);
}

// Goes to the end of the last step, and lets happen there what has to.
static int finish(struct dp *p, struct error *e) {
    if (p->h == 0.0) {
        return STATUS_OK;
    }
    double corner = limit(p);
    swap_ends(p);
    p->h = 0.0;
    dp_system_commit(&p->system, &p->now);
    if (corner - p->now.time <= 8.0 * DBL_EPSILON * corner) {
        p->now.time = corner;
        if (forcing_turn(&p->system.forcing, corner)) {
            rates_now(p);
            dp_peaks_now(p);
        }
    }
    return p->event.kind == DP_NONE ? STATUS_OK : happen(p, e);
}

// The next step: a part of the way to the limit.
static void take(struct dp *p) {
    double end = limit(p);
    double rest = end - p->now.time;
    double parts = pace_parts(rest, p->trial, p->model->control.longest);
    if (parts > 1.0) {
        dp_stages_take(p, rest / parts, p->now.time + rest / parts);
    } else {
        dp_stages_take(p, rest, end);
    }
}

// What makes steps of h short, as text: the link that is stiffest at its state, the last contact
// that had an event, or the tolerance.
static const char *cause(const struct dp *p, double h) {
    const struct model *m = p->model;
    const char *name = p->last_link < 0 ? "the tolerance" : m->link[p->last_link].name;
    double fastest = 0.5 / h;  // slower ones do not matter
    for (int i = 0; i < p->now.n_live; i++) {
        int k = p->now.live[i];
        struct contact_response r =
            dp_system_response(&p->system, &p->now, k, p->now.delta[k], p->rate[0][k]);
        double rate = fmax(fabs(r.dfdv) / m->link[k].mass, sqrt(fabs(r.dfdd) / m->link[k].mass));
        if (rate > fastest) {
            fastest = rate;
            name = m->link[k].name;
        }
    }
    return name;
}

static int too_short(const struct dp *p, double h, double error, struct error *e) {
    const char *unit = p->model->deck->units.time_name;
    if (!isfinite(error)) {
        return error_set(e, STATUS_FAILED, "the state is not finite at t = %.9g %s", p->now.time,
                         unit);
    }
    return error_set(e, STATUS_FAILED,
                     "at t = %.9g %s a step of %.3g %s is still too long for %s; use a larger "
                     "-tolerance, a smaller -min, integrator newmark or step fixed DT",
                     p->now.time, unit, h, unit, cause(p, h));
}

static int too_slow(const struct dp *p, double step, struct error *e) {
    const char *unit = p->model->deck->units.time_name;
    return error_set(e, STATUS_FAILED,
                     "at t = %.9g %s the steps are %.2g %s because of %s, which makes more than "
                     "%.0e of them; use a larger -tolerance, integrator newmark or step fixed DT",
                     p->now.time, unit, step, unit, cause(p, step), (double)ADAPTIVE_STEPS_MAX);
}

// x^(-1/5) of a normal number, right to 0.4 %: the number whose bits are such a multiple of those
// of x is right to some percent, as the bits of a number are nearly its logarithm, and a step of
// Newton's method mends it.
static double fifth_root_of_inverse(double x) {
    const int64_t of_one = number_bits(1.0);
    int64_t bits = of_one + of_one / 5 - number_bits(x) / 5 + NEAREST;
    double y;
    memcpy(&y, &bits, sizeof y);
    return y * (1.2 - 0.2 * x * (y * y) * (y * y) * y);
}

// The step that would just meet the tolerance over one with this error.
static double change_for(double error) {
    if (!(error > NEGLIGIBLE)) {
        return GROW_MOST;
    }
    return error < DBL_MAX ? SAFETY * fifth_root_of_inverse(error) : SHRINK_MOST;
}

static double error_of(const struct dp *p) {
    return dp_stages_error(p) * (p->closed_now ? UNSEEN : 1.0);
}

// Rejects the step for its error: the next one is shorter.
static int reject(struct dp *p, double error, struct error *e) {
    p->results->totals.cuts++;
    if (p->h <= p->model->control.shortest || p->now.time + p->h / 2.0 == p->now.time) {
        return too_short(p, p->h, error, e);
    }
    p->trial = p->h * fmin(number_max(change_for(error), SHRINK_MOST), SAFETY);
    p->trial = fmax(p->trial, p->model->control.shortest);
    return STATUS_OK;
}

// Tries steps until one meets the tolerance.
static int attempt(struct dp *p, struct error *e) {
    for (;;) {
        take(p);
        double error = error_of(p);
        double step;
        if (pace_is_slow(&p->pace, p->model, p->now.time, &step)) {
            return too_slow(p, step, e);
        }
        if (error <= 1.0) {
            p->trial = p->h * number_min(change_for(error), GROW_MOST);
            return STATUS_OK;
        }
        if (reject(p, error, e) != STATUS_OK) {
            return e->status;
        }
    }
}

// Does the event come before any time has passed?
static bool at_once(const struct dp *p) {
    return p->event.kind != DP_NONE && p->now.time + p->event.place * p->h == p->now.time;
}

// Makes the step end at its event. It is part of one that met the tolerance, but beyond the event
// the laws are not what they were, and may have made up for an error before it: then the step is
// rejected. *taken: it is not.
static int stop_at_event(struct dp *p, bool *taken, struct error *e) {
    dp_event_locate(p);
    double error = error_of(p);
    *taken = error <= 1.0;
    return *taken ? STATUS_OK : reject(p, error, e);
}

// Takes a step up to its first event, if there is any.
static int stride(struct dp *p, struct error *e) {
    bool taken = false;
    while (!taken) {
        if (attempt(p, e) != STATUS_OK) {
            return e->status;
        }
        dp_stages_gaps(p, &p->next, p->rate[1]);
        dp_event_first(p);
        int status = STATUS_OK;
        if (at_once(p)) {
            p->trial = fmin(p->trial, p->h);  // a longer one may see another event first, and so on
            p->h = 0.0;
            status = happen(p, e);
        } else if (p->event.kind != DP_NONE) {
            status = stop_at_event(p, &taken, e);
        } else {
            taken = true;
        }
        if (status != STATUS_OK) {
            return status;
        }
    }
    return STATUS_OK;
}

int dormand_prince_step(struct dp *p, struct error *e) {
    int status = finish(p, e);
    status = status == STATUS_OK ? stride(p, e) : status;
    if (status != STATUS_OK) {
        return status;
    }
    dp_account_step(p);
    dp_peaks_step(p);
    p->closed_now = false;
    p->results->totals.steps++;
    return STATUS_OK;
}

void dormand_prince_row(struct dp *p, double t, struct state *row, struct energy_account *energy) {
    dp_account_row(p, t, row, energy);
}
