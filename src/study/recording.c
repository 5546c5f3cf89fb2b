// SPDX-License-Identifier: GPL-3.0-or-later
#include "study/recording.h"

#include "jostle/study_merge.h"
#include "study/history.h"
#include "study/trial.h"

// A run whose histories are written.
struct writing {
    const struct recording *recording;
    long run;  // of the journal
    const struct result_place *place;
    long n_row;  // of a run that failed
};

static int poll_study(void *context, double time, struct error *e) {
    const struct writing *w = context;
    const struct study_request *q = w->recording->request;
    (void)time;
    return q->poll ? q->poll(q->context, w->recording->progress, e) : STATUS_OK;
}

static int count_row(void *context, const struct row_view *row, struct error *e) {
    struct writing *w = context;
    (void)row, (void)e;
    w->n_row++;
    return STATUS_OK;
}

// Runs a model that fails, and then once more as far as it got.
static int write_failed(struct writing *w, const struct model *m, struct error *e) {
    const struct study_request *q = w->recording->request;
    const struct observer counter = {
        .row = count_row, .poll = poll_study, .context = w, .steps_max = q->steps_max};
    const struct observer watch = {.poll = poll_study, .context = w};
    struct result_writer *writer;
    struct results *results;
    int status = analysis_run(m, &counter, &results, e);
    if (status == STATUS_OK) {
        results_free(results);
    }
    if ((status != STATUS_OK && status != STATUS_FAILED) || w->n_row < 2) {
        return status == STATUS_FAILED ? STATUS_OK : status;
    }
    struct model shorter = *m;
    const long end = (w->n_row - 1) * m->output.every;
    if (end < m->n_step) {
        shorter.n_step = end;
        shorter.duration = (double)end * m->dt;
    }
    status = result_create_in(w->place, &shorter, q->result.version, &writer, e);
    status = status == STATUS_OK ? result_analyse(writer, &watch, &results, e) : status;
    if (status == STATUS_OK) {
        results_free(results);
    }
    return status;
}

static int write_done(const struct writing *w, const struct model *m, struct error *e) {
    const struct recording *r = w->recording;
    struct result_writer *writer;
    struct results *results = NULL;
    int status = result_create_in(w->place, m, r->request->result.version, &writer, e);
    if (status != STATUS_OK) {
        return status;
    }
    const struct observer observer = result_observer(writer);
    status = history_replay(r->journal, w->run, m, &observer, &results, e);
    if (status != STATUS_OK) {
        result_abort(writer);
        return status;
    }
    status = result_finish(writer, results, e);
    results_free(results);
    return status;
}

// The model says what the rows in the journal are of. A run that failed has no end there.
static int use(void *context, const struct model *m, struct study_outcome *outcome,
               struct error *e) {
    struct writing *w = context;
    (void)outcome;
    return w->recording->journal->chain[w->run].n > 0 ? write_done(w, m, e) : write_failed(w, m, e);
}

int recording_write(const struct recording *r, long run, const struct result_place *place,
                    struct error *e) {
    const struct trial_watch watch = {.records = r->records};
    struct writing w = {r, run, place, 0};
    struct study_outcome outcome;
    const int status = poll_study(&w, 0.0, e);
    return status == STATUS_OK ? trial_build(r->plan, study_shard_run(&r->plan->shard, run), &watch,
                                             use, &w, &outcome, e)
                               : status;
}
