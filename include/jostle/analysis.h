// SPDX-License-Identifier: GPL-3.0-or-later
// Runs a model through time. The time loop is in src/solve/analysis.c.
#ifndef JOSTLE_ANALYSIS_H
#define JOSTLE_ANALYSIS_H

#include "jostle/model.h"
#include "jostle/names.h"

JOSTLE_C_BEGIN

// The state at the end of a step, as an observer sees it. Arrays are borrowed and valid during the
// call.
struct row_view {
    double time;                 // [T]
    const double *displacement;  // [L] (n_dof) relative to the ground
    const double *velocity;      // [L/T] (n_dof) relative to the ground
    const double *acceleration;  // [L/T^2] (n_dof) total
    const double *drift;         // [L] (n_dof)
    const double *storey_shear;  // [F] (n_dof)
    const double *force;         // [F] (n_link) contacts first
    const double *penetration;   // [L] (n_link)
    const double *ground;        // [L/T^2] (n_ground) ground acceleration
    const double *energy;        // [F L] (ENERGY_COUNT)
    const double *member_force;  // (model.n_force); NULL: FIELD_MEMBERS is not among the fields
};

// The energy account, relative to the ground: initial + input = kinetic + strain + damping +
// hysteretic + contact + residual, where initial is what kinetic, strain and contact are at t = 0.
enum energy {
    ENERGY_INPUT,       // work of the ground motion and the loads
    ENERGY_KINETIC,     // of the motion relative to the ground
    ENERGY_STRAIN,      // stored in the storeys
    ENERGY_DAMPING,     // work of the buildings' damping
    ENERGY_HYSTERETIC,  // dissipated by the storeys
    ENERGY_CONTACT,     // work done on contacts and bilateral links, stored or dissipated
    ENERGY_RESIDUAL,    // what the account misses
    ENERGY_COUNT
};
extern const char *const energy_names[];  // (ENERGY_COUNT)

// Called for row 0 (t = 0), every output.every-th step (adaptive: every model.dt) and the end. Not
// 0: the run ends with that status and the observer's error.
struct observer {
    // NULL: rows are not wanted.
    int (*row)(void *context, const struct row_view *row, struct error *e);
    // Called every few thousand steps, rows or not; NULL: nothing to ask. Not 0 ends the run.
    int (*poll)(void *context, double time, struct error *e);
    void *context;   // borrowed
    long steps_max;  // with so many steps a run has failed, when it is next polled; 0: no limit
};

// Largest absolute values over every computed step (dormand-prince: at any time), and when. Arrays
// (n_dof).
enum peak {
    PEAK_DISPLACEMENT,
    PEAK_VELOCITY,
    PEAK_ACCELERATION,
    PEAK_DRIFT,
    PEAK_SHEAR,
    PEAK_COUNT
};
extern const char *const peak_names[];  // (PEAK_COUNT) displacement velocity acceleration ...

// What a storey or a hinge that yields has gone through; 0 of others.
enum yield_quantity {
    YIELD_DUCTILITY,      // largest deformation over that at yield, of the direction with more
    YIELD_HYSTERETIC,     // [F L] energy that its law has dissipated
    YIELD_DETERIORATION,  // energy consumed over the least capacity of its law
    YIELD_DAMAGE,         // index of Park & Ang (storey_law_damage)
    YIELD_QUANTITIES
};
struct yield_demand {
    double value[YIELD_QUANTITIES];
};

// The largest and smallest value of a force in a struck column over all computed steps, and when.
struct column_peak {
    double max, max_time, min, min_time;
};

// Totals of one link over all steps. Of a contact, force and penetration are the largest (not
// absolute); of a bilateral link the largest absolute ones.
struct link_peak {
    double force, force_time;              // [F] [T]; 0 without contact
    double penetration, penetration_time;  // [L] [T] largest delta, negative if never closed
    double impulse;                        // [F T]
    double dissipated;                     // [F L] work done on the link
    long impacts;                          // of a contact
    double lost;      // [F L] of that, what a bilateral link does not give back at the end
    double residual;  // [L] deformation of a bilateral link that remains without a force
};

