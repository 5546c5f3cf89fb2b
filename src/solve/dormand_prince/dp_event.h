// SPDX-License-Identifier: GPL-3.0-or-later
// The events that end a step of Dormand & Prince's method.
#ifndef JOSTLE_DP_EVENT_H
#define JOSTLE_DP_EVENT_H

#include "solve/dormand_prince/dp.h"

// Puts the first event in the step into p->event.
void dp_event_first(struct dp *p);

// Is it one of a storey? Else it is one of a link.
bool dp_event_is_of_storey(const struct dp_event *e);

#endif
