// SPDX-License-Identifier: GPL-3.0-or-later
// Dormand & Prince's method: what its files share. dormand_prince.c puts them together.
//
// In a step every law is held on the branch that it is on at the start of the step. x = t / h in
// [0, 1] is the place in a step of length h.
#ifndef JOSTLE_DP_H
#define JOSTLE_DP_H

#include <float.h>

#include "law/bilateral.h"
#include "model/foundation.h"
#include "model/stability.h"
#include "solve/account/account.h"
#include "solve/contact/gaps.h"
#include "solve/event/hermite.h"
#include "solve/forcing.h"
#include "solve/pace.h"

enum { DP_STAGES = 7, DP_LAST = DP_STAGES - 1 };

// The branch of a link in a step: its velocity has this sign. That is what the law of a contact
// sees; that of a bilateral link sees the velocity itself.
enum phase {
    PHASE_RELEASE = -1,
    PHASE_ANY = 0,  // bilateral links whose force is smooth at v = 0
    PHASE_APPROACH = 1,
};

// What a floor's acceleration is made of, besides loads and links, each an array of core/lanes.h:
// M^-1 K and M^-1 C, each with the floor below, the floor itself and the one above; M^-1 times the
// forces that do not depend on the motion; and the share of the ground's acceleration, 1. For their
// works: the mass that the ground carries, and C, with twice what joins a floor to the one above.
enum dp_row {
    DP_K_BELOW,
    DP_K_OWN,
    DP_K_ABOVE,
    DP_C_BELOW,
    DP_C_OWN,
    DP_C_ABOVE,
    DP_CONSTANT,
    DP_GROUND,
    DP_CARRIED,
    DP_DAMPER,
    DP_DAMPER_ABOVE,
    DP_ROWS
};

// The equations of motion on the present branches.
struct dp_system {
    struct forcing forcing;
    bool creeps;             // some law of a link has a state of its own
    bool special;            // is there more than linear floors on one ground, and links?
    double *row[DP_ROWS];    // (n_dof) coefficients of the accelerations on this branch
    double *mobility;        // [1/M] (n_dof) 1 / m
    double *base, *tangent;  // [F] [F/L] (n_dof) shear = base + tangent drift on this branch
    double *most_drift;      // [L] (n_dof) largest committed drift of the inelastic storeys
    enum phase *phase;       // (n_link)
    int n_inelastic;         // storeys with a history
    int *inelastic;          // (n_dof) their indices
    int *building;           // (n_dof) index of the floor's building
    bool *calls;             // (n_dof) the storey's law is called, as it is not made of lines
    // Scratch: drifts, their rates, forces on floors or shears of parts (n_dof); histories and
    // scratch of parts.
    double *drift, *rate, *force;  // [L] [L/T] [F]
    double *part_history, *part_scratch;
};

// The system at one instant. Links are those live in the state at the start of the step.
struct dp_link_rates {
    struct contact_response response;
    double power;        // [F L/T] of its force
    double creep, flow;  // [L] [L/T] struct contact_law.creep: the value that grows, and its rate
};
struct dp_rates {
    double *u, *v;                 // [L] [L/T] (n_dof)
    double *a;                     // [L/T^2] (n_dof)
    struct forcing_values ground;  // (n_ground)
    struct dp_link_rates *link;    // (n_live)
    // [F L/T] of loads, of full dampings and on storeys that are not elastic; not where nothing is
    // special
    double input, damping, storey, *power;  // power: (n_dof) on each storey with a history
};

enum dp_event_kind {
    DP_NONE,
    DP_CLOSE,     // a contact closes
    DP_OPEN,      // or opens
    DP_MEET,      // the bodies of a rigid contact meet
    DP_KINK,      // the force of a closed contact has a kink
    DP_TURN,      // the velocity of a closed contact or a damper changes its sign
    DP_BRANCH,    // a storey comes to the end of its line
    DP_UNLOAD,    // the drift of a yielding storey turns round
    DP_COLLAPSE,  // a drift reaches its limit, at which the run ends
};

