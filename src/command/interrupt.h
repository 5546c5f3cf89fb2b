// SPDX-License-Identifier: GPL-3.0-or-later
// Signals that end a run in good order.
#ifndef JOSTLE_INTERRUPT_H
#define JOSTLE_INTERRUPT_H

#include <sys/types.h>

#include "jostle/error.h"

// From now on SIGINT, SIGTERM, SIGHUP, SIGXCPU (ulimit -St) and SIGUSR1 (sbatch --signal, before a
// job is killed) are noted. A signal that comes a second or two after the first ends the program at
// once. A signal that is ignored stays ignored, as nohup and the background jobs of a shell want.
// Calls of the system that such a signal interrupts go on.
void interrupt_catch(void);

// The process that the next signal also ends, as the program waits for it; 0: none. A signal noted
// before ends it now.
void interrupt_also(pid_t process);

// The signal noted; 0: none.
int interrupt_number(void);

// STATUS_SYSTEM, "interrupted by signal N", if one was noted.
int interrupt_check(struct error *e);

#endif
