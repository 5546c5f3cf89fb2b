// SPDX-License-Identifier: GPL-3.0-or-later
// Newmark's method with steps as long as the tolerance allows, which end at events.
//
// The local error comes from Taylor's expansion of the solution over the step (for the displacement
// Zienkiewicz & Xie 1991, Earthquake Engng Struct. Dyn. 20, 871-887):
//     of u:  (beta - 1/6) h^2 (a1 - a0) + h^4 a'' / 24,
//     of v:  (gamma - 1/2) h (a1 - a0) + h^3 a'' / 12,
// with a'' from the accelerations at three instants. At a breakpoint of the forcing a has a kink,
// which is not an error of the method. So a'' is there that of the accelerations without the direct
// part of the forcing. At the start, and after an impact begins or ends, there is no third instant,
// and forces may begin with an infinite slope. Then h (a1 - a0) / 4 replaces h^3 a'' / 12: the
// error of the trapezoidal rule for t^(1/4), up to a fifth.
//
// The largest of the errors, over the sizes of scale.c, stays below the tolerance. It grows like
// h^3, so steps go with its cube root. They end at corners, in equal parts from one to the next;
// small changes are not worth a new factorisation.
#include <math.h>
#include <string.h>

#include "solve/event/event.h"
#include "solve/forcing.h"
#include "solve/run.h"

static const double SAFETY = 0.9, EXPONENT = 1.0 / 3.0;
static const double SHRINK_MOST = 0.1, GROW_MOST = 4.0, GROW_LEAST = 1.2;

// The first step over the interval of output, and one after an event over the one before it.
static const double FIRST = 1e-4, AFTER_EVENT = 1e-2;

// A step this close to the last one, relative to it, is the last one: its factors are there.
static const double SAME = 1e-9;

static const struct fields_row length_rows[] = {
    FIELD_PART(struct run, length.forcing, forcing_fields),
    FIELD_PART(struct run, length.scales, scale_fields),
    FIELD_VALUES(struct run, length.pace, length.turned),
    FIELD_ARRAY(struct run, length.before, FIELD_FLOORS),
    FIELD_ARRAY(struct run, length.within, FIELD_FLOORS),
};
static const struct fields length_fields = FIELDS(length_rows);

static const struct fields_row rows[] = {
    {0, sizeof(struct run), FIELD_ONE, &run_step_fields, 0},
    {0, sizeof(struct run), FIELD_ONE, &length_fields, 0},
};
static const struct fields adaptive_fields = FIELDS(rows);

static bool adaptive_alloc(struct run *r, struct arena *a) {
    r->length.forcing.model = r->model;
    return run_step_alloc(r, a) && fields_alloc(&length_fields, r->model, r, a);
}

// Begins with a step far shorter than a row.
static void adaptive_start(struct run *r) {
    struct step_length *s = &r->length;
    r->work.forcing = &s->forcing;
    r->work.scales = &s->scales;
    (void)forcing_turn(&s->forcing, r->now->time);
    scale_expect(&s->scales, r->model);
    scale_update(&s->scales, r->model, r->results);
    s->trial = fmax(FIRST * r->model->dt, r->model->control.shortest);
    s->split = r->now->time;
}

// What keeps steps short, for messages.
static const char *adaptive_cause(const struct run *r) {
    const int k = r->memory.unresolved, lost = r->work.lost;
    return lost >= 0 ? r->model->building[lost].name
           : k < 0   ? "the tolerance"
                     : r->model->link[k].name;
}

// The next step on the way to `limit`: its size *h, and the instant *end at which it ends. Errors:
// STATUS_FAILED (the run takes too many steps).
static int adaptive_next(struct run *r, double limit, double *h, double *end) {
    struct step_length *s = &r->length;
    const double time = r->now->time, corner = s->forcing.corner;
    double step;
    if (pace_is_slow(&s->pace, r->model, time, &step)) {
        const struct pace_cause of = {adaptive_cause(r),
                                      "integrator newmark -gamma above 0.5 or step fixed DT"};
        return pace_too_slow(r->model, time, step, &of, r->error);
    }
    const double goal = limit - corner <= FORCING_SAME_TIME * limit ? limit : corner;
    pace_next(time, goal, s->trial, r->model->control.longest, h, end);
    if (fabs(*h - s->last) <= SAME * *h) {
        *h = s->last;
    }
    return STATUS_OK;
}

// The acceleration of floor i less the part that the forcing causes directly.
static double adaptive_within(const struct run *r, const struct state *at, int i) {
    return at->a[i] - at->external[i] / r->model->mass[i];
}

