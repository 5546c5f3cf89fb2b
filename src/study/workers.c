// SPDX-License-Identifier: GPL-3.0-or-later
#include "study/workers.h"

#include <pthread.h>
#include <stdatomic.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "core/number.h"

enum { TICK = 100000000 };         // [ns] between polls
enum { STACK_BYTES = 512 << 10 };  // of a thread, whatever `ulimit -s` says

// Everything below the lock is guarded by it.
struct workers {
    const struct workers_request *request;
    atomic_bool stop;
    pthread_mutex_t lock;
    pthread_cond_t ended;  // a worker has
    int n_worker;
    long next, n_done;  // jobs
    int status;         // the first error
    struct error error;
};

void workers_lock(struct workers *w) {
    pthread_mutex_lock(&w->lock);
}

void workers_unlock(struct workers *w) {
    pthread_mutex_unlock(&w->lock);
}

bool workers_stopped(struct workers *w) {
    return atomic_load(&w->stop);
}

int workers_poll(void *context, double time, struct error *e) {
    (void)time;
    return workers_stopped(context) ? error_set(e, STATUS_SYSTEM, "the runs have ended")
                                    : STATUS_OK;
}

// Ends the work with this error, unless another came first.
static void give_up(struct workers *w, int status, const struct error *e) {
    if (w->status == STATUS_OK) {
        w->status = status;
        w->error = *e;
    }
    atomic_store(&w->stop, true);
}

static long take(struct workers *w, void *scratch) {
    const struct workers_request *q = w->request;
    if (workers_stopped(w)) {
        return -1;
    }
    return q->take ? q->take(q->context, scratch) : w->next < q->n_job ? w->next++ : -1;
}

static void work(struct workers *w, void *scratch) {
    const struct workers_request *q = w->request;
    workers_lock(w);
    for (long job; (job = take(w, scratch)) >= 0;) {
        struct error e;
        workers_unlock(w);
        int status = q->work(q->context, w, job, scratch, &e);
        workers_lock(w);
        if (status == STATUS_OK && q->enter) {
            status = q->enter(q->context, job, scratch, &e);
        }
        w->n_done += status == STATUS_OK;
        if (status != STATUS_OK) {
            give_up(w, status, &e);
        }
    }
    workers_unlock(w);
}

static void *worker(void *context) {
    struct workers *w = context;
    void *scratch = malloc(w->request->scratch);
    if (scratch) {
        work(w, scratch);
    }
    workers_lock(w);
    if (!scratch) {
        struct error e;
        give_up(w, error_no_memory(&e), &e);
    }
    free(scratch);
    w->n_worker--;
    pthread_cond_signal(&w->ended);
    workers_unlock(w);
    return NULL;
}

// What the calling thread does meanwhile; returns when all workers have ended.
static void watch(struct workers *w) {
    const struct workers_request *q = w->request;
    workers_lock(w);
    while (w->n_worker > 0) {
        struct timespec until;
        clock_gettime(CLOCK_MONOTONIC, &until);
        until.tv_nsec += TICK;
        until.tv_sec += until.tv_nsec / 1000000000;
        until.tv_nsec %= 1000000000;
        while (w->n_worker > 0 && pthread_cond_timedwait(&w->ended, &w->lock, &until) == 0) {
        }
        const long n_done = w->n_done;
        struct error e;
        workers_unlock(w);
        const int status = q->poll(q->context, w, n_done, &e);
        workers_lock(w);
        if (status != STATUS_OK) {
            give_up(w, status, &e);
        }
    }
    workers_unlock(w);
}

static int start(struct workers *w, pthread_t *thread, int wanted) {
    int n = 0;
    workers_lock(w);
    for (; n < wanted; n++) {
        pthread_attr_t attributes;
        int cause = pthread_attr_init(&attributes);
        if (cause == 0) {
            cause = pthread_attr_setstacksize(&attributes, STACK_BYTES);
            cause = cause == 0 ? pthread_create(&thread[n], &attributes, worker, w) : cause;
            pthread_attr_destroy(&attributes);
        }
        if (cause != 0) {
            struct error e;
            give_up(w,
                    error_set(&e, STATUS_SYSTEM, "cannot start %d threads: %s", wanted,
                              strerror(cause)),
                    &e);
            break;
        }
        w->n_worker++;
    }
    workers_unlock(w);
    return n;
}

static int init_locks(struct workers *w) {
    pthread_condattr_t attributes;
    if (pthread_condattr_init(&attributes) != 0) {
        return -1;
    }
    int bad = pthread_condattr_setclock(&attributes, CLOCK_MONOTONIC) != 0 ||
              pthread_cond_init(&w->ended, &attributes) != 0;
    pthread_condattr_destroy(&attributes);
    if (!bad && pthread_mutex_init(&w->lock, NULL) != 0) {
        pthread_cond_destroy(&w->ended);
        bad = 1;
    }
    return bad ? -1 : 0;
}

int workers_run(const struct workers_request *q, struct error *e) {
    struct workers w = {.request = q};
    const int wanted = q->take ? q->n_thread : (int)number_least(q->n_thread, q->n_job);
    atomic_init(&w.stop, false);
    pthread_t *thread = calloc((size_t)wanted + 1, sizeof *thread);
    if (!thread || init_locks(&w) != 0) {
        free(thread);
        return error_no_memory(e);
    }
    const int n_thread = start(&w, thread, wanted);
    watch(&w);
    for (int i = 0; i < n_thread; i++) {
        pthread_join(thread[i], NULL);
    }
    pthread_cond_destroy(&w.ended);
    pthread_mutex_destroy(&w.lock);
    free(thread);
    if (w.status != STATUS_OK) {
        *e = w.error;
    }
    return w.status;
}
