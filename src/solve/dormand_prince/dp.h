// SPDX-License-Identifier: GPL-3.0-or-later
// What the parts of Dormand & Prince's method share; dormand_prince.c puts them together.
#ifndef JOSTLE_DP_H
#define JOSTLE_DP_H

#include "solve/account/energy.h"
#include "solve/account/impacts.h"
#include "solve/contact/gaps.h"
#include "solve/dormand_prince/dp_rates.h"
#include "solve/pace.h"
#include "solve/scale.h"

enum { DP_STAGES = 7 };

enum dp_event_kind {
    DP_NONE,
    DP_CLOSE,   // a contact closes
    DP_OPEN,    // or opens
    DP_MEET,    // the bodies of a rigid contact meet
    DP_KINK,    // the force of a closed contact has a kink
    DP_TURN,    // the velocity of a closed contact or a damper changes its sign
    DP_BRANCH,  // a storey comes to the end of its line
    DP_UNLOAD,  // the drift of a yielding storey turns round
};

// What ends a step before its time.
struct dp_event {
    enum dp_event_kind kind;
    int index;         // of the link, or the floor above the storey
    double place;      // in the step, 0 to 1
    double direction;  // sign of what passes through zero, after it: d, its velocity, the drift's
    double target;     // [L] drift at which the branch ends
};

struct dp_floors;

struct dp {
    const struct model *model;   // borrowed
    struct results *results;     // borrowed
    struct impact_log *impacts;  // borrowed
    struct dp_system system;
    const struct dp_floors *floors;
    struct energy_account before, energy;  // up to the start and to the end of the step

    // The step.
    double h;                           // [T] its length; 0: none has been made
    struct state now, next;             // its ends; histories and closed links are in `now`
    struct dp_rates rates[DP_STAGES];   // in any order
    struct dp_rates *stage[DP_STAGES];  // the first at `now`, the last at `next`

    // Its links.
    struct gaps gaps;         // only the runs of links
    double *rate[2];          // [L/T] (n_link) of penetrations at both ends
    double *reach;            // [L] (n_contact) upper bounds of penetrations
    bool closes, deepens;     // can any be above 0, or above its peak?
    struct meeting *meeting;  // (n_contact) scratch of rigid impacts

    // Its length.
    double trial;          // [T] what the error control would take next
    struct scales scales;  // of errors
    bool grown;            // motions have, since the scales were made
    bool jumped;           // something has at `now`, of which no peaks have been taken since
    bool is_steep;         // a force may begin with an infinite slope at `now`
    struct pace pace;      // of all steps

    // Its event.
    struct dp_event event;  // at the end of the step
    int last_link;          // of the last event; -1: none
    long events_before;     // events when time was last seen to move
    double time_before;     // [T] then
};

#endif
