// SPDX-License-Identifier: GPL-3.0-or-later
// The time loop: step, commit, account, and show a row to the observer now and then.
#include "jostle/analysis.h"

#include <math.h>
#include <stdlib.h>

#include "core/arena.h"
#include "core/wall.h"
#include "solve/adaptive_newmark.h"
#include "solve/dormand_prince.h"
#include "solve/flight.h"
#include "solve/peaks.h"
#include "solve/run.h"

// Steps go on beyond `end`, where `now` is interpolated: but only for rows, or at the end of the
// run.
static int advance_dormand_prince(struct run *r, double end, double h) {
    (void)h;
    while (dormand_prince_time(r->adaptive) < end) {
        int status = dormand_prince_step(r->adaptive, r->error);
        status = status == STATUS_OK ? run_poll(r, dormand_prince_time(r->adaptive)) : status;
        if (status != STATUS_OK) {
            return status;
        }
    }
    if (r->observer || end == r->model->duration) {
        dormand_prince_row(r->adaptive, end, r->now, &r->energy);
    }
    return STATUS_OK;
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

static int observe(struct run *r) {
    if (!r->adaptive) {
        floors_catch_up(&r->work, r->next, r->now);
        state_complete(r->now, r->model);
    }
    const struct state *s = r->now;
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

// Steps from n of the deck as far as the next row of the output, or the next poll.
static long stretch_end(const struct run *r, long n) {
    long every = r->model->output.every;
    if (!r->observer) {
        return r->model->n_step;
    }
    long row = (n / every + 1) * every;
    long asked = n + RUN_POLL_STEPS - r->results->totals.steps % RUN_POLL_STEPS;
    return row < asked ? row : asked;
}

// Goes from step n of the deck to a later one, which is returned in n: through as many as are in
// free flight, or through one. Dormand & Prince's steps need no rows where nobody looks.
static int proceed(struct run *r, long *n) {
    const struct model *m = r->model;
    if (r->adaptive && !r->observer) {
        *n = m->n_step;
        return r->advance(r, m->duration, m->dt);
    }
    long reached = flight_take(&r->flight, &r->now, &r->next, *n, stretch_end(r, *n));
    if (reached > *n) {
        *n = reached;
        return run_poll(r, r->now->time);
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
    if (status == STATUS_OK) {
        floors_catch_up(&r->work, r->next, r->now);
    }
    bool row = (r->observer && n % m->output.every == 0) || n == m->n_step;
    return status == STATUS_OK && row ? observe(r) : status;
}

static bool run_alloc(struct run *r, struct arena *a) {
    const struct model *m = r->model;
    r->now = &r->store[0];
    r->next = &r->store[1];
    r->row_force = arena_alloc(a, (size_t)m->n_link, sizeof *r->row_force);
    if (!r->row_force || !energy_alloc(&r->energy, m, a) || !state_alloc(r->now, m, a) ||
        !impacts_alloc(&r->impacts, m, a) || !peaks_alloc(r->results, m, a)) {
        return false;
    }
    if (m->integrator == INTEGRATOR_DORMAND_PRINCE) {
        r->advance = advance_dormand_prince;
        r->adaptive = dormand_prince_create(m, r->results, &r->impacts, a);
        return r->adaptive != NULL;
    }
    r->advance = m->adaptive ? adaptive_newmark_advance : run_advance_fixed;
    r->events = arena_alloc(a, (size_t)m->n_contact, sizeof *r->events);
    r->meeting = arena_alloc(a, (size_t)m->n_contact, sizeof *r->meeting);
    r->flight = (struct flight){.work = &r->work, .results = r->results, .energy = &r->energy};
    if (!state_alloc(r->next, m, a) || !work_alloc(&r->work, m, &r->results->totals, a)) {
        return false;
    }
    floors_account_to(&r->work, &r->energy, r->results);
    return r->events && r->meeting &&
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
    state_commit_links(r->now, r->model);
    if (r->adaptive) {
        dormand_prince_start(r->adaptive, r->now, &r->energy);
    } else if (r->model->adaptive) {
        step_length_start(&r->length, r->now);
    }
    return impacts_start(&r->impacts, r->results, r->model, r->now, r->error);
}

int analysis_begin(struct run *r, const struct model *m, const struct observer *observer,
                   struct error *e) {
    struct arena *a = arena_create();
    struct results *results = a ? arena_alloc(a, 1, sizeof *results) : NULL;
    *r = (struct run){.model = m, .observer = observer, .results = results, .error = e};
    r->start = wall_seconds();
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
    results->totals.seconds = wall_seconds() - r->start;
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
