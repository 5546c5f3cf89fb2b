// SPDX-License-Identifier: GPL-3.0-or-later
// One isolated impact of two free bodies under a contact law, integrated to rounding: what a law
// and its constants deliver, apart from any building. The solver does not use it.
#ifndef JOSTLE_ISOLATED_H
#define JOSTLE_ISOLATED_H

#include "jostle/contact_law.h"

struct isolated_impact {
    double restitution;      // opening over closing velocity
    double peak_force;       // [F] largest; NAN under a law without a force
    double duration;         // [T] from closure until d = 0 again
    double max_penetration;  // [L]
    double impulse;          // [F T]
    double dissipated;       // [F L]
};

// One instant of an impact.
struct isolated_point {
    double time, penetration, velocity, force;  // since closure
    double rate;                                // [F/T] of the force; may be infinite at closure
};

// Who looks on. `point` is shown every accepted step of the integration, from closure to opening,
// and twice an instant at which the force jumps in between;
// `sample`, where `n_time` > 0, the state at time[i], for all that lie within the contact.
struct isolated_observer {
    void (*point)(void *context, const struct isolated_point *p);
    void *context;
    void (*sample)(void *context, int i, const struct isolated_point *p);
    const double *time;  // (n_time) since closure, > 0, ascending
    int n_time;
};

// Integrates m d'' = -F(d, d') from d = 0, d' = velocity > 0 until d = 0 again, with m the
// effective mass and the law's history kept as in an analysis (close, commit). `observer` NULL:
// nobody looks. Errors:
// STATUS_FAILED (the bodies do not part, or not finite), STATUS_SYSTEM (no memory).
int isolated_run(const struct contact_law *law, const double *constant, double mass,
                 double velocity, const struct isolated_observer *observer,
                 struct isolated_impact *out, struct error *e);

// The duration of the impact alone, to about six digits and several times as fast. NAN after an
// error; 0 under a law without a force.
int isolated_duration(const struct contact_law *law, const double *constant, double mass,
                      double velocity, double *out, struct error *e);

#endif
