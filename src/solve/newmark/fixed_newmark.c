// SPDX-License-Identifier: GPL-3.0-or-later
// Newmark's method with the steps of the deck: as many at a time as are in free flight, else one by
// one, halved where they are rejected.
#include "solve/run.h"

// A run in which steps were rejected more often than this, and this often per step of the deck,
// will not end in a reasonable time.
enum { REJECTED_BUDGET = 2000000, REJECTED_BUDGET_PER_STEP = 100 };

// Counts a step of size h that is rejected, and has been halved so often. Errors: STATUS_FAILED
// (too many).
static int fixed_reject(struct run *r, double h, int halvings) {
    const struct model *m = r->model;
    const char *unit = m->deck->units.time_name;
    const int k = r->memory.unresolved;
    if (halvings == RUN_HALVINGS_MAX && r->work.lost >= 0) {
        return error_set(r->error, STATUS_FAILED,
                         "at t = %.9g %s the hinges of building %s have no equilibrium that a step "
                         "of %.3g %s finds",
                         r->now->time, unit, m->building[r->work.lost].name, h, unit);
    }
    if (halvings == RUN_HALVINGS_MAX) {
        return error_set(
            r->error, STATUS_FAILED,
            "no step is short enough at t = %.9g: the numbers are beyond double precision",
            r->now->time);
    }
    if (r->results->totals.rejected++ < REJECTED_BUDGET + REJECTED_BUDGET_PER_STEP * m->n_step) {
        return run_poll_now(r, r->now->time);
    }
    return error_set(
        r->error, STATUS_FAILED,
        "at t = %.6g %s a step of %.3g %s is still too long for contact %s, after %ld rejections; "
        "use a softer or a damped contact, or a much shorter step",
        r->now->time, unit, h, unit, k < 0 ? "forces" : m->link[k].name,
        r->results->totals.rejected);
}

// The rest of a step of the deck is a list of parts, the next one last. Half of a part that is
// rejected becomes a part of its own.
int fixed_newmark_step(struct run *r, long n) {
    struct part {
        double end, h;
        int halvings;
    } part[RUN_HALVINGS_MAX + 2];
    const double end = model_time(r->model, n);
    int left = 1, status = STATUS_OK;
    part[0] = (struct part){end, n < r->model->n_step ? r->model->dt : end - r->now->time, 0};
    run_forget_events(r);
    while (status == STATUS_OK && left > 0) {
        struct part *p = &part[left - 1];
        double rest;
        status = run_step(r, p->end, p->h, p->halvings, &rest);
        if (status == STATUS_RETRY) {
            status = fixed_reject(r, p->h, p->halvings++);
            p->h /= 2.0;
            part[left++] = (struct part){p->end - p->h, p->h, p->halvings};
        } else {
            p->h = rest;
            left -= rest <= 0.0;
        }
    }
    return status;
}

static int fixed_advance(struct run *r, long *n, long end) {
    long reached = flight_take(&r->flight, &r->now, &r->next, *n, end);
    if (reached > *n) {
        *n = reached;
        return run_poll(r, r->now->time);
    }
    return fixed_newmark_step(r, ++*n);
}

static bool fixed_alloc(struct run *r, struct arena *a) {
    return run_step_alloc(r, a) && flight_alloc(&r->flight, &r->work, &r->impacts, a);
}

const struct method fixed_newmark = {
    .fields = &run_step_fields,
    .resume = run_step_resume,
    .integrator = INTEGRATOR_NEWMARK,
    .adaptive = false,
    .alloc = fixed_alloc,
    .advance = fixed_advance,
    .complete = run_step_complete,
};
