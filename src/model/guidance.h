// SPDX-License-Identifier: GPL-3.0-or-later
// Estimates before an analysis: the required step (from the durations of the contacts, the shortest
// period and the sampling of the excitation), the velocities of floors, and the forces of dashpots.
#ifndef JOSTLE_GUIDANCE_H
#define JOSTLE_GUIDANCE_H

#include "jostle/model.h"

// Largest number of contacts that are estimated, in the order of the deck. Each takes about 0.1 ms.
enum { GUIDANCE_CONTACTS_MAX = 256 };

// Required number of steps: in a contact; in the shortest period or in a period of a sine.
enum { GUIDANCE_CONTACT_STEPS = 50, GUIDANCE_PERIOD_STEPS = 20 };

// One contact.
struct guidance_contact {
    double velocity;  // [L/T] likely largest closing velocity; 0: nothing moves the floors
    double duration;  // [T] of an isolated impact with it; 0: rigid; NAN: the bodies do not part
    double storeys;   // stiffness divided by that of the stiffest storey beside it; NAN: one of
                      // them is unknown, or the contact is a bumper
};

struct guidance {
    int n_contact;
    const struct guidance_contact *contact;  // (n_contact) the first ones of the model
    int shortest;     // index of the shortest contact; -1: no contact has a duration
    double period;    // [T] lower bound of all periods; infinite: no period is finite
    double sampling;  // [T] shortest sampling of a record; infinite: there is no record
    double sine;      // [T] period of the fastest sine; infinite: there is no sine
    double bound;     // [T] longest step that resolves all of these; infinite: no limit
    double step;      // [T] the largest round step not above `bound`
};

// Arrays are from the arena of the model's deck. Errors: STATUS_SYSTEM (no memory).
int guidance_find(const struct model *m, struct guidance *out, struct error *e);

// Warns in the diagnostics of the model's deck about estimated contacts with fewer than ten steps,
// about contacts that are stiffer or softer than real ones, and about contacts that never end.
void guidance_warn(const struct model *m, const struct guidance *g);

// Warns about contacts that are less than ten times as stiff as the stiffest storey beside them,
// once for each statement. `contact` (n_contact) are the first contacts of the model. `where`
// returns the place of contact k in a study, such as " in run 7 (gap = 0.02)"; NULL: there is one
// run.
typedef const char *guidance_where(void *context, int k);
void guidance_warn_storeys(const struct model *m, int n_contact,
                           const struct guidance_contact *contact, guidance_where *where,
                           void *context);

// The largest of 1, 2 and 5 times a power of ten that is not above `step` > 0.
double guidance_round(double step);

// Estimates the largest velocities of the floors of building `i`, relative to its ground, and the
// largest drift rates of its storeys. The building is alone and elastic. `velocity` and
// `drift_rate` are (n_dof) [L/T]. Errors: STATUS_SYSTEM (no memory).
int floor_velocity(const struct model *m, int i, double *velocity, double *drift_rate,
                   struct error *e);

// Size of a warning about the Rayleigh damping of storeys that yield.
enum { DAMPING_TEXT_SIZE = 512 };

// Writes the warning about the dashpots of Rayleigh damping in building `g`, whose storeys have the
// largest drift rates `rate` (n_dof) [L/T]. `known` is "estimated " for estimated rates, else "".
// Returns the force of the dashpots divided by the yield force; 0: too small for a warning.
double damping_warning(const struct model *m, const struct building *g, const double *rate,
                       const char *known, char text[DAMPING_TEXT_SIZE]);

// The warning about the building whose dashpots have the largest share of the yield force.
struct damping_finding {
    double share;  // 0: none
    int building;
    char text[DAMPING_TEXT_SIZE];
};

// Finds this building, with the drift rates of floor_velocity. If `warns`, also warns about each
// building in the diagnostics of the model's deck. Errors: STATUS_SYSTEM (no memory).
int damping_find(const struct model *m, bool warns, struct damping_finding *most, struct error *e);

#endif
