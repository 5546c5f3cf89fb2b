// SPDX-License-Identifier: GPL-3.0-or-later
// One isolated impact of two free bodies under a contact law, without buildings, integrated to
// rounding error. It shows the restitution, force and duration of a law. The solver does not use
// it.
#ifndef JOSTLE_ISOLATED_H
#define JOSTLE_ISOLATED_H

#include "jostle/contact_law.h"

struct isolated_impact {
    double restitution;      // opening velocity divided by closing velocity
    double peak_force;       // [F] largest force; NAN for a law without a force
    double duration;         // [T] from closure until d = 0 again
    double max_penetration;  // [L]
    double impulse;          // [F T]
    double dissipated;       // [F L]
};

// One instant of an impact.
struct isolated_point {
    double time, penetration, velocity, force;  // since closure
    double rate;  // [F/T] rate of the force; may be infinite at closure
};

// Callbacks. `point` gets every accepted step of the integration from closure to opening. It gets
// each instant of a jump of the force twice. `sample`, if `n_time` > 0, gets the state at each
// time[i] within the contact.
struct isolated_observer {
    void (*point)(void *context, const struct isolated_point *p);
    void *context;
    void (*sample)(void *context, int i, const struct isolated_point *p);
    const double *time;  // (n_time) since closure, > 0, ascending
    int n_time;
};

// Integrates m d'' = -F(d, d') from d = 0, d' = velocity > 0 until d = 0 again, with m >= 0 the
// effective mass, which is 0 for the smallest masses of bodies. The law's history changes as in an
// analysis (close, commit). `observer` may be NULL. Errors: STATUS_FAILED (the bodies do not
// separate, or a value is not finite), STATUS_SYSTEM (no memory).
int isolated_run(const struct contact_law *law, const double *constant, double mass,
                 double velocity, const struct isolated_observer *observer,
                 struct isolated_impact *out, struct error *e);

// Computes only the duration, to about six digits, several times as fast. NAN after an error; 0 for
// a law without a force.
int isolated_duration(const struct contact_law *law, const double *constant, double mass,
                      double velocity, double *out, struct error *e);

#endif
