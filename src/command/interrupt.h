// SPDX-License-Identifier: GPL-3.0-or-later
// Signals that end a run in good order.
#ifndef JOSTLE_INTERRUPT_H
#define JOSTLE_INTERRUPT_H

// From now on SIGINT, SIGTERM and SIGHUP are noted; the second one ends the program at once.
void interrupt_catch(void);

// The signal noted; 0: none.
int interrupt_number(void);

#endif
