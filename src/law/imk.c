// SPDX-License-Identifier: GPL-3.0-or-later
#include "law/imk.h"

#include <math.h>

enum { BACKBONE_LINES = 5 };

// One direction: its constants and what has become of them.
struct imk_view {
    const double *c;  // of the direction
    double *own;
    double stiffness;
};

static struct imk_view imk_view(const double *c, double *h, bool right) {
    return (struct imk_view){
        .c = c + (right ? IMK_RIGHT : IMK_LEFT),
        .own = h + (right ? IMK_OF_RIGHT : IMK_OF_LEFT),
        .stiffness = c[LOADING_STIFFNESS],
    };
}

static double imk_hard(const struct imk_view *v, double drift) {
    const double yield = v->own[IMK_FY];
    return yield + v->own[IMK_KS] * (drift - yield / v->stiffness);
}

// Beyond capping, residual strength included.
static double imk_soft(const struct imk_view *v, double drift) {
    return fmax(v->own[IMK_FREF] + v->c[IMK_FALL] * drift, v->c[IMK_RESIDUAL]);
}

static double imk_backbone(const struct imk_view *v, double drift) {
    const double falls = v->own[IMK_FREF] + v->c[IMK_FALL] * drift;
    return fmax(fmin(imk_hard(v, drift), falls), v->c[IMK_RESIDUAL]);
}

// Where the hardening line has the shear f.
static double imk_hard_at(const struct imk_view *v, double f) {
    const double yield = v->own[IMK_FY];
    return yield / v->stiffness + (f - yield) / v->own[IMK_KS];
}

// Where the line beyond capping has the shear f; infinite without capping.
static double imk_falls_at(const struct imk_view *v, double f) {
    return v->c[IMK_FALL] < 0.0 ? (f - v->own[IMK_FREF]) / v->c[IMK_FALL] : INFINITY;
}

static double imk_capping(const struct imk_view *v) {
    const double fall = v->c[IMK_FALL], hard = v->own[IMK_KS], yield = v->own[IMK_FY];
    return fall < 0.0 ? (v->own[IMK_FREF] - yield + hard * yield / v->stiffness) / (hard - fall)
                      : INFINITY;
}

struct imk_lines {
    int n;
    struct loading_line line[LOADING_LINES_MAX];
};

static void imk_add(struct imk_lines *l, double drift, double shear, double slope) {
    l->line[l->n++] = (struct loading_line){drift, shear, slope};
}

// The falling line and the residual strength, from `drift` on.
static void imk_add_soft(const struct imk_view *v, double drift, struct imk_lines *to) {
    const double residual = v->c[IMK_RESIDUAL], end = imk_falls_at(v, residual);
    if (drift < end) {
        imk_add(to, drift, v->own[IMK_FREF] + v->c[IMK_FALL] * drift, v->c[IMK_FALL]);
    }
    if (isfinite(end)) {
        imk_add(to, fmax(drift, end), residual, 0.0);
    }
}

// The backbone from `drift` on, of peak and pinched storeys.
static void imk_add_backbone(const struct imk_view *v, double drift, struct imk_lines *to) {
    const double residual = v->c[IMK_RESIDUAL], capping = imk_capping(v), slope = v->own[IMK_KS];
    if (drift < capping) {
        double end = capping;
        double from = drift;
        if (imk_hard(v, drift) < residual || (imk_hard(v, drift) == residual && slope < 0.0)) {
            imk_add(to, drift, residual, 0.0);
            from = slope > 0.0 ? imk_hard_at(v, residual) : INFINITY;
        } else if (slope < 0.0) {
            end = fmin(end, imk_hard_at(v, residual));
        }
        if (from >= end) {
            return;
        }
        imk_add(to, from, imk_hard(v, from), slope);
        drift = end;
    }
    if (isfinite(drift)) {
        imk_add_soft(v, drift, to);
    }
}

