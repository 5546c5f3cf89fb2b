// SPDX-License-Identifier: GPL-3.0-or-later
#include "study/pool.h"

#include <pthread.h>
#include <stdatomic.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "jostle/ensemble.h"
#include "motion/shelf.h"
#include "study/trial.h"

enum { TICK = 100000000, SYNC_TICKS = 10 };  // [ns] between polls; polls between synchronisations

static const size_t RECORDS_MAX = (size_t)64 << 20;  // bytes

// Everything below the lock is guarded by it.
struct pool {
    const struct plan *plan;
    int most;  // runs that a thread takes at once
    atomic_bool stop;
    pthread_mutex_t lock;
    pthread_cond_t ended;  // a worker has
    struct journal *journal;
    struct ledger *ledger;
    struct shelf *records;
    struct study_progress progress;
    long next;  // the run to look at next
    long left;  // runs that no thread has taken yet
    int n_worker;
    int status;  // the first error
    struct error error;
};

// Ends the study with this error, unless another came first.
static void give_up(struct pool *p, int status, const struct error *e) {
    if (p->status == STATUS_OK) {
        p->status = status;
        p->error = *e;
    }
    atomic_store(&p->stop, true);
}

static int poll_trial(void *context, double time, struct error *e) {
    struct pool *p = context;
    (void)time;
    return atomic_load(&p->stop) ? error_set(e, STATUS_SYSTEM, "the study has ended") : STATUS_OK;
}

static int enter_files(void *context, const struct deck_path *files, struct error *e) {
    struct pool *p = context;
    int status = STATUS_OK;
    pthread_mutex_lock(&p->lock);
    for (; files && status == STATUS_OK; files = files->next) {
        const struct ledger_file *added;
        status = ledger_check(p->ledger, files->path, &added, e);
        if (status == STATUS_OK && added) {
            status = journal_add_file(p->journal, added->path, added->sum, e);
        }
    }
    pthread_mutex_unlock(&p->lock);
    return status;
}

// How many runs a thread takes at once: those that can go in lockstep, but so that all threads get
// their share.
static long portion(const struct pool *p) {
    const long share = (p->left + p->progress.n_thread - 1) / p->progress.n_thread;
    return share < p->most ? share : p->most;
}

// The next runs to be done; returns how many.
static int take(struct pool *p, struct trial *trial) {
    int n = 0;
    const long most = portion(p);
    while (n < most && p->next < p->plan->n_run && !atomic_load(&p->stop)) {
        const long run = p->next++;
        if (p->journal->offset[run] == 0) {
            trial[n++].run = run;
            p->left--;
        }
    }
    return n;
}

static void count(struct pool *p, long run, const struct study_outcome *outcome) {
    struct study_progress *to = &p->progress;
    to->n_done++;
    if (outcome->status == STUDY_FAILED) {
        to->n_failed++;
        if (!to->failure[0]) {
            struct plan_text t;
            snprintf(to->failure, sizeof to->failure, "%s: %s", plan_describe(p->plan, run, &t),
                     outcome->message);
        }
    }
}

static void finish(struct pool *p, struct trial *t) {
    if (t->status == STATUS_OK) {
        t->status = journal_add_run(p->journal, t->run, &t->outcome, t->value, &t->error);
    }
    if (t->status == STATUS_OK) {
        count(p, t->run, &t->outcome);
    } else {
        give_up(p, t->status, &t->error);
    }
}

static void work(struct pool *p, struct trial *trial) {
    const struct trial_watch watch = {
        .files = enter_files, .poll = poll_trial, .context = p, .records = p->records};
    pthread_mutex_lock(&p->lock);
    for (int n; (n = take(p, trial)) > 0;) {
        pthread_mutex_unlock(&p->lock);
        trial_run(p->plan, trial, n, &watch);
        pthread_mutex_lock(&p->lock);
        for (int i = 0; i < n; i++) {
            finish(p, &trial[i]);
        }
    }
    pthread_mutex_unlock(&p->lock);
}

