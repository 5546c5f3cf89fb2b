// SPDX-License-Identifier: GPL-3.0-or-later
#include "study/pool.h"

#include <stdio.h>
#include <stdlib.h>

#include "core/wall.h"
#include "jostle/ensemble.h"
#include "jostle/study_merge.h"
#include "motion/record_cache.h"
#include "study/history.h"
#include "study/lengths.h"
#include "study/trial.h"
#include "study/workers.h"

enum {
    SYNC_TICKS = 10,    // polls between synchronisations of the journal
    LENGTHS_TICKS = 5,  // polls before lengths are measured: short studies do without
};
static const double LENGTHS_SECONDS = 0.05;  // of each poll

// Guarded by the lock of the workers.
struct pool {
    const struct study_request *request;
    const struct plan *plan;
    struct journal *journal;
    struct keys *keys;
    struct manifest *manifest;
    struct record_cache *records;
    struct study_progress progress;
    long failed;  // run of progress.failure
    long next;    // the run to look at next
    long left;    // runs that no thread has taken yet
    int most;     // that one takes at once
    int tick;
    long collapsed;  // the value of a run that says whether it has collapsed; -1: none

    struct lengths lengths;           // the calling thread measures them
    bool weighed;                     // they are summed:
    double length_done, length_left;  // of the runs of this start, of those still to be done
    off_t kept;                       // end of the runs that the journal had before
    double start;                     // wall time [s]
    double started;                   // the same since 1970
};

// The runs that a thread works on.
struct batch {
    int n;
    struct trial trial[ENSEMBLE_MAX];
    double value[];  // (pool.most, n_value)
};

// The pool as one of its threads sees it.
struct view {
    struct pool *pool;
    struct workers *workers;
    const struct batch *batch;       // the runs of the thread
    double start;                    // of the runs [s of the thread]
    long entry;                      // the run whose histories are written
    struct history_writer *history;  // NULL: there are none
};

