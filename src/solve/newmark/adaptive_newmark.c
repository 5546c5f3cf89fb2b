// SPDX-License-Identifier: GPL-3.0-or-later
// Newmark's method with steps as long as the tolerance allows (step_length.c), which end at events.
#include "solve/run.h"

#include "solve/account/peaks.h"
#include "solve/event/rest.h"
#include "solve/forcing.h"

// The forcing jumps at the present state, and the accelerations with it: a step from the old ones
// would begin with a first-order error. Rigid bodies at rest may part.
static void adaptive_pass_jump(struct run *r) {
    excitation_of_pieces(r->now, &r->length.forcing, r->now->time);
    state_complete(r->now, r->model);
    equilibrium_find(r->now, r->model);
    impacts_part(&r->impacts, r->now);
    peaks_update(r->results, r->model, r->now);
}

// Takes a step on the way to `limit`, or finds that it was too long.
static int adaptive_attempt(struct run *r, double limit) {
    struct totals *totals = &r->results->totals;
    long events = totals->events;
    double h;
    double end;
    double rest;
    int status = step_length_next(&r->length, r->now, limit, &h, &end, r->error);
    if (status == STATUS_OK) {
        status = run_step(r, end, h, 0, &rest);
    }
    if (status == STATUS_RETRY) {
        totals->rejected++;
        return step_length_reject(&r->length, r->now, h, r->memory.unresolved, r->error);
    }
    if (status == STATUS_OK && totals->events > events) {
        step_length_split(&r->length, r->now);
    } else if (status == STATUS_OK) {
        step_length_take(&r->length, r->next, r->now, h);
    }
    if (status == STATUS_OK && r->length.jumped) {
        adaptive_pass_jump(r);
    }
    return status;
}

// To the next row of the output.
static int adaptive_advance(struct run *r, long *n, long end) {
    (void)end;
    double limit = model_time(r->model, ++*n);
    int status = STATUS_OK;
    run_forget_events(r);
    while (status == STATUS_OK && r->now->time < limit) {
        status = adaptive_attempt(r, limit);
    }
    return status;
}

static bool adaptive_alloc(struct run *r, struct arena *a) {
    return run_step_alloc(r, a) && step_length_alloc(&r->length, r->model, r->results, a);
}

static void adaptive_start(struct run *r) {
    r->work.forcing = &r->length.forcing;
    r->work.scales = &r->length.scales;
    step_length_start(&r->length, r->now);
}

static const struct fields_row list[] = {
    {0, sizeof(struct run), FIELD_ONE, &run_step_fields},
    FIELD_PART(struct run, length, step_length_fields),
};
static const struct fields fields = FIELDS(list);

const struct method adaptive_newmark = {
    .fields = &fields,
    .resume = run_step_resume,
    .integrator = INTEGRATOR_NEWMARK,
    .adaptive = true,
    .alloc = adaptive_alloc,
    .start = adaptive_start,
    .advance = adaptive_advance,
    .complete = run_step_complete,
};
