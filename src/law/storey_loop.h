// SPDX-License-Identifier: GPL-3.0-or-later
// The response of one storey, hinge or link to a path of deformations, without a building. Its
// deformation is the drift of a storey, or the lengthening of a link; its force is positive with
// it.
#ifndef JOSTLE_STOREY_LOOP_H
#define JOSTLE_STOREY_LOOP_H

#include <stddef.h>

#include "law/link_law.h"

enum {
    LOOP_ROWS_MAX = STOREY_ROWS_MAX + LINK_ROWS,
    LOOP_CONSTANTS_MAX = STOREY_CONSTANTS_MAX + 8,
    LOOP_HISTORY_MAX = STOREY_HISTORY_MAX + 8
};

struct loop_law {
    const char *name;
    int n_row;
    struct row row[LOOP_ROWS_MAX];    // without the initial stiffness
    const struct storey_law *storey;  // the law, or what that of a link is made of; NULL: none
    struct link_law link;             // NULL name: it is none of a link
    struct contact_law contact;       // that of a link
    int place[LOOP_ROWS_MAX];         // of its rows among all rows of the link
    bool straight;                    // it is of straight lines
    bool rated;                       // the force depends on the velocity
};

void storey_loop_of_storey(const struct storey_law *from, struct loop_law *out);
void storey_loop_of_link(const struct link_law *from, struct loop_law *out);

// Computes the constants from the values of the rows (NAN: not given) and the initial stiffness
// (NAN: 0, for a law that does not need one).
int storey_loop_prepare(const struct loop_law *law, const double *value, double stiffness,
                        double *constant, struct error *e);

struct storey_point {
    double drift, shear, tangent;  // [L] [F] [F/L]
    double work;                   // on the storey [F L]
    double dissipated;             // work less what is stored [F L]
    double plastic;                // drift less shear over initial stiffness [L]
};

// A virgin storey and the path that it follows from drift 0.
struct storey_path {
    const struct loop_law *law;
    const double *constant;
    double stiffness;      // initial; NAN: none
    double period;         // [T] of a cycle: from target to target in half of it, by half a wave of
                           // a cosine; 0: slowly, at rate 0
    const double *target;  // (n_target) drifts
    size_t n_target;
    int n_part;  // points from one target to the next
    int n_step;  // steps from one point to the next
};

// Sets point (n_target n_part + 1), the first of them at drift 0. Work is the sum of trapezoids
// over the steps.
void storey_loop_run(const struct storey_path *path, struct storey_point *point);

// Shears (n_target) at the targets, reached in one step each at rate 0.
void storey_loop_shears(const struct storey_path *path, double *shear);

// Cyclic protocols of tests: steps of rising amplitude, each of some full cycles.
enum { PROTOCOL_STEPS_MAX = 12, PROTOCOL_TARGETS_MAX = 128 };

struct protocol {
    const char *name, *source;
    int n;
    double amplitude[PROTOCOL_STEPS_MAX];  // (n) over the largest
    int cycles[PROTOCOL_STEPS_MAX];
};

extern const struct protocol storey_loop_protocols[];
extern const int n_storey_loop_protocol;

// Sets the targets of a protocol with the largest amplitude `amplitude`, the last of them 0.
// Returns how many.
int storey_loop_targets(const struct protocol *p, double amplitude,
                        double target[PROTOCOL_TARGETS_MAX]);

#endif
