// SPDX-License-Identifier: GPL-3.0-or-later
// Dormand & Prince's method: the step, and what its files do with it. dormand_prince.c puts them
// together.
#ifndef JOSTLE_DP_H
#define JOSTLE_DP_H

#include "model/stability.h"
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

// Bounds of the fastest motions at `now`.
struct dp_fastest {
    struct stability *building;  // (n_building) without links
    double alone;                // [T] longest step without links
    double longest;              // [T] and with those that are live
    bool linked;                 // some were, when `longest` was found
    double *spring, *dashpot;    // [1/T^2] [1/T] (n_dof) scratch, zeros between calls
    double *most;                // [1/T^2] (n_building) scratch, as well
};

struct dp;

// The n floors from `first` on, in whole lanes, that are looked at for peaks: negative are those
// that could have one in the step, and whose acceleration could.
enum { DP_LOOK = 8 * LANES_WIDTH };
struct dp_look {
    int first, n;
    int64_t hit[DP_LOOK], bends[DP_LOOK];
};

// What a step does with all floors, in vectors (dp_floors.h).
struct dp_floors {
    void (*take)(struct dp *p);  // dp_step_take, once length and end are set
    // Accelerations of the linear floors from `first` up to `end`, of whole lanes.
    void (*rates)(const struct dp_system *s, double ground, ptrdiff_t first, ptrdiff_t end,
                  struct dp_rates *r);
    double (*error)(const struct dp *p);            // largest of u and v over their sizes
    bool (*look)(struct dp *p, struct dp_look *l);  // and drifts; true: any could
    void (*work)(const struct dp *p, const double *time, struct energy_account *energy);
};
extern const struct dp_floors dp_narrow, dp_wide;

struct dp {
    const struct model *model;   // borrowed
    struct results *results;     // borrowed
    struct impact_log *impacts;  // borrowed
    struct dp_system system;
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
    struct dp_fastest fastest;
    double trial;          // [T] what the error control would take next
    struct scales scales;  // of errors
    int noisy;             // steps since `scales` says so
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

// dp_step.c: a step by the stages of the method, as long as the tolerance allows.

// Room for the bounds of p->fastest and the scales of errors; false: no memory.
bool dp_step_alloc(struct dp *p, struct arena *a);

// The first step, before there is any error.
void dp_step_start(struct dp *p);

// Makes the first stage, at `now`, where it is not the last of the step before.
void dp_step_first(struct dp *p);

// Takes the step from `now` of length h to time `end` into `next`.
void dp_step_take(struct dp *p, double h, double end);

// Penetrations of all links of state `s` and their rates.
void dp_step_gaps(const struct dp *p, struct state *s, double *rate);

// The next instant at which a step has to end.
double dp_step_limit(const struct dp *p);

// Tries steps until one meets the tolerance. STATUS_FAILED: they become too short or too many;
// names the time and the cause.
int dp_step_attempt(struct dp *p, struct error *e);

// The estimated error of the step, over the tolerance. dp_step_reject rejects the step for it: the
// next one is shorter. STATUS_FAILED: it cannot be.
double dp_step_error(const struct dp *p);
int dp_step_reject(struct dp *p, double error, struct error *e);

// dp_events.c: what ends a step before its time.

// Puts the first event in the step into p->event.
void dp_events_first(struct dp *p);

// Takes the step again so that it ends at p->event.
void dp_events_locate(struct dp *p);

// Is it one of a storey? Else it is one of a link.
bool dp_events_is_of_storey(const struct dp_event *e);

// Has the velocity of closed contact k, now on the other branch, come to 0 where its force jumps,
// so that either branch leads back there?
bool dp_events_sticks(struct dp *p, int k);

// Lets p->event happen at `now`, and begins again from there (dp_happen.c). STATUS_SYSTEM: no
// memory; STATUS_FAILED: what dormand-prince does not follow, or events without end.
int dp_happen(struct dp *p, struct error *e);

// dp_peaks.c: largest values.

// Those of the step, within it and at its end.
void dp_peaks_step(struct dp *p);

// Those at `now` after a jump, for when it lasts or is shown: between events at one instant there
// are velocities and accelerations that nobody has for any time.
void dp_peaks_jump(struct dp *p);

// Force and penetration in the step of link number i of the active ones, into its peaks and into
// `share`.
void dp_peaks_link(struct dp *p, int i, struct impact_share *share);

// dp_account.c: works and impulses of steps, and the state within a step.

// Takes the step into the accounts of energy and of impacts.
void dp_account_step(struct dp *p);

// The state at time t of the step, and the account of energy up to it.
void dp_account_row(struct dp *p, double t, struct state *row, struct energy_account *energy);

#endif
