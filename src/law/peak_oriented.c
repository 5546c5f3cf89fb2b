// SPDX-License-Identifier: GPL-3.0-or-later
// A path is told from the committed point on in the direction of the drift, with drifts and shears
// counted positive that way. It unloads the other side down to zero shear if it must, goes up to
// the point where this side was last unloaded, from there straight to its target, and along the
// backbone.
#include "law/peak_oriented.h"

#include <assert.h>
#include <math.h>
#include <stdbool.h>
#include <string.h>

// The committed drift and shear, the beyond-yield part of the largest drift either way, the point
// from which the present side was last unloaded, and the softening of the unloading stiffness
// either way. The softening follows from the largest drift; it is kept because a power is slow to
// compute.
enum { DRIFT, SHEAR, RIGHT, LEFT, TURN_DRIFT, TURN_SHEAR, SOFTENING_RIGHT, SOFTENING_LEFT };
static_assert(SOFTENING_LEFT + 1 == PEAK_ORIENTED_HISTORY, "every value of the history has a name");

struct point {
    double drift, shear;
};

struct path {
    const double *constant;
    double sign;       // of the direction
    struct point now;  // where it starts
    struct point turn;
    double largest;       // drift of this side
    double unloading[2];  // stiffness of unloading from this side, and from the other
};

int peak_oriented_prepare(const double value[PEAK_ORIENTED_CONSTANTS], double *constant,
                          struct error *e) {
    if (value[PEAK_ORIENTED_STIFFNESS] == 0.0) {
        return error_set(e, STATUS_INPUT, "a storey of stiffness 0 cannot yield");
    }
    memcpy(constant, value, PEAK_ORIENTED_CONSTANTS * sizeof *constant);
    return STATUS_OK;
}

static double yield_drift(const double *c) {
    return c[PEAK_ORIENTED_YIELD] / c[PEAK_ORIENTED_STIFFNESS];
}

// By which share the stiffness of unloading is below the initial one. At zero shear the drift is
// not on the other side of zero: else reloading would have to start beyond its target.
static double softening(const double *c, double largest) {
    double alpha = c[PEAK_ORIENTED_ALPHA];
    if (alpha == 0.0) {
        return 0.0;
    }
    double share = yield_drift(c) / largest;
    double to_origin = share + c[PEAK_ORIENTED_HARDENING] * (1.0 - share);
    return 1.0 - fmax(pow(share, alpha), to_origin);
}

static double unloading_stiffness(const double *c, double softened) {
    return c[PEAK_ORIENTED_STIFFNESS] * (1.0 - softened);
}

static struct storey_response backbone(const double *c, double drift) {
    double k = c[PEAK_ORIENTED_STIFFNESS];
    double beyond = drift - yield_drift(c);
    if (beyond < 0.0) {
        return (struct storey_response){k * drift, k};
    }
    double hardening = c[PEAK_ORIENTED_HARDENING] * k;
    return (struct storey_response){c[PEAK_ORIENTED_YIELD] + hardening * beyond, hardening};
}

// From the turning point on.
static struct storey_response reload(const struct path *p, double drift) {
    const double *c = p->constant;
    double target = p->largest - c[PEAK_ORIENTED_BETA] * (p->largest - yield_drift(c));
    double stiffness = p->unloading[0];
    double rise = backbone(c, target).shear - p->turn.shear;
    struct storey_response r = backbone(c, drift);
    if (rise < stiffness * (target - p->turn.drift)) {
        if (drift >= target) {
            return r;
        }
        stiffness = rise / (target - p->turn.drift);
    }
    double line = p->turn.shear + stiffness * (drift - p->turn.drift);
    return line < r.shear || drift < target ? (struct storey_response){line, stiffness} : r;
}

static struct path path_to(const double *c, const double *h, double drift) {
    double sign = drift >= h[DRIFT] ? 1.0 : -1.0;
    const bool right = sign > 0.0;
    const double to_right = unloading_stiffness(c, h[SOFTENING_RIGHT]);
    const double to_left = unloading_stiffness(c, h[SOFTENING_LEFT]);
    return (struct path){
        .constant = c,
        .sign = sign,
        .now = {sign * h[DRIFT], sign * h[SHEAR]},
        .turn = {sign * h[TURN_DRIFT], sign * h[TURN_SHEAR]},
        .largest = yield_drift(c) + h[right ? RIGHT : LEFT],
        .unloading = {right ? to_right : to_left, right ? to_left : to_right},
    };
}

// Where along the path `drift` lies. Unloading to zero shear moves the turning point there.
enum stage { STAGE_UNLOAD, STAGE_RETURN, STAGE_RELOAD };
static enum stage stage_of(struct path *p, double drift) {
    if (p->now.shear < 0.0) {
        double zero = p->now.drift - p->now.shear / p->unloading[1];
        if (drift <= zero) {
            return STAGE_UNLOAD;
        }
        p->turn = (struct point){zero, 0.0};
    }
    return drift < p->turn.drift ? STAGE_RETURN : STAGE_RELOAD;
}

static struct storey_response response(struct path *p, enum stage stage, double drift) {
    if (stage == STAGE_RELOAD) {
        return reload(p, drift);
    }
    double stiffness = p->unloading[stage == STAGE_UNLOAD];
    return (struct storey_response){p->now.shear + stiffness * (drift - p->now.drift), stiffness};
}

// Takes `drift`, counted positive to its side, as the largest one of this side if it is.
static void grow(const double *constant, double *history, bool right, double drift) {
    double *beyond = &history[right ? RIGHT : LEFT];
    if (drift - yield_drift(constant) > *beyond) {
        *beyond = drift - yield_drift(constant);
        history[right ? SOFTENING_RIGHT : SOFTENING_LEFT] = softening(constant, drift);
    }
}

// Brings a history to `drift`, whose shear is given.
static void arrive(const struct path *p, enum stage stage, double drift, double shear,
                   double *history) {
    const bool to_zero = stage == STAGE_UNLOAD && p->sign * shear >= 0.0;  // it would reload there
    history[DRIFT] = drift;
    history[SHEAR] = shear;
    if (stage == STAGE_RELOAD || to_zero) {
        grow(p->constant, history, p->sign > 0.0, p->sign * drift);
        history[TURN_DRIFT] = drift;
        history[TURN_SHEAR] = shear;
    }
}

struct storey_response peak_oriented_respond(const double *constant, const double *history,
                                             double drift, double *after) {
    struct path p = path_to(constant, history, drift);
    const double way = p.sign * drift;
    const enum stage stage = stage_of(&p, way);
    struct storey_response r = response(&p, stage, way);
    r.shear *= p.sign;
    if (after) {
        memmove(after, history, PEAK_ORIENTED_HISTORY * sizeof *after);
        arrive(&p, stage, drift, r.shear, after);
    }
    return r;
}

double peak_oriented_stored(const double *constant, const double *history, double drift) {
    double shear = peak_oriented_respond(constant, history, drift, NULL).shear;
    double softened = history[shear > 0.0 ? SOFTENING_RIGHT : SOFTENING_LEFT];
    return shear * shear / (2.0 * unloading_stiffness(constant, softened));
}
