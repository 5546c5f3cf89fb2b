// SPDX-License-Identifier: GPL-3.0-or-later
// Newmark's method with the steps of the deck: as many at a time as are in free flight, else one by
// one, halved where they are rejected.
#include "solve/run.h"

// A run in which steps were rejected more often than this, and this often per step of the deck,
// will not end in a reasonable time.
enum { REJECTED_BUDGET = 2000000, REJECTED_BUDGET_PER_STEP = 100 };

static int give_up(struct run *r, double h) {
    const struct model *m = r->model;
    const char *unit = m->deck->units.time_name;
    int k = r->memory.unresolved;
    return error_set(
        r->error, STATUS_FAILED,
        "at t = %.6g %s a step of %.3g %s is still too long for contact %s, after %ld rejections; "
        "use a softer or a damped contact, or a much shorter step",
        r->now->time, unit, h, unit, k < 0 ? "forces" : m->link[k].name,
        r->results->totals.rejected);
}

// Counts a step of size h that is rejected, and has been halved so often. Errors: STATUS_FAILED
// (too many).
static int reject(struct run *r, double h, int halvings) {
    if (halvings == RUN_HALVINGS_MAX) {
        return error_set(
            r->error, STATUS_FAILED,
            "no step is short enough at t = %.9g: the numbers are beyond double precision",
            r->now->time);
    }
    long budget = REJECTED_BUDGET + REJECTED_BUDGET_PER_STEP * r->model->n_step;
    return r->results->totals.rejected++ < budget ? run_poll_now(r, r->now->time) : give_up(r, h);
}

// Goes from the committed state to `end`, h later; one that is rejected is halved.
static int go_to(struct run *r, double end, double h, int halvings) {
    while (h > 0.0) {
        double rest;
        int status = run_step(r, end, h, halvings, &rest);
        if (status == STATUS_RETRY) {
            status = reject(r, h, halvings++);
            rest = h / 2.0;
            status = status == STATUS_OK ? go_to(r, end - rest, rest, halvings) : status;
        }
        if (status != STATUS_OK) {
            return status;
        }
        h = rest;
    }
    return STATUS_OK;
}

int fixed_newmark_step(struct run *r, long n) {
    const struct model *m = r->model;
    double end = model_time(m, n);
    run_forget_events(r);
    return go_to(r, end, n < m->n_step ? m->dt : end - r->now->time, 0);
}

static int advance(struct run *r, long *n, long end) {
    long reached = flight_take(&r->flight, &r->now, &r->next, *n, end);
    if (reached > *n) {
        *n = reached;
        return run_poll(r, r->now->time);
    }
    return fixed_newmark_step(r, ++*n);
}

static bool alloc(struct run *r, struct arena *a) {
    return run_step_alloc(r, a) && flight_alloc(&r->flight, &r->work, &r->impacts, a);
}

const struct method fixed_newmark = {
    .fields = &run_step_fields,
    .resume = run_step_resume,
    .integrator = INTEGRATOR_NEWMARK,
    .adaptive = false,
    .alloc = alloc,
    .advance = advance,
    .complete = run_step_complete,
};
