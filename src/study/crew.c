// SPDX-License-Identifier: GPL-3.0-or-later
#include "study/crew.h"

#include <pthread.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

enum { TICK = 100000000 };  // [ns] between polls

// Everything below the lock is guarded by it.
struct work {
    const struct crew *crew;
    pthread_mutex_t lock;
    pthread_cond_t ended;  // a worker has
    long next, n_done;
    int n_worker;
    int status;  // the first error
    struct error error;
};

static void give_up(struct work *w, int status, const struct error *e) {
    if (w->status == STATUS_OK) {
        w->status = status;
        w->error = *e;
    }
}

static void *worker(void *context) {
    struct work *w = context;
    pthread_mutex_lock(&w->lock);
    while (w->next < w->crew->n_job && w->status == STATUS_OK) {
        const long number = w->next++;
        struct error e;
        pthread_mutex_unlock(&w->lock);
        int status = w->crew->job(w->crew->context, number, &e);
        pthread_mutex_lock(&w->lock);
        if (status == STATUS_OK) {
            w->n_done++;
        } else {
            give_up(w, status, &e);
        }
    }
    w->n_worker--;
    pthread_cond_signal(&w->ended);
    pthread_mutex_unlock(&w->lock);
    return NULL;
}

static void wait_a_tick(struct work *w) {
    struct timespec until;
    clock_gettime(CLOCK_MONOTONIC, &until);
    until.tv_nsec += TICK;
    until.tv_sec += until.tv_nsec / 1000000000;
    until.tv_nsec %= 1000000000;
    while (w->n_worker > 0 && pthread_cond_timedwait(&w->ended, &w->lock, &until) == 0) {
    }
}

// What the calling thread does meanwhile; returns when all workers have ended.
static void watch(struct work *w) {
    pthread_mutex_lock(&w->lock);
    while (w->n_worker > 0) {
        wait_a_tick(w);
        const long n_done = w->n_done;
        struct error e;
        pthread_mutex_unlock(&w->lock);
        int status = w->crew->poll ? w->crew->poll(w->crew->context, n_done, &e) : STATUS_OK;
        pthread_mutex_lock(&w->lock);
        if (status != STATUS_OK) {
            give_up(w, status, &e);
        }
    }
    pthread_mutex_unlock(&w->lock);
}

// Returns how many have started.
static int start(struct work *w, pthread_t *thread, int n_thread) {
    int n = 0;
    pthread_mutex_lock(&w->lock);
    for (int cause = 0; n < n_thread && cause == 0; n += cause == 0) {
        cause = pthread_create(&thread[n], NULL, worker, w);
        w->n_worker += cause == 0;
        if (cause != 0) {
            struct error e;
            int status = error_set(&e, STATUS_SYSTEM, "cannot start %d threads: %s", n_thread,
                                   strerror(cause));
            give_up(w, status, &e);
        }
    }
    pthread_mutex_unlock(&w->lock);
    return n;
}

static int init_locks(struct work *w) {
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

int crew_run(const struct crew *c, struct error *e) {
    struct work w = {.crew = c};
    const int wanted = c->n_job < c->n_thread ? (int)c->n_job : c->n_thread;
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
