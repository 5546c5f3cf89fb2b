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

// The intensity of the hunt after `at`, the number `i` from 0. The last step may be a little
// longer, so that no short one follows it.
static double hunt_next(const struct capacity_request *q, double at, int i) {
    const double next = q->step > 0.0 ? at + q->step + i * q->growth : at * q->factor;
    return next * (1.0 + 1e-9) < q->to ? next : q->to;
}

int capacity_runs(const struct capacity_request *q) {
    double at = q->from, widest = 1.0;
    int n = 1;
    for (; at < q->to && n <= CAPACITY_POINTS_MAX; n++) {
        const double next = hunt_next(q, at, n - 1);
        widest = fmax(widest, next / at);
        at = next;
    }
    const double halvings = ceil(log2(log(widest) / log1p(q->tolerance)));
    return (int)fmin(n + fmax(halvings, 0.0), CAPACITY_POINTS_MAX + 1.0);
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

// Adds a point, and sets the lowest intensity that exceeds the limit and the highest one below it.
static void add_point(struct capacity *c, struct capacity_point p) {
    int i = c->n_point++;
    for (; i > 0 && c->point[i - 1].intensity > p.intensity; i--) {
        c->point[i] = c->point[i - 1];
    }
    c->point[i] = p;
    c->below = c->above = c->value = NAN;
    for (i = 0; i < c->n_point && !c->point[i].exceeded; i++) {
        c->below = c->point[i].intensity;
        c->value = c->point[i].value;
    }
    c->above = i < c->n_point ? c->point[i].intensity : c->above;
    c->crossing = i == c->n_point ? CROSSING_ABOVE : i == 0 ? CROSSING_BELOW : CROSSING_AT;
}

// Runs the sample at an intensity and adds the point. A run that fails ends the search.
static int look(struct job *job, double intensity, struct error *e) {
    const struct search *s = job->search;
    const struct capacity_request *q = s->request;
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
        fail(job->capacity, q, intensity, outcome.message);
    } else if (status == STATUS_OK) {
        add_point(job->capacity, (struct capacity_point){intensity, value, value > q->limit});
    }
    return status;
}

// Upwards from the lowest intensity; true while there is a next one.
static bool hunt(const struct capacity_request *q, const struct capacity *c, double *at) {
    if (c->n_point > 0 && (c->crossing != CROSSING_ABOVE || c->below >= q->to)) {
        return false;
    }
    *at = c->n_point == 0 ? q->from : hunt_next(q, c->below, c->n_point - 1);
    return true;
}

static bool bisect(const struct capacity_request *q, const struct capacity *c, double *at) {
    *at = sqrt(c->below * c->above);
    return c->crossing == CROSSING_AT && !capacity_is_found(q, c);
}

// The middle of the widest gap below the limit.
static bool fill(const struct capacity_request *q, const struct capacity *c, double *at) {
    double widest = 0.0;
    for (int i = 1; i < c->n_point && !c->point[i].exceeded; i++) {
        const double low = c->point[i - 1].intensity, high = c->point[i].intensity;
        if (high - low > widest) {
            widest = high - low;
            *at = low + widest / 2.0;
        }
    }
    return q->n_run > 0 && widest > 0.0;
}

static int find(struct job *job, struct error *e) {
    const struct capacity_request *q = job->search->request;
    struct capacity *c = job->capacity;
    const int most = q->n_run > 0 ? q->n_run : CAPACITY_POINTS_MAX;
    double at;
    int status = STATUS_OK;
    while (status == STATUS_OK && !c->failure[0] && c->n_point < most &&
           (hunt(q, c, &at) || bisect(q, c, &at) || fill(q, c, &at))) {
        status = look(job, at, e);
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
    *job.capacity = (struct capacity){.below = NAN, .above = NAN, .value = NAN, .crossing_at = NAN};
    const int status = find(&job, e);
    if (status == STATUS_OK && job.capacity->crossing == CROSSING_AT) {
        job.capacity->crossing_at =
            capacity_curve_reaches(job.capacity, s->request->limit, s->request->curve);
    }
    return status;
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
    const struct workers_request request = {.n_thread = q->n_thread,
                                            .scratch =
                                                (q->plan->table->n_value + 1) * sizeof(double),
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

struct fragility_record capacity_record(const struct capacity *c) {
    return (struct fragility_record){c->crossing, c->crossing == CROSSING_AT      ? c->crossing_at
                                                  : c->crossing == CROSSING_ABOVE ? c->below
                                                                                  : c->above};
}

bool capacity_is_found(const struct capacity_request *q, const struct capacity *c) {
    return c->crossing == CROSSING_AT && c->above / c->below <= 1.0 + q->tolerance;
}
