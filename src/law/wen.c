// SPDX-License-Identifier: GPL-3.0-or-later
#include "law/wen.h"

// The coefficients of dz/ds at the energy e.
struct wear {
    double a, nu, per_eta;
    double zeta1, per_zeta2, middle;  // of the slip
};

// A storey on its way; z counts positive in the direction of the drift.
struct worn {
    double z, e, lost;  // lost: 1 - exp(-p e)
};

static inline struct wear wear_at(const double *c, const struct worn *at) {
    static const double LEAST_A = 0.1;
    const double *own = c + WEN_WEAR;
    const double e = at->e > 0.0 ? at->e : 0.0, a = 1.0 - own[WEN_DELTA_A] * e;
    struct wear w = {.a = a > LEAST_A ? a : LEAST_A,
                     .nu = 1.0 + own[WEN_DELTA_NU] * e,
                     .per_eta = 1.0 / (1.0 + own[WEN_DELTA_ETA] * e)};
    if (own[WEN_ZETA_S] > 0.0) {
        w.zeta1 = own[WEN_ZETA_S] * at->lost;
        w.per_zeta2 = 1.0 / ((own[WEN_PSI] + own[WEN_DELTA_PSI] * e) * (own[WEN_LAMBDA] + w.zeta1));
    }
    if (own[WEN_Q] > 0.0) {
        const double most = w.a / (w.nu * c[WEN_PLUS]), n = c[WEN_EXPONENT];
        const double z_u = n == 1.0 ? most : n == 2.0 ? sqrt(most) : pow(most, 1.0 / n);
        w.middle = own[WEN_Q] * z_u;
    }
    return w;
}

static inline double worn_slope(const double *c, const struct wear *w, double z) {
    const double slope_0 = (w->a - w->nu * (1.0 - wen_slope(c, z))) * w->per_eta;
    const double t = (z - w->middle) * w->per_zeta2;
    // Beyond, the slip is less than the rounding of 1.
    return w->zeta1 > 0.0 && t * t < 40.0 ? slope_0 * (1.0 - w->zeta1 * exp(-t * t)) : slope_0;
}

static inline double worn_rate(const double *c, const struct worn *at) {
    const struct wear w = wear_at(c, at);
    return worn_slope(c, &w, at->z);
}

// At z, after the energy de. Most steps are short: then a series takes less time than expm1.
static inline struct worn worn_beyond(const double *c, const struct worn *from, double z,
                                      double de) {
    const double y = -c[WEN_WEAR + WEN_P] * de;
    const double grown =
        fabs(y) < 1e-3 ? y * (1.0 + y / 2.0 * (1.0 + y / 3.0 * (1.0 + y / 4.0))) : expm1(y);
    return (struct worn){z, from->e + de, from->lost - (1.0 - from->lost) * grown};
}

// A step of the drift h; *rate at its start becomes that at its end.
static inline struct worn worn_step(const double *c, const struct worn *from, double h,
                                    double *rate) {
    const double k1 = *rate, share = c[WEN_YIELDING] * h, z = from->z;
    const struct worn half = worn_beyond(c, from, z + h / 2.0 * k1, share / 2.0 * z);
    const double k2 = worn_rate(c, &half);
    const struct worn third = worn_beyond(c, from, z + 0.75 * h * k2, 0.75 * share * half.z);
    const double k3 = worn_rate(c, &third);
    const struct worn end = worn_beyond(c, from, z + h / 9.0 * (2.0 * k1 + 3.0 * k2 + 4.0 * k3),
                                        share / 9.0 * (2.0 * z + 3.0 * half.z + 4.0 * third.z));
    *rate = worn_rate(c, &end);
    return end;
}

// The same through z = 0, where the slope has a kink. The way there is an integral of dz / slope by
// Simpson's rule, as in storey/bouc_wen.c.
static struct worn worn_through_zero(const double *c, const struct worn *from, double h,
                                     double *rate) {
    const double start = *rate;
    const struct worn end = worn_step(c, from, h, rate);
    if (from->z >= 0.0 || end.z <= 0.0) {
        return end;
    }
    const struct wear w = wear_at(c, from);
    const double way =
        -from->z / 6.0 *
        (1.0 / start + 4.0 / worn_slope(c, &w, from->z / 2.0) + 1.0 / worn_slope(c, &w, 0.0));
    const struct worn zero = worn_beyond(c, from, 0.0, c[WEN_YIELDING] * from->z * way / 2.0);
    *rate = worn_rate(c, &zero);
    return worn_step(c, &zero, fmax(h - way, 0.0), rate);
}

struct storey_response wen_worn_respond(const double *c, const double *h, double drift,
                                        double *after) {
    static const double PER_WIDTH = 0.1;
    const double *own = c + WEN_WEAR;
    const double s = (drift - h[WEN_DRIFT]) * c[WEN_PER_DRIFT], sign = copysign(1.0, s),
                 size = fabs(s);
    const double narrow =
        own[WEN_ZETA_S] > 0.0 ? PER_WIDTH * own[WEN_PSI] * own[WEN_LAMBDA] : WEN_STEP;
    const double most = narrow < WEN_STEP ? narrow : WEN_STEP;
    struct worn at = {sign * h[WEN_Z], h[WEN_ENERGY], h[WEN_LOST]};
    double rate = h[WEN_DIRECTION] == sign ? h[WEN_RATE] : worn_rate(c, &at);
    const int n = size <= most ? 1 : (int)fmin(ceil(size / most), 1e6);
    for (int i = 0; i < n; i++) {
        at = worn_through_zero(c, &at, size / n, &rate);
    }
    if (after) {
        after[WEN_DRIFT] = drift;
        after[WEN_Z] = sign * at.z;
        after[WEN_ENERGY] = at.e;
        after[WEN_LOST] = at.lost;
        after[WEN_RATE] = rate;
        after[WEN_DIRECTION] = sign;
    }
    return (struct storey_response){
        .shear = c[WEN_BACK] * drift + c[WEN_STRENGTH] * (sign * at.z),
        .tangent = c[WEN_BACK] + c[WEN_SLOPE] * rate,
    };
}

// Energy of the elastic spring, and what unloading to z = 0 would give back with the coefficients
// of now: the integral of z / slope, by Simpson's rule.
double wen_worn_stored(const double *c, const double *h, double drift) {
    enum { PARTS = 64 };
    double after[WEN_HISTORY];
    wen_worn_respond(c, h, drift, after);
    const struct worn at = {after[WEN_Z], after[WEN_ENERGY], after[WEN_LOST]};
    const struct wear w = wear_at(c, &at);
    const double size = fabs(at.z);
    double sum = 0.0;
    for (int i = 1; i <= PARTS; i++) {
        const double z = size * i / PARTS;
        sum += (i == PARTS ? 1.0 : i % 2 ? 4.0 : 2.0) * z / worn_slope(c, &w, -z);
    }
    return c[WEN_BACK] * drift * drift / 2.0 +
           c[WEN_STRENGTH] / c[WEN_PER_DRIFT] * sum * size / (3.0 * PARTS);
}
