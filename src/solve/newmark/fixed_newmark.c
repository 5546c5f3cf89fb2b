// SPDX-License-Identifier: GPL-3.0-or-later
// Newmark's method with the steps of the deck: as many at a time as are in free flight, else one by
// one, halved where they are not solved.
#include "solve/method.h"

// A run in which steps were cut more often than this, and this often per step of the deck, will not
// end in a reasonable time.
enum { CUTS_BUDGET = 2000000, CUTS_BUDGET_PER_STEP = 100 };

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

// Counts a cut of a step of size h that has been cut so often. Errors: STATUS_FAILED (too many).
static int spend_cut(struct run *r, double h, int cuts) {
    if (cuts == RUN_CUTS_MAX) {
        return error_set(
            r->error, STATUS_FAILED,
            "no step is short enough at t = %.9g: the numbers are beyond double precision",
            r->now->time);
    }
    long budget = CUTS_BUDGET + CUTS_BUDGET_PER_STEP * r->model->n_step;
    return r->results->totals.cuts++ < budget ? run_poll_now(r, r->now->time) : give_up(r, h);
}

// Goes from the committed state to `end`, h later; a step that is not solved is cut in two.
static int go_to(struct run *r, double end, double h, int cuts) {
    while (h > 0.0) {
        double rest;
        int status = run_step(r, end, h, cuts, &rest);
        if (status == STATUS_RETRY) {
            status = spend_cut(r, h, cuts++);
            rest = h / 2.0;
            status = status == STATUS_OK ? go_to(r, end - rest, rest, cuts) : status;
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
    return run_step_alloc(r, a) && flight_alloc(&r->flight, &r->work, a);
}

const struct method fixed_newmark = {
    .integrator = INTEGRATOR_NEWMARK,
    .adaptive = false,
    .alloc = alloc,
    .advance = advance,
    .complete = run_step_complete,
    .finish = run_step_finish,
};