// The strength of a bilinear storey from `drift` on.
static void imk_add_bilinear(const struct imk_view *v, double drift, struct imk_lines *to) {
    const double limit = v->own[IMK_LIMIT], slope = v->own[IMK_KS];
    const double soft = fmin(imk_soft(v, drift), limit);
    double from = drift;
    if (imk_hard(v, drift) < 0.0 && slope > 0.0) {
        imk_add(to, drift, 0.0, 0.0);
        from = imk_hard_at(v, 0.0);
    }
    if (imk_hard(v, from) < soft || from > drift) {
        imk_add(to, from, fmax(imk_hard(v, from), 0.0), slope);
        // The first of the drifts at which the hardening line meets the others.
        double end = imk_capping(v);
        if (slope > 0.0) {
            end = fmin(fmax(end, imk_hard_at(v, v->c[IMK_RESIDUAL])), imk_hard_at(v, limit));
        } else if (slope < 0.0 && imk_hard_at(v, 0.0) < end) {
            imk_add(to, imk_hard_at(v, 0.0), 0.0, 0.0);
            return;
        } else if (slope == 0.0 && v->own[IMK_FY] <= v->c[IMK_RESIDUAL]) {
            return;
        }
        from = end;
    }
    const double fall = imk_falls_at(v, limit);
    if (limit < INFINITY && from < fall) {
        imk_add(to, from, limit, 0.0);
        from = fall;
    }
    if (isfinite(from)) {
        imk_add_soft(v, from, to);
    }
}

// The lines end at the ultimate drift.
static void imk_end(const struct imk_view *v, double drift, struct imk_lines *to) {
    const double end = v->own[IMK_DEAD] != 0.0 ? drift : v->c[IMK_ULTIMATE];
    if (isfinite(end)) {
        while (to->n > 0 && to->line[to->n - 1].drift >= end) {
            to->n--;
        }
        imk_add(to, end, 0.0, 0.0);
    }
}

// Adds the line from the last start to the point (drift, shear).
static void imk_aim(struct imk_lines *to, double drift, double shear) {
    struct loading_line *last = &to->line[to->n - 1];
    const double way = drift - last->drift;
    last->slope = way > 0.0 ? (shear - last->shear) / way : 0.0;
}

// From the last start to the target, by the last turn if that is stiffer.
static void imk_reload(const struct imk_view *v, bool local, struct imk_lines *to) {
    const double drift = v->own[IMK_LOCAL_DRIFT], shear = v->own[IMK_LOCAL_SHEAR];
    const double target = v->own[IMK_DT], most = imk_backbone(v, target);
    const struct loading_line from = to->line[to->n - 1];
    if (local && shear > 0.0 && from.drift < drift && drift < target && shear < most &&
        (shear - from.shear) * (target - from.drift) > (most - from.shear) * (drift - from.drift)) {
        imk_aim(to, drift, shear);
        imk_add(to, drift, shear, 0.0);
    }
    imk_aim(to, target, most);
    imk_add_backbone(v, target, to);
}

static void imk_path(const double *c, double *h, const struct imk_view *v) {
    struct imk_lines path = {0};
    const double z = h[LOADING_DRIFT], target = v->own[IMK_DT];
    if (c[IMK_CYCLE] == IMK_BILINEAR) {
        imk_add_bilinear(v, z, &path);
    } else if (z >= target) {
        imk_add_backbone(v, z, &path);
    } else {
        imk_add(&path, z, 0.0, 0.0);
        const double most = imk_backbone(v, target);
        const double at = (1.0 - c[IMK_KD]) * (target - most / h[LOADING_SLOPE]);
        bool local = c[IMK_LOCAL] != 0.0;
        if (c[IMK_CYCLE] == IMK_PINCHED && z < at) {
            const double shear = c[IMK_KF] * most * (at - z) / (target - z);
            imk_aim(&path, at, shear);
            imk_add(&path, at, shear, 0.0);
        } else if (c[IMK_CYCLE] == IMK_PINCHED) {
            local = false;
        }
        imk_reload(v, local, &path);
    }
    imk_end(v, z, &path);
    loading_follow(&imk_rule, h, path.line, path.n);
}

// beta of a mode for the work of an excursion; notes a capacity that is used up.
static double imk_beta(const double *c, double *h, enum imk_mode mode, double work) {
    const double capacity = c[IMK_CAPACITY + mode];
    if (work <= c[IMK_NOISE] || capacity == INFINITY) {
        return 0.0;
    }
    const double left = capacity - h[IMK_SUM] - (c[IMK_EARLIER] != 0.0 ? 0.0 : work);
    if (left <= work) {
        h[IMK_LOST] = c[IMK_KEEPS] != 0.0 ? 0.0 : 1.0;
        return 1.0;
    }
    const double exponent = c[IMK_EXPONENT + mode], ratio = work / left;
    return exponent == 1.0 ? ratio : pow(ratio, exponent);
}

