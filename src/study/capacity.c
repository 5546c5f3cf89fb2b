// SPDX-License-Identifier: GPL-3.0-or-later
#include "study/capacity.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "motion/record_cache.h"
#include "study/trial.h"
#include "study/workers.h"

struct search {
    const struct capacity_request *request;
    struct capacities *out;
    struct record_cache *records;
};

// One sample while it is searched.
struct job {
    const struct search *search;
    struct workers *workers;
    struct capacity *capacity;
    long run;
    double *all;  // (n_value) of a run
};

int capacity_runs(const struct capacity_request *q) {
    const double hunt = ceil(log(q->to / q->from) / log(q->factor)) + 1.0;
    const double halvings = ceil(log2(log(q->factor) / log1p(q->tolerance)));
    return (int)fmin(hunt + fmax(halvings, 0.0) + 1.0, CAPACITY_POINTS_MAX + 1.0);
}

static void fail(struct capacity *c, const struct capacity_request *q, double intensity,
                 const char *why) {
    c->crossing = CROSSING_NO_RUNS;
    snprintf(c->failure, sizeof c->failure, "at %s = %.6g: %s", q->intensity, intensity, why);
}

static const double *intensity_of(const void *context, const struct sweep *s) {
    const struct capacity_at *f = context;
    return strcmp(s->name, f->name) == 0 ? &f->value : NULL;
}

// Runs the sample at an intensity and adds the point. *exceeded; a run that fails ends the search.
static int look(struct job *job, double intensity, bool *exceeded, struct error *e) {
    const struct search *s = job->search;
    const struct capacity_request *q = s->request;
    struct capacity *c = job->capacity;
    struct study_outcome outcome;
    double value;
    const struct capacity_at f = {q->intensity, intensity};
    struct plan_fixed at;
    plan_fix(q->plan, intensity_of, &f, &at);
    const struct trial_question question = {.plan = &at.plan,
                                            .run = job->run,
                                            .edp = &q->edp,
                                            .records = s->records,
                                            .workers = job->workers,
                                            .all = job->all};
    const int status = trial_ask(&question, &value, &outcome, e);
    if (status == STATUS_OK && outcome.status == STUDY_FAILED) {
        fail(c, q, intensity, outcome.message);
    } else if (status == STATUS_OK) {
        *exceeded = value > q->limit;
        c->point[c->n_point++] = (struct capacity_point){intensity, value, *exceeded};
        *(*exceeded ? &c->above : &c->below) = intensity;
        c->value = *exceeded ? c->value : value;
    }
    return status;
}

// Upwards from the lowest intensity.
static int hunt(struct job *job, struct error *e) {
    const struct capacity_request *q = job->search->request;
    struct capacity *c = job->capacity;
    bool exceeded = false;
    double at = q->from;
    for (;;) {
        const int status = look(job, at, &exceeded, e);
        if (status != STATUS_OK || c->failure[0]) {
            return status;
        }
        if (exceeded || at >= q->to) {
            break;
        }
        // The last factor may be a little larger, so that no short one follows it.
        at = at * q->factor * (1.0 + 1e-9) < q->to ? at * q->factor : q->to;
    }
    c->crossing = !exceeded ? CROSSING_ABOVE : isnan(c->below) ? CROSSING_BELOW : CROSSING_AT;
    return STATUS_OK;
}

static int bisect(struct job *job, struct error *e) {
    const struct capacity_request *q = job->search->request;
    struct capacity *c = job->capacity;
    int status = STATUS_OK;
    bool exceeded;
    while (status == STATUS_OK && c->crossing == CROSSING_AT &&
           c->above / c->below > 1.0 + q->tolerance && c->n_point < CAPACITY_POINTS_MAX) {
        status = look(job, sqrt(c->below * c->above), &exceeded, e);
    }
    return status;
}

static int do_job(void *context, struct workers *workers, long number, void *scratch,
                  struct error *e) {
    const struct search *s = context;
    struct job job = {.search = s,
                      .workers = workers,
                      .capacity = &s->out->each[number],
                      .run = number,
                      .all = scratch};
    *job.capacity = (struct capacity){.below = NAN, .above = NAN, .value = NAN};
    const int status = hunt(&job, e);
    return status == STATUS_OK ? bisect(&job, e) : status;
}

static int poll_search(void *context, struct workers *workers, long n_done, struct error *e) {
    const struct capacity_request *q = ((const struct search *)context)->request;
    (void)workers;
    return q->poll ? q->poll(q->context, n_done, e) : STATUS_OK;
}

int capacity_search(const struct capacity_request *q, struct capacities *out, struct error *e) {
    struct search s = {.request = q, .out = out};
    out->from = (struct capacity_at){q->intensity, q->from};
    plan_fix(q->plan, intensity_of, &out->from, &out->at);
    out->n = out->at.plan.n_run;
    out->each = calloc((size_t)out->n, sizeof *out->each);
    s.records = record_cache_create(RECORD_CACHE_BYTES);
    const struct workers_request request = {
        .n_thread = out->n < q->n_thread ? (int)out->n : q->n_thread,
        .scratch = (q->plan->table->n_value + 1) * sizeof(double),
        .n_job = out->n,
        .work = do_job,
        .poll = poll_search,
        .context = &s};
    const int status = out->each && s.records ? workers_run(&request, e) : error_no_memory(e);
    record_cache_free(s.records);
    return status;
}

void capacity_close(struct capacities *c) {
    free(c->each);
    c->each = NULL;
}

struct fragility_record capacity_record(const struct capacity_request *q,
                                        const struct capacity *c) {
    return (struct fragility_record){c->crossing, c->crossing == CROSSING_AT
                                                      ? sqrt(c->below * c->above)
                                                  : c->crossing == CROSSING_ABOVE ? q->to
                                                                                  : q->from};
}