// What ends a step before its time.
struct dp_event {
    enum dp_event_kind kind;
    int index;         // of the link, or the floor above the storey
    double place;      // in the step
    double direction;  // its sign is that of what passes through zero, after the event
    double target;     // [L] drift at which the branch ends
};

// Bounds of the fastest motions at `now`.
struct dp_fastest {
    struct stability *building;  // (n_building) without links
    double alone;                // [T] longest step without links
    double longest;              // [T] and with those that are live
    bool linked;                 // there were live links when `longest` was found
    double *spring, *dashpot;    // [1/T^2] [1/T] (n_dof) scratch, zeros between calls
    double *most;                // [1/T^2] (n_building) scratch, as well
};

struct dp;

// The n floors from `first` on, in whole lanes. `hit` is negative where a floor may have a peak in
// the step, `bends` where its acceleration may.
enum { DP_CANDIDATES = 8 * LANES_WIDTH };
struct dp_candidates {
    int first, n;
    int64_t hit[DP_CANDIDATES], bends[DP_CANDIDATES];
};

// What a step does with all floors, in vectors (dp_floors.h).
struct dp_floors {
    void (*take)(struct dp *p);  // dp_step_take, once length and end are set
    // Accelerations of the linear floors from `first` up to `end`, of whole lanes.
    void (*rates)(const struct dp *p, double ground, ptrdiff_t first, ptrdiff_t end,
                  struct dp_rates *r);
    double (*error)(const struct dp *p);  // largest of u and v over their sizes
    bool (*candidates)(struct dp *p, struct dp_candidates *c);  // and drifts; true: any could
    void (*work)(const struct dp *p, const double *time, struct energy_account *energy);
};
extern const struct dp_floors dp_narrow, dp_wide;

enum { DP_FORCES = 6 };

struct dp {
    const struct model *model;       // borrowed
    struct results *results;         // borrowed
    struct impact_log *impacts;      // borrowed
    struct yielding *yielding;       // borrowed
    const struct dp_floors *floors;  // for the vectors of the processor at hand
    struct dp_system system;
    struct energy_account before, energy;  // up to the start and to the end of the step

    // The step.
    double h;                          // [T] its length; 0: none has been made
    struct state now, next;            // its ends; histories and closed links are in `now`
    struct dp_rates stage[DP_STAGES];  // the first at `now`, the last at `next`

    // Its links.
    struct gaps gaps;         // only the runs of links
    double *rate[2];          // [L/T] (n_link) of penetrations at both ends
    double *reach;            // [L] (n_contact) upper bounds of penetrations
    bool closes, deepens;     // may a penetration be above 0, or above its peak?
    struct meeting *meeting;  // (n_contact) scratch of rigid impacts

    // Its length.
    struct dp_fastest fastest;
    double trial;          // [T] what the error control would take next
    struct scales scales;  // of errors
    int noisy;             // steps since `scales` first says that rounding is too large
    bool grown;            // motions have grown since the scales were made
    bool jumped;           // something has jumped at `now`, and no peaks have been taken since
    bool is_steep;         // a force may begin with an infinite slope at `now`
    struct pace pace;      // of all steps

    // Its event.
    struct dp_event event;  // at the end of the step
    int last_link;          // of the last event; -1: none
    long events_before;     // events when time was last seen to move
    double time_before;     // [T] then

    double *force[DP_FORCES];  // (model.n_force) scratch of dp_peaks.c
};

// dp_rates.c: the branches of laws, and the right-hand side of the equations of motion.

extern const struct fields dp_system_fields, dp_rates_fields;

// The branches at `now`: forcing, storeys and links.
void dp_rates_start(struct dp *p);

// The branch of the inelastic storey below floor i at its committed state when its drift goes on in
// `direction` (its sign) beyond `from`: its drift, or the end of its line, from which it may be
// farther than is noise.
void dp_rates_branch(struct dp *p, int i, double from, double direction);

