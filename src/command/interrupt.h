// SPDX-License-Identifier: GPL-3.0-or-later
// Signals that end a run in good order.
#ifndef JOSTLE_INTERRUPT_H
#define JOSTLE_INTERRUPT_H

#include "jostle/error.h"

// From now on SIGINT, SIGTERM, SIGHUP and SIGXCPU (ulimit -St) are noted; one that comes a second
// or two after the first ends the program at once. A SIGHUP that is ignored stays so.
void interrupt_catch(void);

// The signal noted; 0: none.
int interrupt_number(void);

// STATUS_SYSTEM, "interrupted by signal N", if one was noted.
int interrupt_check(struct error *e);

#endif