// How much the rate of the acceleration of floor i changes from the last step to this one [L/T^3].
static double adaptive_bend(const struct run *r, double h, int i) {
    const struct step_length *s = &r->length;
    double a0 = s->turned ? adaptive_within(r, r->now, i) : r->now->a[i];
    double a1 = s->turned ? adaptive_within(r, r->next, i) : r->next->a[i];
    double before = s->turned ? s->within[i] : s->before[i];
    return (a1 - a0) / h - (a0 - before) / s->last;
}

// The largest error of the step over the tolerance.
static double adaptive_error(const struct run *r, double h) {
    const struct model *m = r->model;
    const struct step_length *s = &r->length;
    double largest = 0.0;
    for (int i = 0; i < m->n_dof; i++) {
        double change = fabs(r->next->a[i] - r->now->a[i]);
        double of_v = h * change / 4.0;
        if (s->last > 0.0) {
            of_v = h * h * h * fabs(adaptive_bend(r, h, i)) / (6.0 * (h + s->last));
        }
        double of_u = h * (h * fabs(m->beta - 1.0 / 6.0) * change + of_v / 2.0);
        of_v += h * (m->gamma - 0.5) * change;
        largest = fmax(largest, fmax(of_u * s->scales.over_u[i], of_v * s->scales.over_v[i]));
    }
    return largest / m->control.tolerance;
}

int adaptive_judge(struct run *r, double h) {
    double error = adaptive_error(r, h);
    double change = SAFETY * pow(error, -EXPONENT);
    if (error > 1.0) {
        r->length.trial = h * fmin(fmax(change, SHRINK_MOST), SAFETY);
        r->memory.unresolved = -1;
        return STATUS_RETRY;
    }
    r->length.trial = h * (change > 1.0 && change < GROW_LEAST ? 1.0 : fmin(change, GROW_MOST));
    return STATUS_OK;
}

// A step of size h was rejected. Errors: STATUS_FAILED (it was as short as steps may be).
static int adaptive_reject(struct run *r, double h) {
    struct step_length *s = &r->length;
    r->results->totals.rejected++;
    if (s->trial > SAFETY * h) {  // not by the tolerance
        s->trial = h / 2.0;
    }
    s->trial = fmax(s->trial, r->model->control.shortest);
    if (pace_can_shorten(r->model, r->now->time, h)) {
        return STATUS_OK;
    }
    const struct pace_cause of = {adaptive_cause(r), ""};
    return pace_too_long(r->model, r->now->time, h, &of, r->error);
}

// The forcing jumps at the present state, and the accelerations with it: a step from the old ones
// would begin with a first-order error. Rigid bodies at rest may part.
static void adaptive_pass_jump(struct run *r) {
    r->length.last = 0.0;
    forcing_of_pieces(r->now, &r->length.forcing, r->now->time);
    state_complete(r->now, r->model);
    rest_equilibrium(r->now, r->model);
    impacts_part(&r->impacts, r->now);
    peaks_update(r->results, r->model, r->now);
}

// A step of size h has been taken to r->now. h = 0: it was split there, where the accelerations
// jump, or at least their rates.
static void adaptive_arrive(struct run *r, double h) {
    struct step_length *s = &r->length;
    const double time = r->now->time, corner = s->forcing.corner;
    if (h > 0.0) {
        memcpy(s->before, r->next->a, (size_t)r->model->n_dof * sizeof *s->before);
        for (int i = 0; i < r->model->n_dof; i++) {
            s->within[i] = adaptive_within(r, r->next, i);
        }
    } else {
        s->trial *= time > s->split ? AFTER_EVENT : 1.0;
        s->trial = fmax(s->trial, r->model->control.shortest);
        s->split = time;
    }
    s->last = h;
    scale_update(&s->scales, r->model, r->results);
    s->turned = time >= corner - FORCING_SAME_TIME * corner;
    if (s->turned && forcing_turn(&s->forcing, time)) {
        adaptive_pass_jump(r);
    }
}

// To the next row of the output.
static int adaptive_advance(struct run *r, long *n, long last) {
    (void)last;
    const double limit = model_time(r->model, ++*n);
    int status = STATUS_OK;
    run_forget_events(r);
    while (status == STATUS_OK && r->now->time < limit) {
        const long events = r->results->totals.events;
        double h = 0.0, end = limit, rest;
        if (adaptive_next(r, limit, &h, &end) != STATUS_OK) {
            return r->error->status;
        }
        status = run_step(r, end, h, 0, &rest);
        if (status == STATUS_RETRY) {
            status = adaptive_reject(r, h);
        } else if (status == STATUS_OK) {
            adaptive_arrive(r, r->results->totals.events > events ? 0.0 : h);
        }
    }
    return status;
}

const struct method adaptive_newmark = {
    .fields = &adaptive_fields,
    .resume = run_step_resume,
    .integrator = INTEGRATOR_NEWMARK,
    .adaptive = true,
    .alloc = adaptive_alloc,
    .start = adaptive_start,
    .advance = adaptive_advance,
    .complete = run_step_complete,
};