// Of the calling thread, so that a run is not longer where others run beside it.
static double thread_seconds(void) {
    struct timespec t;
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

static int poll_trial(void *context, double time, struct error *e) {
    const struct view *v = context;
    const double limit = v->pool->request->seconds_max;
    if (limit > 0.0 && thread_seconds() - v->start > limit) {
        return error_set(e, STATUS_FAILED, "the limit of %g s was reached at t = %.6g", limit,
                         time);
    }
    return workers_stopped(v->workers) ? error_set(e, STATUS_SYSTEM, "the study has ended")
                                       : STATUS_OK;
}

static int enter_files(void *context, const struct deck_path *files, struct error *e) {
    const struct view *v = context;
    struct pool *p = v->pool;
    const long n_file = p->manifest->n_file;
    int status = STATUS_OK;
    workers_lock(v->workers);
    for (; files && status == STATUS_OK; files = files->next) {
        const struct manifest_file *entry;
        status = manifest_check(p->manifest, files, &entry, e);
    }
    if (p->manifest->n_file > n_file) {
        for (int i = 0; i < v->batch->n; i++) {
            keys_forget(p->keys, v->batch->trial[i].entry);
        }
    }
    workers_unlock(v->workers);
    return status;
}

static int put_block(void *context, const void *bytes, size_t n, struct error *e) {
    const struct view *v = context;
    workers_lock(v->workers);
    const int status = journal_add_block(v->pool->journal, v->entry, bytes, n, e);
    workers_unlock(v->workers);
    return status;
}

static void begin_histories(void *context, const struct model *m) {
    struct view *v = context;
    v->history->put = put_block;
    v->history->context = v;
    history_start(v->history, m);
    workers_lock(v->workers);
    journal_begin_run(v->pool->journal, v->entry);
    workers_unlock(v->workers);
}

static int put_row(void *context, const struct row_view *row, struct error *e) {
    const struct view *v = context;
    return history_put_row(v->history, row, e);
}

static int put_results(void *context, const struct results *r, struct error *e) {
    const struct view *v = context;
    return history_put_results(v->history, r, e);
}

// The next runs of the part to be done; -1: there are none.
static long take(void *context, void *scratch) {
    struct pool *p = context;
    struct batch *b = scratch;
    // Those that can go in lockstep, but so that all threads get their share.
    const long share = (p->left + p->progress.n_thread - 1) / p->progress.n_thread;
    const long most = share < p->most ? share : p->most;
    for (b->n = 0; b->n < most && p->next < p->plan->n_mine; p->next++) {
        if (p->journal->offset[p->next] == 0) {
            struct trial *t = &b->trial[b->n];
            t->run = study_shard_run(&p->plan->shard, p->next);
            t->entry = p->next;
            t->value = b->value + (size_t)b->n * p->plan->table->n_value;
            b->n++;
            p->left--;
        }
    }
    return b->n > 0 ? b->trial[0].entry : -1;
}

static int work(void *context, struct workers *w, long first, void *scratch, struct error *e) {
    struct pool *p = context;
    struct batch *b = scratch;
    struct view view = {
        .pool = p, .workers = w, .batch = b, .start = thread_seconds(), .entry = first};
    struct trial_watch watch = {.files = enter_files,
                                .poll = poll_trial,
                                .context = &view,
                                .steps_max = p->request->steps_max,
                                .records = p->records};
    if (p->journal->chain) {
        view.history = malloc(sizeof *view.history);
        if (!view.history) {
            return error_no_memory(e);
        }
        watch.begin = begin_histories;
        watch.row = put_row;
        watch.end = put_results;
    }
    trial_run(p->plan, b->trial, b->n, &watch);
    free(view.history);
    return STATUS_OK;
}

// Of the runs that fail, the one of the lowest number is named, whichever ends first.
static void count(struct pool *p, long run, const struct study_outcome *outcome) {
    struct study_progress *to = &p->progress;
    to->n_done = p->journal->n_done;
    to->n_failed = p->journal->n_failed;
    if (outcome->status == STUDY_FAILED) {
        if (!to->failure[0] || run < p->failed) {
            struct plan_text t;
            p->failed = run;
            snprintf(to->failure, sizeof to->failure, "%s: %s", plan_describe(p->plan, run, &t),
                     outcome->message);
        }
    }
}

static double length_of(const struct pool *p, long entry) {
    return lengths_of(&p->lengths, study_shard_run(&p->plan->shard, entry));
}

static double seconds_left(const struct pool *p) {
    return p->weighed && p->length_done > 0.0
               ? (wall_seconds() - p->start) * p->length_left / p->length_done
               : 0.0;
}

static int enter_run(struct pool *p, const struct trial *t, struct error *e) {
    if (t->status != STATUS_OK) {
        *e = t->error;
        return t->status;
    }
    const bool collapsed = p->collapsed >= 0 && t->value[p->collapsed] > 0.0;  // NaN is not
    const int status = journal_add_run(p->journal, t->entry, &t->outcome, collapsed, t->value, e);
    if (status == STATUS_OK) {
        count(p, t->run, &t->outcome);
        const double length = p->weighed ? length_of(p, t->entry) : 0.0;
        p->length_done += length;
        p->length_left -= length;
    }
    return status;
}

// The first error of a run, after the others have been entered.
static int enter(void *context, long first, const void *scratch, struct error *e) {
    (void)first;
    const struct batch *b = scratch;
    int status = STATUS_OK;
    for (int i = 0; i < b->n; i++) {
        struct error other;
        const int entered = enter_run(context, &b->trial[i], &other);
        if (status == STATUS_OK && entered != STATUS_OK) {
            status = entered;
            *e = other;
        }
    }
    return status;
}

// Tells `jostle status` how far the study is. Called under the lock.
static int add_state(struct pool *p, double seconds_left, bool ended, struct error *e) {
    const struct journal *j = p->journal;
    const struct journal_state state = {.n_run = p->plan->n_mine,
                                        .n_done = j->n_done,
                                        .n_failed = j->n_failed,
                                        .n_collapsed = j->n_collapsed,
                                        .ended = ended,
                                        .time = wall_date(),
                                        .started = p->started,
                                        .seconds_left = seconds_left};
    return journal_add_state(p->journal, &state, e);
}

// What the calling thread does meanwhile.
static int watch(void *context, struct workers *w, long n_job, struct error *e) {
    struct pool *p = context;
    (void)n_job;  // the progress counts runs
    const struct study_request *q = p->request;
    if (q->poll && p->tick >= LENGTHS_TICKS) {
        lengths_measure(&p->lengths, LENGTHS_SECONDS);
    }
    workers_lock(w);
    // The lengths of runs are summed once they are measured.
    for (long i = 0; p->lengths.measured && !p->weighed && i < p->plan->n_mine; i++) {
        const int64_t at = p->journal->offset[i];
        if (at == 0) {
            p->length_left += length_of(p, i);
        } else if (at >= p->kept) {  // of this start
            p->length_done += length_of(p, i);
        }
    }
    p->weighed = p->lengths.measured;
    struct study_progress now = p->progress;
    now.seconds_left = seconds_left(p);
    workers_unlock(w);
    int status = q->poll ? q->poll(q->context, &now, e) : STATUS_OK;
    if (status == STATUS_OK && ++p->tick % SYNC_TICKS == 0) {
        workers_lock(w);
        status = add_state(p, now.seconds_left, false, e);
        workers_unlock(w);
        status = status == STATUS_OK ? journal_sync(p->journal, e) : status;
    }
    return status;
}

int pool_run(const struct study_request *q, const struct plan *plan, struct journal *journal,
             struct keys *keys, struct manifest *manifest, struct study_progress *progress,
             struct error *e) {
    struct pool p = {.request = q,
                     .plan = plan,
                     .journal = journal,
                     .keys = keys,
                     .manifest = manifest,
                     .collapsed = study_table_collapsed(plan->table),
                     .records = record_cache_create(RECORD_CACHE_BYTES),
                     .progress = *progress,
                     .kept = journal->end,
                     .start = wall_seconds(),
                     .started = wall_date()};
    int status = p.records ? lengths_init(&p.lengths, plan, e) : error_no_memory(e);
    const long missing = plan->n_mine - journal->n_done;
    const int n_thread = missing < q->n_thread ? (int)missing : q->n_thread;
    p.progress.n_thread = n_thread;
    p.left = missing;
    // In lockstep a run would have the time of the others, too, and no histories.
    const bool alone = q->seconds_max > 0.0 || q->steps_max > 0 || journal->chain;
    p.most = alone ? 1 : trial_most(plan);
    const size_t values = (size_t)p.most * plan->table->n_value;
    const struct workers_request request = {.n_thread = n_thread,
                                            .scratch =
                                                sizeof(struct batch) + values * sizeof(double),
                                            .take = take,
                                            .work = work,
                                            .enter = enter,
                                            .poll = watch,
                                            .context = &p};
    status = status == STATUS_OK && n_thread > 0 ? add_state(&p, 0.0, false, e) : status;
    status = status == STATUS_OK && n_thread > 0 ? workers_run(&request, e) : status;
    if (status != STATUS_OK && n_thread > 0) {
        struct error ignored;  // whoever looks finds the time instead
        add_state(&p, seconds_left(&p), true, &ignored);
    }
    lengths_close(&p.lengths);
    record_cache_free(p.records);
    *progress = p.progress;
    return status;
}