// The storey below floor i: its law at `drift` with the committed history, the smallest change of
// its drift that counts, its initial stiffness without P-delta, and its shear at `drift` on its
// branch [F].
struct storey_response dp_rates_storey(const struct dp *p, int i, double drift);
double dp_rates_noise(const struct dp *p, int i);
double dp_rates_stiffness(const struct dp *p, int i);
double dp_rates_shear(const struct dp *p, int i, double drift);

// Brings the histories of `now` to its present drifts, penetrations and velocities.
void dp_rates_commit(struct dp *p);

// The creep of live link number i at place x of the step.
double dp_rates_creep(const struct dp *p, int i, double x);

// The response of a damper whose slope has no bound at v = 0.
struct contact_response dp_rates_steep(const struct dp *p, const struct link *l, double d,
                                       double v);

// The response of link k at (d, v) on its branch; d and v may lie beyond it. In line, as is the
// next function: each stage calls them for each link.
static inline struct contact_response dp_rates_response(const struct dp *p, int k, double d,
                                                        double v) {
    const struct link *l = &p->model->link[k];
    const double *history = p->now.link_history + l->history;
    if (l->bilateral) {
        return bilateral_is_steep(l->law, l->constant) ? dp_rates_steep(p, l, d, v)
                                                       : l->law->force(l->constant, history, d, v);
    }
    int phase = p->system.phase[k];
    double inside = d > 0.0 ? d : 0.0;
    double seen = phase * v > 0.0 ? v : phase * DBL_MIN;
    struct contact_response r = l->law->force(l->constant, history, inside, seen);
    if (seen != v) {
        r.force += r.dfdv * v;
    }
    if (inside != d) {
        r.force += r.dfdd * d;
    }
    return r;
}

// Response and flow of live link number i, from r->creep.
static inline void dp_rates_link(const struct dp *p, int i, double d, double v,
                                 struct dp_link_rates *r) {
    const int k = p->now.live[i];
    const struct link *l = &p->model->link[k];
    if (l->law->creep) {
        const double history[] = {0.0, r->creep, 0.0};
        r->response = l->law->force(l->constant, history, d, v);
        r->flow = l->law->creep(l->constant, r->response.force);
    } else {
        r->response = dp_rates_response(p, k, d, v);
        r->flow = 0.0;
    }
}

// Whose rates are asked for: those of one building, by its index, or of all.
enum { DP_ALL = -1 };

// Accelerations, forces and powers at time t from r->u and r->v, with the histories of `now`: those
// of linear floors (dp_floors.h), and what dp_rates_add adds to them. Of one building the motions
// are needed of all that its links join it to.
void dp_rates_add(const struct dp *p, double t, int building, struct dp_rates *r);
void dp_rates_at(const struct dp *p, double t, int building, struct dp_rates *r);

// The motion of a building, or of all (DP_ALL), at place x of the step, and its rates there.
// Between steps only: they are made in the second stage, whose weight in the works is 0.
void dp_rates_move(const struct dp *p, double x, int building);
void dp_rates_within(struct dp *p, double x, int building);

// The storey shears of the parts of building `g` at displacements u and velocities v (n_dof), an
// array (n_dof): p->system.force, at the drifts p->system.drift. The history is one of states,
// `after` becomes that at the end, or is NULL.
const double *dp_rates_parts(const struct dp *p, const struct building *g, const double *history,
                             const double *u, const double *v, double *after);

// The ground's motion at time t into r->ground. Returns its acceleration where there is one ground
// only, else 0.
static inline double dp_rates_ground(const struct dp *p, double t, struct dp_rates *r) {
    const struct forcing *f = &p->system.forcing;
    if (p->model->n_ground == 1 && !f->sines) {
        return r->ground.a[0] = forcing_lines(f, 0, t);
    }
    forcing_ground(f, t, &r->ground);
    return p->model->n_ground == 1 ? r->ground.a[0] : 0.0;
}

