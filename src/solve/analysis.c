// SPDX-License-Identifier: GPL-3.0-or-later
// The time loop: the method of the run advances it towards the next row, which is shown to the
// observer.
#include "jostle/analysis.h"

#include <assert.h>
#include <math.h>
#include <stdlib.h>

#include "core/arena.h"
#include "core/lanes.h"
#include "core/wall.h"
#include "solve/account/peaks.h"
#include "solve/account/residual_drift.h"
#include "solve/event/rest.h"
#include "solve/method.h"

int run_poll_now(struct run *r, double time) {
    const struct observer *o = r->observer;
    return o && o->poll ? o->poll(o->context, time, r->error) : STATUS_OK;
}

int run_poll(struct run *r, double time) {
    bool due = r->results->totals.steps % RUN_POLL_STEPS == 0;
    return due ? run_poll_now(r, time) : STATUS_OK;
}

int analysis_note_energies(struct run *r) {
    struct results *out = r->results;
    double residual = fabs(out->energy[ENERGY_RESIDUAL]);
    if (!isfinite(residual)) {
        return error_set(r->error, STATUS_FAILED, "the energy is not finite at t = %.9g",
                         r->now->time);
    }
    out->residual_peak = fmax(out->residual_peak, residual);
    return STATUS_OK;
}

// The zeros around the arrays of floors, of which one is a wall, are as loops rely on them.
static void assert_zeros(const struct state *s, const struct model *m) {
    const double *const array[] = {s->u, s->v, s->a, s->base, s->drift, s->shear};
    for (size_t i = 0; i < sizeof array / sizeof array[0]; i++) {
        lanes_assert(array[i], m->n_dof);
    }
    assert(s->u[m->n_dof] == 0.0 && s->v[m->n_dof] == 0.0);
}

static int observe(struct run *r) {
    if (r->method->complete) {
        r->method->complete(r);
    }
    const struct state *s = r->now;
    assert_zeros(s, r->model);
    peaks_drift_rates(r->results, r->model, s);
    energy_balance(&r->energy, r->model, s, r->results->energy);
    int status = analysis_note_energies(r);
    const struct observer *o = r->observer;
    if (status != STATUS_OK || !o || !o->row) {
        return status;
    }
    for (int k = 0; k < r->model->n_link; k++) {
        r->row_force[k] = s->link[k].force;
    }
    const struct row_view row = {
        .time = s->time,
        .displacement = s->u,
        .velocity = s->v,
        .acceleration = s->total,
        .drift = s->drift,
        .storey_shear = s->shear,
        .force = r->row_force,
        .penetration = s->delta,
        .ground = s->ground_a,
        .energy = r->results->energy,
    };
    return o->row(o->context, &row, r->error);
}

// The next step after n that is a row of the output, or at which the observer is asked whether to
// go on.
static long stretch_end(const struct run *r, long n) {
    long every = r->model->output.every;
    if (!r->observer) {
        return r->model->n_step;
    }
    long row = (n / every + 1) * every;
    long asked = n + RUN_POLL_STEPS - r->results->totals.steps % RUN_POLL_STEPS;
    return row < asked ? row : asked;
}

static bool is_shown(const struct run *r, long n) {
    const struct model *m = r->model;
    return (r->observer && n % m->output.every == 0) || n == m->n_step;
}

int analysis_go(struct run *r, long end) {
    int status = STATUS_OK;
    while (status == STATUS_OK && r->step < end) {
        long stretch = stretch_end(r, r->step);
        status = r->method->advance(r, &r->step, stretch < end ? stretch : end);
        if (status == STATUS_OK && is_shown(r, r->step)) {
            status = observe(r);
        }
    }
    return status;
}

int analysis_step(struct run *r, long n) {
    int status = fixed_newmark_step(r, n);
    r->step = n;
    if (status == STATUS_OK) {
        floors_catch_up(&r->work, r->next, r->now);
    }
    return status == STATUS_OK && is_shown(r, n) ? observe(r) : status;
}

static const struct fields_row list[] = {
    FIELD_VALUE(struct run, step),
    FIELD_PARTS(struct run, now, FIELD_AT, state_fields),
    FIELD_PART(struct run, energy, energy_fields),
    FIELD_PARTS(struct run, results, FIELD_AT, results_fields),
};
static const struct fields run_fields = FIELDS(list);

int analysis_copy(struct run *to, const struct run *from) {
    fields_copy(&run_fields, from->model, to, from);
    fields_copy(from->method->fields, from->model, to, from);
    if (!impacts_copy(&to->impacts, &from->impacts)) {
        return error_no_memory(to->error);
    }
    if (to->method->resume) {
        to->method->resume(to);
    }
    return STATUS_OK;
}

static bool run_alloc(struct run *r, struct arena *a) {
    const struct model *m = r->model;
    r->now = &r->store[0];
    r->next = &r->store[1];
    r->row_force = arena_alloc(a, (size_t)m->n_link, sizeof *r->row_force);
    return fields_alloc(&energy_fields, m, &r->energy, a) && state_alloc(r->now, m, a) &&
           impacts_alloc(&r->impacts, m, r->results, &r->energy, a) &&
           peaks_alloc(r->results, m, a) && r->method->alloc(r, a);
}

static int run_start(struct run *r) {
    equilibrium_start(r->now, r->model);
    peaks_update(r->results, r->model, r->now);
    struct link_peak *link = r->results->link;
    if (energy_start(&r->energy, r->model, r->now, link, r->error) != STATUS_OK) {
        return r->error->status;
    }
    state_commit_links(r->now, r->model);
    if (r->method->start) {
        r->method->start(r);
    }
    return impacts_start(&r->impacts, r->now, r->error);
}

int analysis_begin(struct run *r, const struct model *m, const struct observer *observer,
                   struct error *e) {
    struct arena *a = arena_create();
    struct results *results = a ? arena_alloc(a, 1, sizeof *results) : NULL;
    *r = (struct run){
        .model = m,
        .method = method_of(m),
        .observer = observer,
        .results = results,
        .error = e,
        .start = wall_seconds(),
    };
    if (!results) {
        arena_free(a);
        error_no_memory(e);
        return STATUS_SYSTEM;
    }
    results->arena = a;
    if (!run_alloc(r, a)) {
        error_no_memory(e);
        return STATUS_SYSTEM;
    }
    int status = run_start(r);
    return status == STATUS_OK ? observe(r) : status;
}

int analysis_end(struct run *r, int status, struct results **out) {
    struct results *results = r->results;
    if (status != STATUS_OK) {
        results_free(results);
        return status;
    }
    peaks_finish(results, r->model);
    impacts_finish(&r->impacts, r->now);
    residual_drifts(r->model, r->now, results->residual_drift);
    results->initial_energy = r->energy.initial;
    results->totals.seconds = wall_seconds() - r->start;
    *out = results;
    return STATUS_OK;
}

int analysis_run(const struct model *m, const struct observer *observer, struct results **out,
                 struct error *e) {
    struct run r;
    int status = analysis_begin(&r, m, observer, e);
    return analysis_end(&r, status == STATUS_OK ? analysis_go(&r, m->n_step) : status, out);
}

void results_free(struct results *r) {
    if (r) {
        free(r->impact);
        arena_free(r->arena);
    }
}