static void *worker(void *context) {
    struct pool *p = context;
    struct trial trial[ENSEMBLE_MAX];
    const size_t n_value = p->plan->table->n_value;
    double *value = malloc((size_t)p->most * n_value * sizeof *value);
    for (int i = 0; value && i < p->most; i++) {
        trial[i].value = value + (size_t)i * n_value;
    }
    if (value) {
        work(p, trial);
    }
    pthread_mutex_lock(&p->lock);
    if (!value) {
        struct error e;
        give_up(p, error_no_memory(&e), &e);
    }
    free(value);
    p->n_worker--;
    pthread_cond_signal(&p->ended);
    pthread_mutex_unlock(&p->lock);
    return NULL;
}

static void wait_a_tick(struct pool *p) {
    struct timespec until;
    clock_gettime(CLOCK_MONOTONIC, &until);
    until.tv_nsec += TICK;
    until.tv_sec += until.tv_nsec / 1000000000;
    until.tv_nsec %= 1000000000;
    while (p->n_worker > 0 && pthread_cond_timedwait(&p->ended, &p->lock, &until) == 0) {
    }
}

// What the calling thread does meanwhile; returns when all workers have ended.
static void watch(struct pool *p, const struct study_request *q) {
    pthread_mutex_lock(&p->lock);
    for (int tick = 1; p->n_worker > 0; tick++) {
        wait_a_tick(p);
        struct study_progress now = p->progress;
        struct error e;
        pthread_mutex_unlock(&p->lock);
        int status = q->poll ? q->poll(q->context, &now, &e) : STATUS_OK;
        if (status == STATUS_OK && tick % SYNC_TICKS == 0) {
            status = journal_sync(p->journal, &e);
        }
        pthread_mutex_lock(&p->lock);
        if (status != STATUS_OK) {
            give_up(p, status, &e);
        }
    }
    pthread_mutex_unlock(&p->lock);
}

static void start(struct pool *p, pthread_t *thread, int *n_thread) {
    const int wanted = *n_thread;
    *n_thread = 0;
    pthread_mutex_lock(&p->lock);
    for (int i = 0; i < wanted; i++) {
        int cause = pthread_create(&thread[i], NULL, worker, p);
        if (cause != 0) {
            struct error e;
            give_up(p,
                    error_set(&e, STATUS_SYSTEM, "cannot start %d threads: %s", wanted,
                              strerror(cause)),
                    &e);
            break;
        }
        p->n_worker++;
        *n_thread = i + 1;
    }
    pthread_mutex_unlock(&p->lock);
}

static void run_threads(struct pool *p, const struct study_request *q, pthread_t *thread,
                        int n_thread) {
    start(p, thread, &n_thread);
    watch(p, q);
    for (int i = 0; i < n_thread; i++) {
        pthread_join(thread[i], NULL);
    }
}

static int init_locks(struct pool *p) {
    pthread_condattr_t attributes;
    if (pthread_condattr_init(&attributes) != 0) {
        return -1;
    }
    int bad = pthread_condattr_setclock(&attributes, CLOCK_MONOTONIC) != 0 ||
              pthread_cond_init(&p->ended, &attributes) != 0;
    pthread_condattr_destroy(&attributes);
    if (!bad && pthread_mutex_init(&p->lock, NULL) != 0) {
        pthread_cond_destroy(&p->ended);
        bad = 1;
    }
    return bad ? -1 : 0;
}

int pool_run(const struct study_request *q, const struct plan *plan, struct journal *journal,
             struct ledger *ledger, struct study_progress *progress, struct error *e) {
    struct pool p = {.plan = plan, .journal = journal, .ledger = ledger, .progress = *progress};
    p.records = shelf_create(RECORDS_MAX);
    atomic_init(&p.stop, false);
    const long missing = plan->n_run - journal->n_done;
    const int n_thread = missing < q->n_thread ? (int)missing : q->n_thread;
    pthread_t *thread = calloc((size_t)n_thread + 1, sizeof *thread);
    if (!thread || !p.records || init_locks(&p) != 0) {
        free(thread);
        shelf_free(p.records);
        return error_no_memory(e);
    }
    p.progress.n_thread = n_thread;
    p.left = missing;
    p.most = trial_most(plan);
    run_threads(&p, q, thread, n_thread);
    pthread_cond_destroy(&p.ended);
    pthread_mutex_destroy(&p.lock);
    shelf_free(p.records);
    free(thread);
    *progress = p.progress;
    if (p.status != STATUS_OK) {
        *e = p.error;
    }
    return p.status;
}
