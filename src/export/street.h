// SPDX-License-Identifier: GPL-3.0-or-later
// A row of buildings from a table (docs/street.md), written as a deck. Values are in SI.
#ifndef JOSTLE_EXPORT_STREET_H
#define JOSTLE_EXPORT_STREET_H

#include <stdbool.h>
#include <stdio.h>

#include "jostle/error.h"

struct arena;

// Seismic design levels of HAZUS.
enum street_code { STREET_HIGH, STREET_MODERATE, STREET_LOW, STREET_PRE, STREET_CODES };
extern const char *const street_code_names[STREET_CODES];

// A model building type of HAZUS in one class of height, with its typical building.
struct street_type {
    const char *name;
    int least, most;                 // storeys of its class of height
    int storeys;                     // of the typical building
    double period;                   // [s] of the typical building
    double height;                   // [m] of a storey
    double overstrength;             // lambda: ultimate over yield strength
    double strength[STREET_CODES];   // [g] spectral acceleration at yield
    double ductility[STREET_CODES];  // mu: ultimate drift over lambda times yield drift
};
extern const struct street_type street_types[];
extern const int n_street_type;

// The type called `name`, or `name` with the letter of the class that has so many storeys: C1 is
// C1M with 5. NULL: there is none.
const struct street_type *street_type_find(const char *name, int storeys);

// Ratio of the stiffness after yield to that before.
double street_type_hardening(const struct street_type *t, enum street_code code);

// The design level of a building of that year in a zone of the Uniform Building Code.
enum street_zone { ZONE_0, ZONE_1, ZONE_2A, ZONE_2B, ZONE_3, ZONE_4, STREET_ZONES };
enum street_code street_code_of(enum street_zone zone, double year, bool light_wood);

struct street_building {
    const char *name;
    const struct street_type *type;  // NULL: none is given
    enum street_code code;           // of the type
    int storeys;
    double height;     // [m] of a storey
    double mass;       // [kg] of a floor
    double period;     // [s] of the first mode
    double stiffness;  // [N/m] of storey 1
    const char *law;   // of the storeys
    double yield;      // base shear at yield over weight; NAN: it stays elastic
    double hardening;  // ratio
    double damping;    // ratio
    bool joined;       // a contact with the next building
    double gap;        // [m] to the next building
    double k;          // [N/m] of a contact with it
    double e;          // restitution
};

struct street {
    const char *path;                  // of the table; borrowed
    struct street_building *building;  // (n) from left to right
    int n;
};

// Reads the table into the arena, and fills what it does not give. Messages about the table go into
// `d`. Errors: STATUS_INPUT (not a text file; the messages have errors), STATUS_SYSTEM.
int street_read(struct arena *a, const char *path, enum street_zone zone, struct street *out,
                struct diagnostics *d, struct error *e);

// What stands below the buildings.
struct street_motion {
    const char *record;  // path; NULL: no ground motion, steps or output
    double pga;          // [m/s^2]; NAN: as the record has it
};

// Writes the deck. Write errors are the caller's.
void street_write(const struct street *s, const struct street_motion *m, FILE *to);

// Of the first mode of the building, whose displacements grow in a straight line with the floors:
// the stiffness of storey i (from 0) over that of storey 1, and the effective mass over all mass.
double street_storey_share(int storeys, int i);
double street_effective_mass(int storeys);

#endif
