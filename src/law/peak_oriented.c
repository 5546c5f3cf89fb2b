// SPDX-License-Identifier: GPL-3.0-or-later
// The history of a storey is the point of the last unloading and the largest drift to each side.
// From this point the unloading line leads to zero shear, where the other side begins. The history
// does not change before the first yield, nor while the storey moves on the unloading line.
#include "law/peak_oriented.h"

#include <assert.h>
#include <math.h>
#include <stdbool.h>
#include <string.h>

// TURN_*: point of the last unloading. RIGHT, LEFT: largest drift minus the yield drift.
// SOFTENING_*: 1 - unloading stiffness / initial stiffness. The softening follows from the largest
// drift. It is stored because pow is slow.
enum { TURN_DRIFT, TURN_SHEAR, RIGHT, LEFT, SOFTENING_RIGHT, SOFTENING_LEFT };
static_assert(SOFTENING_LEFT + 1 == PEAK_ORIENTED_HISTORY, "every value of the history has a name");

void peak_oriented_prepare(const double value[PEAK_ORIENTED_CONSTANTS], double *constant) {
    memcpy(constant, value, PEAK_ORIENTED_CONSTANTS * sizeof *constant);
    if (isnan(value[PEAK_ORIENTED_YIELD_LEFT])) {
        constant[PEAK_ORIENTED_YIELD_LEFT] = value[PEAK_ORIENTED_YIELD];
    }
    constant[PEAK_ORIENTED_YIELD_DRIFT] =
        value[PEAK_ORIENTED_YIELD] / value[PEAK_ORIENTED_STIFFNESS];
    constant[PEAK_ORIENTED_YIELD_DRIFT_LEFT] =
        constant[PEAK_ORIENTED_YIELD_LEFT] / value[PEAK_ORIENTED_STIFFNESS];
}

// The side to which a storey moves, with drifts and shears counted positive that way.
struct side {
    const double *constant;
    double sign;
    bool right;
    double yield, yield_drift;
    double beyond;                  // largest drift minus yield drift
    double unloading;               // unloading stiffness
    double turn_drift, turn_shear;  // point of the last unloading
};

static inline struct side peak_oriented_side(const double *c, const double *h, bool right) {
    const double sign = right ? 1.0 : -1.0;
    return (struct side){
        .constant = c,
        .sign = sign,
        .right = right,
        .yield = c[right ? PEAK_ORIENTED_YIELD : PEAK_ORIENTED_YIELD_LEFT],
        .yield_drift = c[right ? PEAK_ORIENTED_YIELD_DRIFT : PEAK_ORIENTED_YIELD_DRIFT_LEFT],
        .beyond = h[right ? RIGHT : LEFT],
        .unloading =
            c[PEAK_ORIENTED_STIFFNESS] * (1.0 - h[right ? SOFTENING_RIGHT : SOFTENING_LEFT]),
        .turn_drift = sign * h[TURN_DRIFT],
        .turn_shear = sign * h[TURN_SHEAR],
    };
}

// Unloading must not cross the origin: otherwise reloading would start beyond its target.
static double peak_oriented_softening(const struct side *s, double largest) {
    const double alpha = s->constant[PEAK_ORIENTED_ALPHA];
    if (alpha == 0.0) {
        return 0.0;
    }
    const double share = s->yield_drift / largest;
    const double to_origin = share + s->constant[PEAK_ORIENTED_HARDENING] * (1.0 - share);
    return 1.0 - fmax(pow(share, alpha), to_origin);
}

static inline struct storey_response peak_oriented_backbone(const struct side *s, double drift) {
    const double k = s->constant[PEAK_ORIENTED_STIFFNESS];
    const double beyond = drift - s->yield_drift;
    if (beyond < 0.0) {
        return (struct storey_response){k * drift, k};
    }
    const double hardening = s->constant[PEAK_ORIENTED_HARDENING] * k;
    const double shear = s->yield + hardening * beyond;
    return shear > 0.0 ? (struct storey_response){shear, hardening} : (struct storey_response){0};
}

