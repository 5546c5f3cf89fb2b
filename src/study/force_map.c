// SPDX-License-Identifier: GPL-3.0-or-later
#include "study/force_map.h"

#include <limits.h>
#include <math.h>
#include <stdio.h>

#include "jostle/analysis.h"
#include "motion/record_cache.h"
#include "study/workers.h"

// Guarded by the lock of the workers.
struct map {
    const struct force_map_request *request;
    double *force;
    struct record_cache *records;
    long next;
    long failed;  // the first pair that failed; LONG_MAX: none
    struct error error;
};

// What a thread has of the pair it works on.
struct attempt {
    double force;
    int status;
    struct error error;
    const char *define[];  // (n_define + 2)
};

void force_map_pair(struct force_map_pair *pair, double t1, double t2) {
    snprintf(pair->define[0], sizeof pair->define[0], "T1=%.17gs", t1);
    snprintf(pair->define[1], sizeof pair->define[1], "T2=%.17gs", t2);
}

// No pair after one that failed is begun, but those before it end: which one fails first does not
// depend on the threads.
static long take(void *context, void *scratch) {
    (void)scratch;
    struct map *map = context;
    const long n = map->request->n_period;
    return map->next < n * n && map->failed == LONG_MAX ? map->next++ : -1;
}

static int analyse(const struct model *m, struct workers *w, double *force, struct error *e) {
    const struct observer observer = {.poll = workers_poll, .context = w};
    struct results *r;
    const int status = analysis_run(m, &observer, &r, e);
    if (status != STATUS_OK) {
        return status;
    }
    *force = 0.0;
    for (int i = 0; i < m->n_contact; i++) {
        *force = fmax(*force, r->link[i].force);
    }
    results_free(r);
    return STATUS_OK;
}

static int read_and_analyse(const struct map *map, const char *const *define, struct workers *w,
                            double *force, struct error *e) {
    const struct force_map_request *q = map->request;
    struct deck *deck;
    struct model *m;
    int status = deck_open(q->path, define, q->n_define + 2, &deck, e);
    if (status != STATUS_OK) {
        return status;
    }
    status = model_build_shared(deck, map->records, &m, e);
    if (status == STATUS_OK) {
        status = analyse(m, w, force, e);
    } else {
        status = diagnostics_cause(&deck->diagnostics, e);
    }
    deck_free(deck);  // and the model with it
    return status;
}

// An error of the pair is left to `enter`; one of the system ends the map at once.
static int work(void *context, struct workers *w, long job, void *scratch, struct error *e) {
    const struct map *map = context;
    const struct force_map_request *q = map->request;
    const double t1 = q->period[job / q->n_period], t2 = q->period[job % q->n_period];
    struct attempt *attempt = scratch;
    struct force_map_pair pair;
    struct error cause;
    force_map_pair(&pair, t1, t2);
    for (int i = 0; i < q->n_define; i++) {
        attempt->define[i] = q->define[i];
    }
    attempt->define[q->n_define] = pair.define[0];
    attempt->define[q->n_define + 1] = pair.define[1];
    attempt->status = read_and_analyse(map, attempt->define, w, &attempt->force, &cause);
    if (attempt->status == STATUS_OK) {
        return STATUS_OK;
    }
    error_set(&attempt->error, attempt->status, "at T1 = %.6g s, T2 = %.6g s: %s", t1, t2,
              cause.message);
    *e = attempt->error;
    return attempt->status == STATUS_SYSTEM ? STATUS_SYSTEM : STATUS_OK;
}

static int enter(void *context, long job, const void *scratch, struct error *e) {
    struct map *map = context;
    const struct attempt *attempt = scratch;
    (void)e;
    if (attempt->status == STATUS_OK) {
        map->force[job] = attempt->force;
    } else if (job < map->failed) {
        map->failed = job;
        map->error = attempt->error;
    }
    return STATUS_OK;
}

static int poll_owner(void *context, struct workers *w, long n_done, struct error *e) {
    const struct force_map_request *q = ((const struct map *)context)->request;
    (void)w;
    return q->poll ? q->poll(q->context, n_done, e) : STATUS_OK;
}

int force_map_run(const struct force_map_request *q, double *force, struct error *e) {
    struct map map = {.request = q,
                      .force = force,
                      .records = record_cache_create(RECORD_CACHE_BYTES),
                      .failed = LONG_MAX};
    if (!map.records) {
        return error_no_memory(e);
    }
    const long n_pair = (long)q->n_period * q->n_period;
    const size_t define = ((size_t)q->n_define + 2) * sizeof(char *);
    const struct workers_request request = {.n_thread =
                                                n_pair < q->n_thread ? (int)n_pair : q->n_thread,
                                            .scratch = sizeof(struct attempt) + define,
                                            .take = take,
                                            .work = work,
                                            .enter = enter,
                                            .poll = poll_owner,
                                            .context = &map};
    const int status = workers_run(&request, e);
    record_cache_free(map.records);
    if (status == STATUS_OK && map.failed != LONG_MAX) {
        *e = map.error;
        return map.error.status;
    }
    return status;
}