static void imk_start(const double *c, double *h) {
    for (int right = 0; right < 2; right++) {
        const struct imk_view v = imk_view(c, h, right);
        v.own[IMK_FY] = v.c[IMK_YIELD];
        v.own[IMK_KS] = v.c[IMK_HARDENING];
        v.own[IMK_FREF] = v.c[IMK_REFERENCE];
        v.own[IMK_DT] = v.c[IMK_YIELD] / v.stiffness;
        v.own[IMK_LIMIT] = INFINITY;
    }
    h[IMK_START_SLOPE] = c[LOADING_STIFFNESS];
}

static void imk_enter(const double *c, double *h) {
    const struct imk_view v = imk_view(c, h, h[LOADING_SIDE] > 0.0);
    const double work = h[LOADING_WORK] > c[IMK_NOISE] ? h[LOADING_WORK] : 0.0;
    const double share = v.c[IMK_SHARE];
    const double strength = 1.0 - share * imk_beta(c, h, IMK_STRENGTH, work);
    v.own[IMK_FY] *= strength;
    v.own[IMK_KS] *= strength;
    if (isfinite(v.own[IMK_FREF])) {
        v.own[IMK_FREF] *= 1.0 - share * imk_beta(c, h, IMK_CAPPING, work);
    }
    if (c[IMK_CYCLE] != IMK_BILINEAR) {
        v.own[IMK_DT] *= 1.0 + share * imk_beta(c, h, IMK_TARGET, work);
    }
    if (h[IMK_LOST] != 0.0) {
        h[IMK_OF_RIGHT + IMK_DEAD] = h[IMK_OF_LEFT + IMK_DEAD] = 1.0;
    }
    h[IMK_SUM] += work;
    h[IMK_START_SLOPE] = h[LOADING_SLOPE];
    imk_path(c, h, &v);
}

// The least unloading stiffness.
static double imk_least_slope(const double *c, double *h) {
    if (c[IMK_CYCLE] == IMK_BILINEAR) {
        return 0.1 * c[LOADING_STIFFNESS];
    }
    const struct imk_view right = imk_view(c, h, true), left = imk_view(c, h, false);
    const double drift = right.own[IMK_DT], other = left.own[IMK_DT];
    return (imk_backbone(&right, drift) + imk_backbone(&left, other)) / (drift + other);
}

static void imk_turn(const double *c, double *h) {
    const struct imk_view v = imk_view(c, h, h[LOADING_SIDE] > 0.0);
    const double shear = h[LOADING_SHEAR], slope = h[LOADING_SLOPE];
    if (shear > 0.0) {
        const bool below = h[LOADING_DRIFT] < v.own[IMK_DT];
        v.own[IMK_LOCAL_DRIFT] = h[LOADING_DRIFT];
        v.own[IMK_LOCAL_SHEAR] = below ? shear : 0.0;
    }
    const double lost = h[IMK_LOST];
    const double work = h[LOADING_WORK] - shear * shear / (2.0 * slope);
    const double beta = imk_beta(c, h, IMK_UNLOADING, work);
    if (beta > 0.0 && h[IMK_LOST] == lost) {
        const double from = c[IMK_COMPOUND] != 0.0 ? slope : h[IMK_START_SLOPE];
        const double least = imk_least_slope(c, h);
        h[LOADING_SLOPE] = fmin(from, fmax(from * (1.0 - beta), least));
    }
}

static void imk_arrive(const double *c, double *h) {
    const struct imk_view v = imk_view(c, h, h[LOADING_SIDE] > 0.0);
    const double drift = h[LOADING_DRIFT];
    v.own[IMK_DT] = fmax(v.own[IMK_DT], drift);
    if (c[IMK_CYCLE] == IMK_BILINEAR && c[IMK_UNLIMITED] == 0.0) {
        const double soft = imk_soft(&v, drift);
        if (h[LOADING_SHEAR] >= soft * (1.0 - 1e-12)) {
            v.own[IMK_LIMIT] = fmin(v.own[IMK_LIMIT], soft);
        }
    }
    if (drift >= v.c[IMK_ULTIMATE]) {
        v.own[IMK_DEAD] = 1.0;
        if (c[IMK_BOTH] != 0.0) {
            h[IMK_OF_RIGHT + IMK_DEAD] = h[IMK_OF_LEFT + IMK_DEAD] = 1.0;
        }
    }
}

const struct loading_rule imk_rule = {
    .path = IMK_PATH,
    .start = imk_start,
    .turn = imk_turn,
    .enter = imk_enter,
    .arrive = imk_arrive,
};
