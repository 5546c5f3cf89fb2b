// SPDX-License-Identifier: GPL-3.0-or-later
// The time loop: the method of the run advances it towards the next row, which is shown to the
// observer.
#include "jostle/analysis.h"

#include <assert.h>
#include <math.h>
#include <stdlib.h>

#include "core/arena.h"
#include "core/number.h"
#include "core/wall.h"
#include "model/forces.h"
#include "model/foundation.h"
#include "solve/event/event.h"
#include "solve/run.h"

int run_poll_now(struct run *r, double time) {
    const struct observer *o = r->observer;
    if (o && o->steps_max > 0 && r->results->totals.steps >= o->steps_max) {
        return error_set(r->error, STATUS_FAILED,
                         "the limit of %ld steps was reached at t = %.6g %s", o->steps_max, time,
                         r->model->deck->units.time_name);
    }
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

// Storey deformations and shears of a row, where some building has a foundation.
static void analysis_row_founded(struct run *r, const struct state *s) {
    const size_t size = (size_t)r->model->n_dof * sizeof(double);
    memcpy(r->row_drift, s->drift, size);
    memcpy(r->row_shear, s->shear, size);
    for (int k = 0; k < r->model->n_building; k++) {
        const struct building *g = &r->model->building[k];
        if (foundation_differs(g)) {
            foundation_storeys(g, s->storey_history, s->drift + g->first, s->shear + g->first,
                               r->row_drift + g->first, r->row_shear + g->first);
        }
    }
}

// Takes the present state into the results, and shows it to the observer.
static int analysis_show_row(struct run *r) {
    const struct observer *o = r->observer;
    if (r->method->complete) {
        r->method->complete(r);
    }
    const struct state *s = r->now;
    state_assert(s, r->model);
    peaks_drift_rates(r->results, r->model, s);
    const struct energy_sums sums = energy_sums_of(&r->energy, r->model, s);
    energy_close(&r->energy, &sums, r->results->energy);
    int status = analysis_note_energies(r);
    if (status != STATUS_OK || !o || !o->row) {
        return status;
    }
    if (r->model->storeys_differ) {
        analysis_row_founded(r, s);
    }
    for (int k = 0; k < r->model->n_link; k++) {
        r->row_force[k] = s->link[k].force;
    }
    const bool members = forces_in_rows(r->model);
    if (members && r->model->n_column > 0) {
        memcpy(r->row_struck, s->u, (size_t)r->model->n_dof * sizeof *r->row_struck);
        state_struck(s, r->model, r->row_struck);
    }
    for (int k = 0; members && k < r->model->n_building; k++) {
        const struct building *g = &r->model->building[k];
        if (g->n_force > 0) {
            forces_at(g, s->drift + g->first, s->storey_history, r->row_struck,
                      r->row_members + g->force);
            forces_hide(g, r->row_members + g->force);
        }
    }
    const struct row_view row = {
        .time = s->time,
        .displacement = s->u,
        .velocity = s->v,
        .acceleration = s->total,
        .drift = r->model->storeys_differ ? r->row_drift : s->drift,
        .storey_shear = r->model->storeys_differ ? r->row_shear : s->shear,
        .force = r->row_force,
        .penetration = s->delta,
        .ground = s->ground_a,
        .energy = r->results->energy,
        .member_force = members ? r->row_members : NULL,
    };
    return o->row(o->context, &row, r->error);
}

// The next step that is a row, or at which the observer is asked whether to go on; `end` at most.
static long analysis_next_stop(const struct run *r, long end) {
    if (!r->observer) {
        return end;
    }
    const long every = r->model->output.every;
    const long row = (r->step / every + 1) * every;
    const long asked = r->step + RUN_POLL_STEPS - r->results->totals.steps % RUN_POLL_STEPS;
    return number_least(end, number_least(row, asked));
}

// Is the step that has been reached a row? The end always is.
static bool analysis_is_row(const struct run *r) {
    const struct model *m = r->model;
    return r->step == m->n_step || (r->observer && r->step % m->output.every == 0);
}

int analysis_go(struct run *r, long end) {
    int status = STATUS_OK;
    while (status == STATUS_OK && r->step < end) {
        status = r->method->advance(r, &r->step, analysis_next_stop(r, end));
        if (status == STATUS_COLLAPSE) {
            r->step = r->model->n_step;
            status = STATUS_OK;
        }
        if (status == STATUS_OK && analysis_is_row(r)) {
            status = analysis_show_row(r);
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
    return status == STATUS_OK && analysis_is_row(r) ? analysis_show_row(r) : status;
}

static const struct fields_row list[] = {
    FIELD_VALUE(struct run, step),
    FIELD_PARTS(struct run, now, FIELD_AT, state_fields),
    FIELD_PART(struct run, energy, energy_fields),
    FIELD_PARTS(struct run, results, FIELD_AT, results_fields),
    FIELD_PART(struct run, forces, force_peaks_fields),
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

#define METHOD(descriptor) &descriptor,
static const struct method *const methods[] = {
#include "solve/method_list.inc"
};
#undef METHOD

// The method for a model.
static const struct method *analysis_method_of(const struct model *m) {
    size_t i = 0;
    while (methods[i]->integrator != m->integrator || methods[i]->adaptive != m->adaptive) {
        i++;
        assert(i < sizeof methods / sizeof methods[0]);
    }
    return methods[i];
}

static bool analysis_alloc(struct run *r, struct arena *a) {
    const struct model *m = r->model;
    r->now = &r->store[0];
    r->next = &r->store[1];
    r->row_force = arena_alloc(a, (size_t)m->n_link, sizeof *r->row_force);
    r->row_members = arena_alloc(a, (size_t)m->n_force, sizeof *r->row_members);
    r->row_struck = arena_alloc(a, m->n_column > 0 ? (size_t)m->n_dof : 0, sizeof *r->row_struck);
    r->row_drift = arena_alloc(a, m->storeys_differ ? (size_t)m->n_dof : 0, sizeof *r->row_drift);
    r->row_shear = arena_alloc(a, m->storeys_differ ? (size_t)m->n_dof : 0, sizeof *r->row_shear);
    return fields_alloc(&energy_fields, m, &r->energy, a) && state_alloc(r->now, m, a) &&
           impacts_alloc(&r->impacts, m, r->results, &r->energy, a) &&
           peaks_alloc(r->results, m, a) && force_peaks_alloc(&r->forces, m, r->results, a) &&
           r->method->alloc(r, a);
}

// The state at t = 0, its accounts and its row.
static int analysis_start(struct run *r) {
    const struct model *m = r->model;
    rest_start(r->now, m);
    peaks_update(r->results, m, r->now);
    yielding_start(&r->forces.yielding, r->now);
    force_peaks_note(&r->forces, r->now);
    if (energy_start(&r->energy, m, r->now, r->results->link, r->error) != STATUS_OK) {
        return r->error->status;
    }
    state_commit_links(r->now, m);
    if (r->method->start) {
        r->method->start(r);
    }
    int status = impacts_start(&r->impacts, r->now, r->error);
    return status == STATUS_OK ? analysis_show_row(r) : status;
}

int analysis_begin(struct run *r, const struct model *m, const struct observer *observer,
                   struct error *e) {
    struct arena *a = arena_create();
    struct results *results = a ? arena_alloc(a, 1, sizeof *results) : NULL;
    *r = (struct run){
        .model = m,
        .method = analysis_method_of(m),
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
    return analysis_alloc(r, a) ? analysis_start(r) : error_no_memory(e);
}

int analysis_end(struct run *r, int status, struct results **out) {
    struct results *results = r->results;
    if (status != STATUS_OK) {
        results_free(results);
        return status;
    }
    peaks_finish(results, r->model);
    force_peaks_flush(&r->forces);
    impacts_finish(&r->impacts, r->now);
    if (!residual_drifts(r->model, r->now, results->residual_drift, results->arena)) {
        results_free(results);
        return error_no_memory(r->error);
    }
    residual_links(r->model, r->now, results->link);
    yielding_finish(&r->forces.yielding, &r->energy, r->now, results);
    results->initial_energy = r->energy.initial;
    results->totals.seconds = wall_seconds() - r->start;
    *out = results;
    return STATUS_OK;
}

int analysis_run(const struct model *m, const struct observer *observer, struct results **out,
                 struct error *e) {
    struct run r;
    int status = analysis_begin(&r, m, observer, e);
    status = status == STATUS_OK ? analysis_go(&r, m->n_step) : status;
    return analysis_end(&r, status, out);
}

void results_free(struct results *r) {
    if (r) {
        free(r->impact);
        arena_free(r->arena);
    }
}
