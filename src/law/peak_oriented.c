// SPDX-License-Identifier: GPL-3.0-or-later
// A path is told from the committed point on in the direction of the drift, with drifts and shears
// counted positive that way. It unloads the other side down to zero shear if it must, goes up to
// the point where this side was last unloaded, from there straight to its target, and along the
// backbone.
#include "law/peak_oriented.h"

#include <math.h>
#include <stdbool.h>
#include <string.h>

// The committed drift and shear, the beyond-yield part of the largest drift either way, and the
// point from which the present side was last unloaded.
enum { DRIFT, SHEAR, RIGHT, LEFT, TURN_DRIFT, TURN_SHEAR };

struct point {
    double drift, shear;
};

struct path {
    const double *constant;
    double sign;       // of the direction
    struct point now;  // where it starts
    struct point turn;
    double largest[2];  // drift of this side, and of the other
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

// At zero shear the drift is not on the other side of zero: else reloading would have to start
// beyond its target.
static double unloading_stiffness(const double *c, double largest) {
    double k = c[PEAK_ORIENTED_STIFFNESS];
    double alpha = c[PEAK_ORIENTED_ALPHA];
    if (alpha == 0.0) {
        return k;
    }
    double share = yield_drift(c) / largest;
    double to_origin = share + c[PEAK_ORIENTED_HARDENING] * (1.0 - share);
    return k * fmax(pow(share, alpha), to_origin);
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
    double largest = p->largest[0];
    double target = largest - c[PEAK_ORIENTED_BETA] * (largest - yield_drift(c));
    double stiffness = unloading_stiffness(c, largest);
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
    int side = sign > 0.0 ? RIGHT : LEFT;
    int other = sign > 0.0 ? LEFT : RIGHT;
    return (struct path){
        .constant = c,
        .sign = sign,
        .now = {sign * h[DRIFT], sign * h[SHEAR]},
        .turn = {sign * h[TURN_DRIFT], sign * h[TURN_SHEAR]},
        .largest = {yield_drift(c) + h[side], yield_drift(c) + h[other]},
    };
}

// Where along the path `drift` lies. Unloading to zero shear moves the turning point there.
enum stage { STAGE_UNLOAD, STAGE_RETURN, STAGE_RELOAD };
static enum stage stage_of(struct path *p, double drift) {
    if (p->now.shear < 0.0) {
        double stiffness = unloading_stiffness(p->constant, p->largest[1]);
        double zero = p->now.drift - p->now.shear / stiffness;
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
    double largest = p->largest[stage == STAGE_UNLOAD];
    double stiffness = unloading_stiffness(p->constant, largest);
    return (struct storey_response){p->now.shear + stiffness * (drift - p->now.drift), stiffness};
}

struct storey_response peak_oriented_shear(const double *constant, const double *history,
                                           double drift) {
    struct path p = path_to(constant, history, drift);
    double way = p.sign * drift;
    enum stage stage = stage_of(&p, way);
    struct storey_response r = response(&p, stage, way);
    r.shear *= p.sign;
    return r;
}

void peak_oriented_commit(const double *constant, double *history, double drift) {
    struct path p = path_to(constant, history, drift);
    double way = p.sign * drift;
    enum stage stage = stage_of(&p, way);
    double along = response(&p, stage, way).shear;
    double shear = p.sign * along;
    bool to_zero = stage == STAGE_UNLOAD && along >= 0.0;  // from where it would reload anyway
    history[DRIFT] = drift;
    history[SHEAR] = shear;
    if (stage == STAGE_RELOAD || to_zero) {
        double *beyond = &history[p.sign > 0.0 ? RIGHT : LEFT];
        *beyond = fmax(*beyond, way - yield_drift(constant));
        history[TURN_DRIFT] = drift;
        history[TURN_SHEAR] = shear;
    }
}

double peak_oriented_stored(const double *constant, const double *history, double drift) {
    double shear = peak_oriented_shear(constant, history, drift).shear;
    double beyond = fmax(history[shear > 0.0 ? RIGHT : LEFT], 0.0);
    double stiffness = unloading_stiffness(constant, yield_drift(constant) + beyond);
    return shear * shear / (2.0 * stiffness);
}
