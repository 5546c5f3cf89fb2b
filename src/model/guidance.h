// SPDX-License-Identifier: GPL-3.0-or-later
// The step that a model asks for, estimated before it is run: from the durations of its contacts,
// its shortest period and the sampling of its excitation.
#ifndef JOSTLE_GUIDANCE_H
#define JOSTLE_GUIDANCE_H

#include <stddef.h>

#include "jostle/model.h"

// Only so many contacts are estimated, in the order of the deck; each takes some 0.1 ms.
enum { GUIDANCE_CONTACTS_MAX = 256 };

// Steps wanted: in a contact, in the shortest period, in a period of a sine.
enum { GUIDANCE_CONTACT_STEPS = 50, GUIDANCE_PERIOD_STEPS = 20 };

// One contact.
struct guidance_contact {
    double velocity;  // [L/T] likely largest closing velocity; 0: nothing moves the floors
    double duration;  // [T] of an isolated impact with it; 0: rigid; NAN: the bodies do not part
    double storeys;   // stiffness over that of the stiffest storey beside; NAN: not both known,
                      // or the contact is a bumper
};

struct guidance {
    int n_contact;
    const struct guidance_contact *contact;  // (n_contact) the first ones of the model
    int shortest;     // index of the contact that is over first; -1: none has a duration
    double period;    // [T] no longer than any of the model; infinite: none is finite
    double sampling;  // [T] of the samples; infinite: there are none
    double sine;      // [T] period of the fastest sine; infinite: there are none
    double bound;     // [T] longest step that resolves all of them; infinite: nothing asks for one
    double step;      // [T] the round fixed step that is not above it
};

// Arrays are from the arena of the model's deck. Errors: STATUS_SYSTEM (no memory).
int guidance_find(const struct model *m, struct guidance *out, struct error *e);

// Warns in the diagnostics of the model's deck of estimated contacts that its step covers by less
// than ten steps, that are harder or softer than any, or that never end.
void guidance_warn(const struct model *m, const struct guidance *g);

// Warns of contacts that are less than ten times as stiff as the stiffest storey beside them, once
// for each statement. `contact` (n_contact) are the first contacts of the model. `where` returns
// the place of contact k in a study, such as " in run 7 (gap = 0.02)"; NULL: there is one run.
typedef const char *guidance_where(void *context, int k);
void guidance_warn_storeys(const struct model *m, int n_contact,
                           const struct guidance_contact *contact, guidance_where *where,
                           void *context);

// The largest of 1, 2 and 5 times a power of ten that is not above `step` > 0.
double guidance_round(double step);

// How fast floors are likely to move, estimated before an analysis.

// The likely largest velocity of the floors of building `i`, relative to its ground, alone and
// elastic, and that of the drifts of its storeys. `velocity` and `drift_rate` are (n_floor) [L/T].
// Errors: STATUS_SYSTEM (no memory).
int floor_velocity(const struct model *m, int i, double *velocity, double *drift_rate,
                   struct error *e);

// Rayleigh damping of storeys that yield.

enum { DAMPING_TEXT_SIZE = 512 };

// The warning about the dashpots of Rayleigh's alpha M + beta K in building `g`, whose storeys have
// the largest drift rates `rate` (n_floor) [L/T]; `known` says how the rates are known ("estimated
// ", or ""). Returns their force over the yield force, 0 where it is too small to warn about.
double damping_warning(const struct model *m, const struct building *g, const double *rate,
                       const char *known, char text[DAMPING_TEXT_SIZE]);

// The warning about the building whose dashpots carry most.
struct damping_finding {
    double share;  // 0: none
    int building;
    char text[DAMPING_TEXT_SIZE];
};

// Warns in the diagnostics of the model's deck, at rates estimated by floor_velocity, if
// `warns`. Errors: STATUS_SYSTEM (no memory).
int damping_find(const struct model *m, bool warns, struct damping_finding *most, struct error *e);

#endif
