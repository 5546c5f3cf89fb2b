// SPDX-License-Identifier: GPL-3.0-or-later
// Threads that take one job after the other until there is none. Jobs share nothing but what their
// owner guards by the lock.
#ifndef JOSTLE_WORKERS_H
#define JOSTLE_WORKERS_H

#include <stdbool.h>
#include <stddef.h>

#include "jostle/error.h"

struct workers;  // while they work

struct workers_request {
    int n_thread;    // at least 1; without `take`, no more threads start than there are jobs
    size_t scratch;  // bytes that each thread has for itself
    long n_job;      // without `take`: the jobs are the numbers from 0 to n_job - 1
    // Gives the next job; -1: there is none. Called under the lock; what it leaves in `scratch` is
    // passed to the other two. NULL: the next number.
    long (*take)(void *context, void *scratch);
    // Does the job. Called without the lock.
    int (*work)(void *context, struct workers *w, long job, void *scratch, struct error *e);
    // Enters what work left in `scratch`. Called under the lock. NULL: there is nothing to enter.
    int (*enter)(void *context, long job, const void *scratch, struct error *e);
    // Called by the calling thread every tenth of a second, without the lock.
    int (*poll)(void *context, struct workers *w, long n_done, struct error *e);
    void *context;
};

// Returns when no job is left and every thread has ended. The first error of any of the functions
// ends it early, after the jobs under way. Errors: theirs, and STATUS_SYSTEM (no memory, no
// threads).
int workers_run(const struct workers_request *q, struct error *e);

// Guard what the jobs share.
void workers_lock(struct workers *w);
void workers_unlock(struct workers *w);

// True if the work is to end: no job is to be begun or continued.
bool workers_stopped(struct workers *w);

// What a run asks now and then whose context is the workers: an error if the work is to end.
int workers_poll(void *context, double time, struct error *e);

#endif
