// SPDX-License-Identifier: GPL-3.0-or-later
// A gap that never closes is 1024 m wide: far beyond what buildings move, and yet a displacement of
// 1 m keeps 12 digits in its difference from it. A power of two costs the gap itself no digit.
#include "study/gap_runs.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "model/link_end.h"
#include "motion/record_cache.h"
#include "study/trial.h"
#include "study/workers.h"

static const double FAR = 1024.0;  // [m]

// All jobs.
struct work {
    const struct gap_runs *runs;
    struct record_cache *records;
};

// One run of one case.
struct job {
    const struct gap_runs *runs;
    const struct gap_runs_case *which;
    struct workers *workers;
    double *value;
};

// The contacts of `m` with the gap; NULL: no memory.
static struct link *links_at(const struct model *m, double gap) {
    struct link *link = malloc(((size_t)m->n_link + 1) * sizeof *link);
    if (!link) {
        return NULL;
    }
    memcpy(link, m->link, (size_t)m->n_link * sizeof *link);
    for (int i = 0; i < m->n_contact && !isnan(gap); i++) {
        link[i].gap = isinf(gap) ? FAR / m->deck->units.length : gap;
    }
    return link;
}

// A contact that the gap closes at t = 0 although the deck's does not; NULL: there is none.
static const struct link *closed_at_start(const struct model *m, const struct link *link) {
    for (int i = 0; i < m->n_contact; i++) {
        const struct link *l = &link[i];
        const double x = link_across(l, m->displacement);
        if (x > l->gap && x <= m->link[i].gap) {
            return l;
        }
    }
    return NULL;
}

static int analyse(struct job *job, const struct model *m, const struct model *deck,
                   struct study_outcome *outcome, struct error *e) {
    const struct trial_watch watch = {.poll = workers_poll, .context = job->workers};
    struct results *results;
    int status = trial_analyse(m, &watch, outcome, &results, e);
    if (status != STATUS_OK || !results) {
        return status;
    }
    bool any_closed = false;
    for (int i = 0; i < m->n_contact; i++) {
        any_closed = any_closed || results->link[i].penetration >= 0.0;
    }
    if (isinf(job->which->gap) && any_closed) {
        trial_fail(outcome, "a contact would close a gap of 1024 m");
    } else {
        status = job->runs->read(job->runs->context, m, deck, results, job->value, e);
    }
    if (status == STATUS_FAILED) {
        trial_fail(outcome, e->message);
        status = STATUS_OK;
    }
    results_free(results);
    return status;
}

static int use_model(void *context, const struct model *m, struct study_outcome *outcome,
                     struct error *e) {
    struct job *job = context;
    struct link *link = links_at(m, job->which->gap);
    if (!link) {
        return error_no_memory(e);
    }
    struct model changed = *m;
    changed.link = link;
    const struct link *closed = closed_at_start(m, link);
    int status = STATUS_OK;
    if (closed) {
        char text[STUDY_MESSAGE_MAX];
        snprintf(text, sizeof text, "contact %s is closed at t = 0 with a gap of %.6g",
                 closed->name, closed->gap);
        trial_fail(outcome, text);
    } else {
        status = analyse(job, &changed, m, outcome, e);
    }
    free(link);
    return status;
}

static int do_job(void *context, struct workers *workers, long number, void *scratch,
                  struct error *e) {
    const struct work *w = context;
    const struct gap_runs *s = w->runs;
    const long n_run = s->which[0].plan->n_run;
    struct job job = {.runs = s,
                      .which = &s->which[number / n_run],
                      .workers = workers,
                      .value = s->value + (size_t)number * s->n_value};
    const struct trial_watch watch = {.records = w->records};
    (void)scratch;
    for (size_t i = 0; i < s->n_value; i++) {
        job.value[i] = NAN;
    }
    return trial_build(job.which->plan, number % n_run, &watch, use_model, &job,
                       &s->outcome[number], e);
}

static int poll_runs(void *context, struct workers *workers, long n_done, struct error *e) {
    const struct gap_runs *s = ((const struct work *)context)->runs;
    (void)workers;
    return s->poll ? s->poll(s->context, n_done, e) : STATUS_OK;
}

int gap_runs_run(const struct gap_runs *s, struct error *e) {
    struct work w = {.runs = s, .records = record_cache_create(RECORD_CACHE_BYTES)};
    const struct workers_request request = {
        .n_thread = s->n_thread,
        .n_job = s->n_case * s->which[0].plan->n_run,
        .scratch = 1,  // none is needed: each job has its place in the results
        .work = do_job,
        .poll = poll_runs,
        .context = &w};
    int status = w.records ? workers_run(&request, e) : error_no_memory(e);
    record_cache_free(w.records);
    return status;
}
