// SPDX-License-Identifier: GPL-3.0-or-later
// The local error of Newmark's method, from Taylor's expansion of the solution over the step (for
// the displacement Zienkiewicz & Xie 1991, Earthquake Engng Struct. Dyn. 20, 871-887):
//     of u:  (beta - 1/6) h^2 (a1 - a0) + h (error of v) / 2,
//     of v:  (gamma - 1/2) h (a1 - a0) + h^3 a'' / 12,
// with a'' from the accelerations at three instants. At a corner of the forcing a has a kink, which
// is none of the method's error: there a'' is that of the accelerations without the forcing's own.
// After an impact begins or ends, and at the start, there is no third instant; forces may begin
// with an infinite slope, and the error of v is taken as h (a1 - a0) / 4, what the trapezoidal rule
// misses of t^(1/4) up to a fifth.
//
// The largest of the errors, over the sizes of scale.h, stays below the tolerance. It grows like
// h^3, so steps go with its cube root. They end at corners, in equal parts from one to the next;
// small changes are not worth a new factorisation.
#include "solve/newmark/step_length.h"

#include <float.h>
#include <math.h>
#include <string.h>

static const double SAFETY = 0.9, EXPONENT = 1.0 / 3.0;
static const double SHRINK_MOST = 0.1, GROW_MOST = 4.0, GROW_LEAST = 1.2;

// The first step over the interval of output, and one after an event over the one before it.
static const double FIRST = 1e-4, AFTER_EVENT = 1e-2;

// A step this close to the last one, relative to it, is the last one: its factors are there.
static const double SAME = 1e-9;

// Instants this close, relative to them, are one: a row and a corner differ by rounding.
static const double SAME_TIME = 8.0 * DBL_EPSILON;

static const struct fields_row list[] = {
    FIELD_PART(struct step_length, forcing, forcing_fields),
    FIELD_PART(struct step_length, scales, scale_fields),
    FIELD_VALUE(struct step_length, pace),
    FIELD_VALUE(struct step_length, trial),
    FIELD_VALUE(struct step_length, last),
    FIELD_VALUE(struct step_length, split),
    FIELD_VALUE(struct step_length, turned),
    FIELD_VALUE(struct step_length, jumped),
    FIELD_VALUE(struct step_length, unsolved),
    FIELD_ARRAY(struct step_length, before, FIELD_FLOORS),
    FIELD_ARRAY(struct step_length, within, FIELD_FLOORS),
};
const struct fields step_length_fields = FIELDS(list);

bool step_length_alloc(struct step_length *s, const struct model *m, const struct results *r,
                       struct arena *a) {
    *s = (struct step_length){.model = m, .results = r};
    forcing_init(&s->forcing, m);
    return fields_alloc(&step_length_fields, m, s, a);
}

void step_length_start(struct step_length *s, const struct state *now) {
    (void)forcing_turn(&s->forcing, now->time);
    scale_expect(&s->scales, s->model);
    scale_update(&s->scales, s->model, s->results);
    s->trial = fmax(FIRST * s->model->dt, s->model->control.shortest);
    s->split = now->time;
    s->unsolved = -1;
}

// What keeps steps short, for messages.
static const char *step_length_cause(const struct step_length *s) {
    return s->unsolved < 0 ? "the tolerance" : s->model->link[s->unsolved].name;
}

int step_length_next(struct step_length *s, const struct state *now, double limit, double *h,
                     double *end, struct error *e) {
    double step;
    if (pace_is_slow(&s->pace, s->model, now->time, &step)) {
        const struct pace_cause of = {step_length_cause(s),
                                      "integrator newmark -gamma above 0.5 or step fixed DT"};
        return pace_too_slow(s->model, now->time, step, &of, e);
    }
    double corner = s->forcing.corner;
    double goal = limit - corner <= SAME_TIME * limit ? limit : corner;
    pace_next(now->time, goal, s->trial, s->model->control.longest, h, end);
    if (fabs(*h - s->last) <= SAME * *h) {
        *h = s->last;
    }
    return STATUS_OK;
}

