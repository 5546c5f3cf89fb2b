// SPDX-License-Identifier: GPL-3.0-or-later
// Threads that share out numbered jobs.
#ifndef JOSTLE_CREW_H
#define JOSTLE_CREW_H

#include "jostle/error.h"

struct crew {
    long n_job;
    int n_thread;
    // Does job `number`, from 0, in one of the threads; jobs begin in the order of their numbers.
    // Not 0 ends the work with that status once the other threads have done their jobs.
    int (*job)(void *context, long number, struct error *e);
    // Called every 0.1 s by the thread that called crew_run; not 0 ends the work. NULL: nothing.
    int (*poll)(void *context, long n_done, struct error *e);
    void *context;
};

// Returns when all jobs are done, or with the first error: of a job, of poll, or STATUS_SYSTEM (no
// memory, no threads).
int crew_run(const struct crew *c, struct error *e);

#endif
