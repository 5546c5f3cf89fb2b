// SPDX-License-Identifier: GPL-3.0-or-later
// A storey is remembered by the point from which it was last unloaded, and by the largest drift
// either way. From that point the unloading line leads down to zero shear, where the other side
// begins. As long as a storey moves on that line, up or down, nothing has to be remembered; nor
// before its first yielding.
#include "law/peak_oriented.h"

#include <assert.h>
#include <math.h>
#include <stdbool.h>
#include <string.h>

// The point of the last unloading; of either side the part of the largest drift that is beyond
// yield, and by which share its unloading stiffness is below the initial one. That share follows
// from the largest drift; it is kept because a power is slow to compute.
enum { TURN_DRIFT, TURN_SHEAR, RIGHT, LEFT, SOFTENING_RIGHT, SOFTENING_LEFT };
static_assert(SOFTENING_LEFT + 1 == PEAK_ORIENTED_HISTORY, "every value of the history has a name");

int peak_oriented_prepare(const double value[PEAK_ORIENTED_CONSTANTS], double *constant,
                          struct error *e) {
    if (value[PEAK_ORIENTED_STIFFNESS] == 0.0) {
        return error_set(e, STATUS_INPUT, "a storey of stiffness 0 cannot yield");
    }
    memcpy(constant, value, PEAK_ORIENTED_CONSTANTS * sizeof *constant);
    constant[PEAK_ORIENTED_YIELD_DRIFT] =
        value[PEAK_ORIENTED_YIELD] / value[PEAK_ORIENTED_STIFFNESS];
    return STATUS_OK;
}

// At zero shear the drift is not on the other side of zero: else reloading would have to start
// beyond its target.
static double peak_oriented_softening(const double *c, double largest) {
    double alpha = c[PEAK_ORIENTED_ALPHA];
    if (alpha == 0.0) {
        return 0.0;
    }
    double share = c[PEAK_ORIENTED_YIELD_DRIFT] / largest;
    double to_origin = share + c[PEAK_ORIENTED_HARDENING] * (1.0 - share);
    return 1.0 - fmax(pow(share, alpha), to_origin);
}

static struct storey_response peak_oriented_backbone(const double *c, double drift) {
    double k = c[PEAK_ORIENTED_STIFFNESS];
    double beyond = drift - c[PEAK_ORIENTED_YIELD_DRIFT];
    if (beyond < 0.0) {
        return (struct storey_response){k * drift, k};
    }
    double hardening = c[PEAK_ORIENTED_HARDENING] * k;
    return (struct storey_response){c[PEAK_ORIENTED_YIELD] + hardening * beyond, hardening};
}

// The side to which a storey moves, with drifts and shears counted positive that way.
struct side {
    const double *constant;
    double sign;
    bool right;
    double beyond;                  // yield, of the largest drift
    double unloading;               // stiffness
    double turn_drift, turn_shear;  // where it was last unloaded
};

static struct side peak_oriented_side(const double *c, const double *h, bool right) {
    const double sign = right ? 1.0 : -1.0;
    return (struct side){
        .constant = c,
        .sign = sign,
        .right = right,
        .beyond = h[right ? RIGHT : LEFT],
        .unloading =
            c[PEAK_ORIENTED_STIFFNESS] * (1.0 - h[right ? SOFTENING_RIGHT : SOFTENING_LEFT]),
        .turn_drift = sign * h[TURN_DRIFT],
        .turn_shear = sign * h[TURN_SHEAR],
    };
}

// From the turning point straight to the target, and along the backbone.
static struct storey_response peak_oriented_reload(const struct side *s, double drift) {
    const double *c = s->constant;
    const double target = c[PEAK_ORIENTED_YIELD_DRIFT] + (1.0 - c[PEAK_ORIENTED_BETA]) * s->beyond;
    const double rise = peak_oriented_backbone(c, target).shear - s->turn_shear;
    const double way = target - s->turn_drift;
    const struct storey_response r = peak_oriented_backbone(c, drift);
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

// Makes the end of a path that has reloaded the turning point.
static void peak_oriented_arrive(const struct side *s, double drift, double shear, double *h) {
    const double beyond = drift - s->constant[PEAK_ORIENTED_YIELD_DRIFT];
    h[TURN_DRIFT] = s->sign * drift;
    h[TURN_SHEAR] = s->sign * shear;
    if (beyond > s->beyond) {
        h[s->right ? RIGHT : LEFT] = beyond;
        h[s->right ? SOFTENING_RIGHT : SOFTENING_LEFT] =
            peak_oriented_softening(s->constant, drift);
    }
}

struct storey_response peak_oriented_respond(const double *c, const double *h, double drift,
                                             double *after) {
    if (after && after != h) {
        memcpy(after, h, PEAK_ORIENTED_HISTORY * sizeof *after);
    }
    if (h[RIGHT] + h[LEFT] == 0.0 && fabs(drift) <= c[PEAK_ORIENTED_YIELD_DRIFT]) {
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
        s.turn_drift = s.sign * zero;
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