// From the point of unloading on a straight line to the target, then along the backbone.
static struct storey_response peak_oriented_reload(const struct side *s, double drift) {
    const double share = 1.0 - s->constant[PEAK_ORIENTED_BETA];
    const double target = s->yield_drift + share * s->beyond;
    const double rise = peak_oriented_backbone(s, target).shear - s->turn_shear;
    const double way = target - s->turn_drift;
    const struct storey_response r = peak_oriented_backbone(s, drift);
    double stiffness = s->unloading;
    if (rise < stiffness * way) {
        if (drift >= target) {
            return r;
        }
        stiffness = rise / way;
    }
    double line = s->turn_shear + stiffness * (drift - s->turn_drift);
    return line < r.shear || drift < target ? (struct storey_response){line, stiffness} : r;
}

// Stores the end of a path that has reloaded as the point of the last unloading.
static void peak_oriented_arrive(const struct side *s, double drift, double shear, double *h) {
    const double beyond = drift - s->yield_drift;
    h[TURN_DRIFT] = s->sign * drift;
    h[TURN_SHEAR] = s->sign * shear;
    if (beyond > s->beyond) {
        h[s->right ? RIGHT : LEFT] = beyond;
        h[s->right ? SOFTENING_RIGHT : SOFTENING_LEFT] = peak_oriented_softening(s, drift);
    }
}

struct storey_response peak_oriented_respond(const double *c, const double *h, double drift,
                                             double *after) {
    if (after && after != h) {
        memcpy(after, h, PEAK_ORIENTED_HISTORY * sizeof *after);
    }
    if (h[RIGHT] + h[LEFT] == 0.0 && drift <= c[PEAK_ORIENTED_YIELD_DRIFT] &&
        -drift <= c[PEAK_ORIENTED_YIELD_DRIFT_LEFT]) {
        return (struct storey_response){c[PEAK_ORIENTED_STIFFNESS] * drift,
                                        c[PEAK_ORIENTED_STIFFNESS]};
    }
    const bool to_right = drift >= h[TURN_DRIFT];
    struct side s =
        peak_oriented_side(c, h, h[TURN_SHEAR] > 0.0 || (h[TURN_SHEAR] == 0.0 && to_right));
    if (s.right != to_right) {
        const double line = s.turn_shear + s.unloading * (s.sign * drift - s.turn_drift);
        if (line > 0.0) {
            return (struct storey_response){s.sign * line, s.unloading};
        }
        const double zero = s.sign * (s.turn_drift - s.turn_shear / s.unloading);
        s = peak_oriented_side(c, h, !s.right);
        // The line has crossed zero before the drift, whatever the rounding of `zero`: a shear of
        // the other side here would let a link that hangs loose forget where it has unloaded.
        s.turn_drift = fmin(s.sign * zero, s.sign * drift);
        s.turn_shear = 0.0;
    }
    struct storey_response r = peak_oriented_reload(&s, s.sign * drift);
    if (after) {
        peak_oriented_arrive(&s, s.sign * drift, r.shear, after);
    }
    r.shear *= s.sign;
    return r;
}

double peak_oriented_stored(const double *c, const double *h, double drift) {
    const double shear = peak_oriented_respond(c, h, drift, NULL).shear;
    return shear * shear / (2.0 * peak_oriented_side(c, h, shear > 0.0).unloading);
}

void peak_oriented_describe(const double *c, struct storey_figures *out) {
    out->yield[0] = c[PEAK_ORIENTED_YIELD_DRIFT];
    out->yield[1] = c[PEAK_ORIENTED_YIELD_DRIFT_LEFT];
    out->strength[0] = c[PEAK_ORIENTED_YIELD];
    out->strength[1] = c[PEAK_ORIENTED_YIELD_LEFT];
}
