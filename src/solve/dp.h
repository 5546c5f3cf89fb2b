// SPDX-License-Identifier: GPL-3.0-or-later
// What the parts of the Dormand-Prince integrator share: dp_stages.c makes a step, dp_event.c finds
// where it ends, dp_peaks.c and dp_account.c keep what the step brings, dormand_prince.c controls
// it.
#ifndef JOSTLE_DP_H
#define JOSTLE_DP_H

#include "solve/dp_system.h"
#include "solve/energy.h"
#include "solve/gaps.h"
#include "solve/hermite.h"
#include "solve/impacts.h"
#include "solve/pace.h"
#include "solve/scale.h"

enum { DP_STAGES = 7 };

enum dp_event_kind {
    DP_NONE,
    DP_CLOSE,   // a contact closes
    DP_OPEN,    // or opens
    DP_MEET,    // the bodies of a rigid contact meet
    DP_KINK,    // the force of a closed contact has a kink
    DP_TURN,    // the velocity of a closed contact changes its sign
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

struct dp {
    const struct model *model;   // borrowed
    struct results *results;     // borrowed
    struct impact_log *impacts;  // borrowed
    struct dp_system system;
    const struct dp_floors *floors;
    struct gaps gaps;        // only the runs of links
    struct state now, next;  // the ends of the step; histories and closed links are in `now`
    struct dp_rates rates[DP_STAGES];   // in any order
    struct dp_rates *stage[DP_STAGES];  // the first at `now`, the last at `next`
    struct meeting *meeting;            // (n_contact) scratch of rigid impacts
    double *rate[2];                    // [L/T] (n_link) of penetrations at both ends
    double *reach;                      // [L] (n_contact) upper bounds of penetrations in the step
    bool closes, deepens;               // can any be above 0, or above its peak?
    struct scales scales;               // of errors
    bool grown;                         // since the scales were made
    struct energy_account before, energy;  // up to the start and to the end of the step

    double h;               // [T] the step; 0: none has been made
    double trial;           // [T] what the error control would take next
    bool closed_now;        // a contact has closed at `now`
    struct dp_event event;  // at the end of the step
    int last_link;          // of the last event; -1: none
    long events_before;     // events when time was last seen to move
    double time_before;     // [T] then
    struct pace pace;       // of all steps
};

// The n floors from `first` on, in whole lanes, that are looked at for peaks: negative are those
// that could have one in the step, and whose acceleration could.
enum { DP_LOOK = 8 * LANES_WIDTH };
struct dp_look {
    int first, n;
    int64_t hit[DP_LOOK], bends[DP_LOOK];
};

// What a step does with all floors, in vectors (dp_floors.h).
struct dp_floors {
    void (*take)(struct dp *p);                     // dp_stages_take, once length and end are set
    double (*error)(const struct dp *p);            // largest of u and v over their sizes
    bool (*look)(struct dp *p, struct dp_look *l);  // and drifts; true: any could
    void (*work)(const struct dp *p, const double *time, struct energy_account *energy);
};
extern const struct dp_floors dp_narrow, dp_wide;

// dp_stages.c: takes the step from `now` of length h to time `end` into `next`.
void dp_stages_take(struct dp *p, double h, double end);

// The estimated error of that step over the tolerance.
double dp_stages_error(const struct dp *p);

// Integral over the step, up to the place x in it, of what has the values f at the stages: h sum
// b_i(x) f_i; and over the whole of it.
void dp_stages_weights(double x, double *weight);
extern const double dp_stages_whole[DP_STAGES];

// Adds the works of the ground and of dampers on linear floors, by such weights.
void dp_stages_work(const struct dp *p, const double *weight, struct energy_account *energy);

// Penetrations of all links of state `s` and their rates.
void dp_stages_gaps(const struct dp *p, struct state *s, double *rate);

// The motion of all floors at place x of the step.
void dp_stages_between(const struct dp *p, double x, double *u, double *v);

// dp_event.c: the motion of a floor, of a link, of a storey, and the first event in the
// step, into p->event.
struct motion dp_event_floor(const struct dp *p, int i);
struct motion dp_event_link(const struct dp *p, int k);
struct motion dp_event_storey(const struct dp *p, int i);
void dp_event_first(struct dp *p);

// Ways of link k that mean nothing [L].
double dp_event_noise(const struct dp *p, int k);

// dp_kink.c: the first kink in the step of the force of closed contact k, whose law has any, or
// `other` if that is earlier; how far the end of the step is before the kink, and the rate of that.
struct dp_event dp_kink_before(const struct dp *p, int k, struct dp_event other);
double dp_kink_at_end(const struct dp *p, int k, double *rate);

// dp_kink.c: has the velocity of closed contact k, now on the other branch, come to 0 where its
// force jumps, so that either branch leads back there?
bool dp_kink_sticks(struct dp *p, int k);

// Takes the step again so that it ends at its event.
void dp_event_locate(struct dp *p);

// Changes branch or contact at state `now`, where the event is. STATUS_SYSTEM: no memory.
int dp_event_apply(struct dp *p, const struct dp_event *event, struct error *e);

// dp_peaks.c: largest values within the step and at its end; at `now` after a jump.
void dp_peaks_step(struct dp *p);
void dp_peaks_now(struct dp *p);

// Force and penetration in the step of link number i of the active ones, into its peaks and into
// `share`.
void dp_peaks_link(struct dp *p, int i, struct impact_share *share);

// dp_account.c: works and impulses of the step, and the state at an instant of it.
void dp_account_step(struct dp *p);
void dp_account_row(struct dp *p, double t, struct state *row, struct energy_account *energy);

// The total acceleration of floor i at place x of the step.
double dp_account_acceleration(struct dp *p, double x, int i);

#endif