// The acceleration of floor i less the part that the forcing causes directly.
static double step_length_within(const struct step_length *s, const struct state *at, int i) {
    return at->a[i] - at->external[i] / s->model->mass[i];
}

// How much the rate of the acceleration of floor i changes from the last step to this one [L/T^3].
static double step_length_bend(const struct step_length *s, const struct state *now,
                               const struct state *next, double h, int i) {
    double a0 = s->turned ? step_length_within(s, now, i) : now->a[i];
    double a1 = s->turned ? step_length_within(s, next, i) : next->a[i];
    double before = s->turned ? s->within[i] : s->before[i];
    return (a1 - a0) / h - (a0 - before) / s->last;
}

// The largest error of the step over the tolerance.
static double step_length_largest_error(const struct step_length *s, const struct state *now,
                                        const struct state *next, double h) {
    const struct model *m = s->model;
    double largest = 0.0;
    for (int i = 0; i < m->n_dof; i++) {
        double change = fabs(next->a[i] - now->a[i]);
        double of_v = h * change / 4.0;
        if (s->last > 0.0) {
            of_v = h * h * h * fabs(step_length_bend(s, now, next, h, i)) / (6.0 * (h + s->last));
        }
        double of_u = h * (h * fabs(m->beta - 1.0 / 6.0) * change + of_v / 2.0);
        of_v += h * (m->gamma - 0.5) * change;
        largest = fmax(largest, fmax(of_u * s->scales.over_u[i], of_v * s->scales.over_v[i]));
    }
    return largest / m->control.tolerance;
}

int step_length_judge(struct step_length *s, const struct state *now, const struct state *next,
                      double h) {
    double error = step_length_largest_error(s, now, next, h);
    double change = SAFETY * pow(error, -EXPONENT);
    if (error > 1.0) {
        s->trial = h * fmin(fmax(change, SHRINK_MOST), SAFETY);
        return STATUS_RETRY;
    }
    s->trial = h * (change > 1.0 && change < GROW_LEAST ? 1.0 : fmin(change, GROW_MOST));
    return STATUS_OK;
}

int step_length_reject(struct step_length *s, const struct state *now, double h, int unsolved,
                       struct error *e) {
    s->unsolved = unsolved;
    if (s->trial > SAFETY * h) {  // not by the tolerance
        s->trial = h / 2.0;
    }
    s->trial = fmax(s->trial, s->model->control.shortest);
    if (pace_can_shorten(s->model, now->time, h)) {
        return STATUS_OK;
    }
    return pace_too_long(s->model, now->time, h, &(struct pace_cause){step_length_cause(s), ""}, e);
}

// Passes the corner if `time` is there.
static void step_length_turn(struct step_length *s, double time) {
    double corner = s->forcing.corner;
    s->turned = time >= corner - SAME_TIME * corner;
    s->jumped = s->turned && forcing_turn(&s->forcing, time);
    if (s->jumped) {
        s->last = 0.0;
    }
}

void step_length_take(struct step_length *s, const struct state *old, const struct state *now,
                      double h) {
    memcpy(s->before, old->a, (size_t)s->model->n_dof * sizeof *s->before);
    for (int i = 0; i < s->model->n_dof; i++) {
        s->within[i] = step_length_within(s, old, i);
    }
    s->last = h;
    step_length_turn(s, now->time);
    scale_update(&s->scales, s->model, s->results);
}

void step_length_split(struct step_length *s, const struct state *now) {
    s->trial *= now->time > s->split ? AFTER_EVENT : 1.0;
    s->trial = fmax(s->trial, s->model->control.shortest);
    s->split = now->time;
    s->last = 0.0;
    step_length_turn(s, now->time);
    scale_update(&s->scales, s->model, s->results);
}