// One impact: a contact from closure to opening.
struct impact {
    int contact;  // index into model.link
    double t_start,
        t_end;          // [T] located within the step; t_end is the analysis' end if still closed
    double v_approach;  // [L/T] closing velocity at closure, >= 0
    double v_rebound;   // [L/T] opening velocity at t_end
    bool complete;      // it has opened; false: still closed at the end
    double peak_force;  // [F]
    double max_penetration;  // [L]
    double impulse;          // [F T]
    double dissipated;       // [F L]
    long steps;              // computed steps in contact
};

// Fewer computed steps do not resolve an impact; longer steps are rejected where that is foreseen.
enum { IMPACT_STEPS_MIN = 10 };

struct totals {
    long steps;  // computed, split ones included
    long
        rejected;  // attempts of steps that were not solved, or not to the tolerance; tried shorter
    long indefinite;  // of them, as their matrix was not positive definite: a stiffness is negative
    long events;  // steps split where a law that jumps closed or opened; adaptive: ended where a
                  // law changed its branch
    long iterations;  // Newton iterations: storeys and contacts
    long fast;        // contact solves settled by Newton sweeps, that take Newton steps
    long scalar;      // by further sweeps, of exact scalar answers
    long block;       // that took Newton steps on clusters of links
    long unsolved;    // accepted at the smallest step without meeting the tolerance
    long coarse;      // impacts under a force that opened within IMPACT_STEPS_MIN computed steps
    double seconds;   // wall time
};

// Where and when a run has ended because a storey has reached its limit of drift
// (struct model.collapse). The last row is of that instant.
struct collapse {
    bool happened;
    int dof;       // of the floor above the storey
    double time;   // [T]
    double drift;  // [L] with its sign
};

struct results {
    struct arena *arena;                        // owns the arrays
    double *peak[PEAK_COUNT];                   // (n_dof)
    double *peak_time[PEAK_COUNT];              // (n_dof) [T]
    double *founded_peak[2], *founded_time[2];  // (n_dof) largest deformations and shears of
                                                // storeys of buildings with a foundation, and when
    double *drift_rate;      // (n_dof) [L/T] largest at the rows that are observed
    double *residual_drift;  // (n_dof) [L] where the storeys have no shear after the end
    struct yield_demand *storey_demand;  // (n_dof)
    struct yield_demand *hinge_demand;   // (model.n_hinge)
    double *deepest;                     // (n_link) [L] largest penetration of each link so far,
    double *deepest_time;                // (n_link) [T] and when
    double *force_max, *force_max_time;  // (model.n_force) forces that follow from drifts, [T]
    double *force_min, *force_min_time;  // over every computed step, signed
    struct link_peak *link;              // (n_link) contacts first
    struct column_peak (*column)[COLUMN_FORCE_COUNT];  // (n_column)
    struct impact *impact;                             // (n_impact) in order of t_start; malloc'd
    long n_impact, impact_capacity;
    struct collapse collapse;
    double energy[ENERGY_COUNT];  // at the end
    double initial_energy;        // kinetic, strain and contact energy at t = 0 [F L]
    double residual_peak;         // largest |residual| at the rows of output [F L]
    struct totals totals;
};

// Runs the model from t = 0 to its duration, or to its collapse. GSL must not abort on its own
// errors: call gsl_set_error_handler_off() before. Errors: STATUS_FAILED (a state that is not
// finite; names the floor and the time; a contact that needs too many steps), STATUS_SYSTEM (no
// memory), or what the observer returned.
int analysis_run(const struct model *m, const struct observer *observer, struct results **out,
                 struct error *e);
void results_free(struct results *r);  // NULL is allowed

// Whether the impact is one of totals.coarse.
bool impacts_is_coarse(const struct model *m, const struct impact *i);

JOSTLE_C_END

#endif