// The motion in the step of a quantity that is linear in the displacements: value(p, what, i, x) at
// the displacements x (n_dof), or its rate where x are velocities. `what` and `i` say which one.
typedef double dp_value(const struct dp *p, int what, int i, const double *x);

static inline struct motion dp_motion(const struct dp *p, dp_value *value, int what, int i) {
    const struct state *now = &p->now, *next = &p->next;
    return (struct motion){
        .d = {value(p, what, i, now->u), value(p, what, i, next->u)},
        .v = {value(p, what, i, now->v), value(p, what, i, next->v)},
        .a = {value(p, what, i, now->a), value(p, what, i, next->a)},
        .h = p->h,
    };
}

// The displacement of floor i, and the drift below it.
static inline double dp_displacement(const struct dp *p, int what, int i, const double *x) {
    (void)p, (void)what;
    return x[i];
}

static inline double dp_drift(const struct dp *p, int what, int i, const double *x) {
    (void)what;
    return x[i] - p->model->chain.joint[i] * x[i - 1];
}

// The drift of the storey below floor i, without its foundation.
static inline double dp_deformation(const struct dp *p, int what, int i, const double *x) {
    (void)what;
    return foundation_drift(p->model, &p->model->building[p->system.building[i]], i, x);
}

// The motion of link k in the step.
static inline struct motion dp_motion_link(const struct dp *p, int k) {
    return (struct motion){
        .d = {p->now.delta[k], p->next.delta[k]},
        .v = {p->rate[0][k], p->rate[1][k]},
        .a = {state_pressing(&p->now, p->model, k), state_pressing(&p->next, p->model, k)},
        .h = p->h,
    };
}

// dp_step.c: a step by the stages of the method, as long as the tolerance allows.

// Room for what p->fastest and p->scales have of buildings; false: no memory.
bool dp_step_alloc(struct dp *p, struct arena *a);

// The first step, before there is any error.
void dp_step_start(struct dp *p);

// Takes the step from `now` of length h to time `end` into `next`.
void dp_step_take(struct dp *p, double h, double end);

// Penetrations of all links of state `s` and their rates.
void dp_step_gaps(const struct dp *p, struct state *s, double *rate);

// The next instant at which a step has to end.
double dp_step_limit(const struct dp *p);

// Is the step too short for peaks within it?
bool dp_step_is_instant(const struct dp *p);

// Tries steps until one meets the tolerance. STATUS_FAILED: they become too short or too many;
// names the time and the cause.
int dp_step_attempt(struct dp *p, struct error *e);

// The estimated error of the step, over the tolerance. dp_step_reject rejects the step for it: the
// next one is shorter. STATUS_FAILED: it cannot be.
double dp_step_error(const struct dp *p);
int dp_step_reject(struct dp *p, double error, struct error *e);

// dp_events.c: the first event in the step, into p->event; and the step again, which ends there.
void dp_events_first(struct dp *p);
void dp_events_locate(struct dp *p);

// Is it one of a storey? Else it is one of a link.
bool dp_events_is_of_storey(const struct dp_event *e);

// Ways of link k that mean nothing [L].
double dp_events_noise(const struct dp *p, int k);

// dp_peaks.c: largest values.

// Those of the step, within it and at its end, but for links.
void dp_peaks_step(struct dp *p);

// Those at `now` after a jump, for when it lasts or is shown: between events at one instant there
// are velocities and accelerations that nobody has for any time.
void dp_peaks_jump(struct dp *p);

// dp_account.c: works and impulses of steps, and the state within a step.

// Takes the step into the accounts of energy and of impacts, with the peaks of links.
void dp_account_step(struct dp *p);

// The state at time t of the step, and the account of energy up to it.
void dp_account_row(struct dp *p, double t, struct state *row, struct energy_account *energy);

#endif
