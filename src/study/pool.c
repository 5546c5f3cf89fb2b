// SPDX-License-Identifier: GPL-3.0-or-later
#include "study/pool.h"

#include <stdio.h>

#include "jostle/ensemble.h"
#include "jostle/study_merge.h"
#include "motion/shelf.h"
#include "study/trial.h"
#include "study/workers.h"

enum { SYNC_TICKS = 10 };  // polls between synchronisations of the journal

// Guarded by the lock of the workers.
struct pool {
    const struct study_request *request;
    const struct plan *plan;
    struct journal *journal;
    struct ledger *ledger;
    struct shelf *records;
    struct study_progress progress;
    long failed;  // run of progress.failure
    long next;    // the run to look at next
    long left;    // runs that no thread has taken yet
    int most;     // that one takes at once
    int tick;
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
};

static int poll_trial(void *context, double time, struct error *e) {
    const struct view *v = context;
    (void)time;
    return workers_stopped(v->workers) ? error_set(e, STATUS_SYSTEM, "the study has ended")
                                       : STATUS_OK;
}

static int enter_files(void *context, const struct deck_path *files, struct error *e) {
    const struct view *v = context;
    struct pool *p = v->pool;
    int status = STATUS_OK;
    workers_lock(v->workers);
    for (; files && status == STATUS_OK; files = files->next) {
        const struct ledger_file *added;
        status = ledger_check(p->ledger, files->path, &added, e);
        if (status == STATUS_OK && added) {
            status = journal_add_file(p->journal, added->path, added->sum, e);
        }
    }
    workers_unlock(v->workers);
    return status;
}

// How many runs a thread takes at once: those that can go in lockstep, but so that all threads get
// their share.
static long batch_size(const struct pool *p) {
    const long share = (p->left + p->progress.n_thread - 1) / p->progress.n_thread;
    return share < p->most ? share : p->most;
}

// The next runs of the part to be done; -1: there are none.
static long take(void *context, void *scratch) {
    struct pool *p = context;
    struct batch *b = scratch;
    const long most = batch_size(p);
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
    (void)first, (void)e;
    struct pool *p = context;
    struct view view = {.pool = p, .workers = w};
    struct batch *b = scratch;
    const struct trial_watch watch = {
        .files = enter_files, .poll = poll_trial, .context = &view, .records = p->records};
    trial_run(p->plan, b->trial, b->n, &watch);
    return STATUS_OK;
}

// Of the runs that fail, the one of the lowest number is named, whichever ends first.
static void count(struct pool *p, long run, const struct study_outcome *outcome) {
    struct study_progress *to = &p->progress;
    to->n_done++;
    if (outcome->status == STUDY_FAILED) {
        to->n_failed++;
        if (!to->failure[0] || run < p->failed) {
            struct plan_text t;
            p->failed = run;
            snprintf(to->failure, sizeof to->failure, "%s: %s", plan_describe(p->plan, run, &t),
                     outcome->message);
        }
    }
}

static int enter_run(struct pool *p, const struct trial *t, struct error *e) {
    if (t->status != STATUS_OK) {
        *e = t->error;
        return t->status;
    }
    const int status = journal_add_run(p->journal, t->entry, &t->outcome, t->value, e);
    if (status == STATUS_OK) {
        count(p, t->run, &t->outcome);
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

// What the calling thread does meanwhile.
static int watch(void *context, struct workers *w, struct error *e) {
    struct pool *p = context;
    const struct study_request *q = p->request;
    workers_lock(w);
    const struct study_progress now = p->progress;
    workers_unlock(w);
    const int status = q->poll ? q->poll(q->context, &now, e) : STATUS_OK;
    return status == STATUS_OK && ++p->tick % SYNC_TICKS == 0 ? journal_sync(p->journal, e)
                                                              : status;
}

int pool_run(const struct study_request *q, const struct plan *plan, struct journal *journal,
             struct ledger *ledger, struct study_progress *progress, struct error *e) {
    struct pool p = {.request = q,
                     .plan = plan,
                     .journal = journal,
                     .ledger = ledger,
                     .records = shelf_create(SHELF_BYTES),
                     .progress = *progress};
    if (!p.records) {
        return error_no_memory(e);
    }
    const long missing = plan->n_mine - journal->n_done;
    const int n_thread = missing < q->n_thread ? (int)missing : q->n_thread;
    p.progress.n_thread = n_thread;
    p.left = missing;
    p.most = trial_most(plan);
    const size_t values = (size_t)p.most * plan->table->n_value;
    const struct workers_request request = {.n_thread = n_thread,
                                            .scratch =
                                                sizeof(struct batch) + values * sizeof(double),
                                            .take = take,
                                            .work = work,
                                            .enter = enter,
                                            .poll = watch,
                                            .context = &p};
    const int status = n_thread > 0 ? workers_run(&request, e) : STATUS_OK;
    shelf_free(p.records);
    *progress = p.progress;
    return status;
}
