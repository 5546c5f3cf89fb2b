// SPDX-License-Identifier: GPL-3.0-or-later
#include "law/wen.h"

static const double LEAST_A = 0.1;

// The coefficients of dz/ds at the energy e, and their derivatives by e.
struct wear {
    double a, nu, per_eta;
    double zeta1, per_zeta2, middle;  // of the slip
    double by_e_a, by_e_nu, by_e_zeta1, by_e_zeta2, by_e_middle;
};

// A storey on its way; z counts positive in the direction of the drift.
struct worn {
    double z, e, lost;  // lost: 1 - exp(-p e)
    double rate, bend;  // dz/ds and d2z/ds2
};

static inline struct wear wear_at(const double *c, const struct worn *at) {
    const double *own = c + WEN_WEAR;
    const double e = at->e > 0.0 ? at->e : 0.0, a = 1.0 - own[WEN_DELTA_A] * e;
    struct wear w = {.a = a > LEAST_A ? a : LEAST_A,
                     .nu = 1.0 + own[WEN_DELTA_NU] * e,
                     .per_eta = 1.0 / (1.0 + own[WEN_DELTA_ETA] * e),
                     .by_e_a = a > LEAST_A ? -own[WEN_DELTA_A] : 0.0,
                     .by_e_nu = own[WEN_DELTA_NU]};
    if (own[WEN_ZETA_S] > 0.0) {
        const double psi = own[WEN_PSI] + own[WEN_DELTA_PSI] * e;
        w.zeta1 = own[WEN_ZETA_S] * at->lost;
        w.per_zeta2 = 1.0 / (psi * (own[WEN_LAMBDA] + w.zeta1));
        w.by_e_zeta1 = own[WEN_ZETA_S] * own[WEN_P] * (1.0 - at->lost);
        w.by_e_zeta2 = own[WEN_DELTA_PSI] * (own[WEN_LAMBDA] + w.zeta1) + psi * w.by_e_zeta1;
    }
    if (own[WEN_Q] > 0.0) {
        const double most = w.a / (w.nu * c[WEN_PLUS]), n = c[WEN_EXPONENT];
        const double z_u = n == 1.0 ? most : n == 2.0 ? sqrt(most) : pow(most, 1.0 / n);
        w.middle = own[WEN_Q] * z_u;
        w.by_e_middle = w.middle / n * (w.by_e_a / w.a - w.by_e_nu / w.nu);
    }
    return w;
}

// dz/ds and its derivatives by z and by e. At z = 0 the derivative by z is that of the side ahead.
struct worn_rates {
    double rate, by_z, by_e;
};

static inline struct worn_rates worn_rates(const double *c, const struct worn *at) {
    const struct wear w = wear_at(c, at);
    const double n = c[WEN_EXPONENT], z = at->z, size = fabs(z);
    const double side = z >= 0.0 ? c[WEN_PLUS] : -c[WEN_MINUS];
    const double low = side * (n == 1.0 ? 1.0 : n == 2.0 ? size : pow(size, n - 1.0));
    const double power = low * z, by_e_eta = c[WEN_WEAR + WEN_DELTA_ETA];
    struct worn_rates r = {.rate = (w.a - w.nu * power) * w.per_eta,
                           .by_z = -w.nu * n * low * w.per_eta};
    r.by_e = (w.by_e_a - w.by_e_nu * power - r.rate * by_e_eta) * w.per_eta;
    const double t = (z - w.middle) * w.per_zeta2;
    if (w.zeta1 > 0.0 && t * t < 40.0) {
        const double bell = exp(-t * t), slip = 1.0 - w.zeta1 * bell;
        const double steep = 2.0 * w.zeta1 * bell * t * w.per_zeta2;
        r.by_z = r.by_z * slip + r.rate * steep;
        r.by_e = r.by_e * slip -
                 r.rate * (w.by_e_zeta1 * bell + steep * (w.by_e_middle + t * w.by_e_zeta2));
        r.rate *= slip;
    }
    return r;
}

// dz/ds at another z.
static double worn_rate(const double *c, struct worn at, double z) {
    at.z = z;
    return worn_rates(c, &at).rate;
}

// Sets the rate and the bend where the storey is.
static inline void worn_look(const double *c, struct worn *at) {
    const struct worn_rates r = worn_rates(c, at);
    at->rate = r.rate;
    at->bend = r.by_z * r.rate + r.by_e * (c[WEN_YIELDING] * at->z);
}

// At z, after the energy de. Most steps are short: then a series takes less time than expm1.
static inline struct worn worn_beyond(const double *c, const struct worn *from, double z,
                                      double de) {
    const double y = -c[WEN_WEAR + WEN_P] * de;
    const double grown =
        fabs(y) < 1e-3 ? y * (1.0 + y / 2.0 * (1.0 + y / 3.0 * (1.0 + y / 4.0))) : expm1(y);
    return (struct worn){z, from->e + de, from->lost - (1.0 - from->lost) * grown, 0.0, 0.0};
}

// A step of the drift h. The parabola of the start leads to a point p near the end. The rates there
// give z by the quadrature of third order 2/3, 1/3 and h^2/6 of the bend, and its error at p
// corrects the rate at the end.
static inline struct worn worn_step(const double *c, const struct worn *from, double h) {
    const double k = from->rate, g = from->bend, z = from->z, yielding = c[WEN_YIELDING];
    const double near = z + h * (k + h / 2.0 * g);
    const double de = yielding * h * (z + h / 2.0 * (k + h / 3.0 * g));
    struct worn end = worn_beyond(c, from, near, de);
    const struct worn_rates r = worn_rates(c, &end);
    end.z = z + h / 3.0 * (2.0 * k + r.rate + h / 2.0 * g);
    end.rate = r.rate + r.by_z * (end.z - near);
    const double more = yielding * h * ((z + end.z) / 2.0 + h / 12.0 * (k - end.rate)) - de;
    end.e += more;
    end.lost += c[WEN_WEAR + WEN_P] * (1.0 - end.lost) * more;
    end.bend = r.by_z * end.rate + r.by_e * (yielding * end.z);
    return end;
}

// The same from z < 0 through z = 0, where the slope has a kink. The way there is an integral of
// dz / slope by Simpson's rule, as in storey/bouc_wen.c.
static struct worn worn_through_zero(const double *c, const struct worn *from, double h) {
    const double way = -from->z / 6.0 *
                       (1.0 / from->rate + 4.0 / worn_rate(c, *from, from->z / 2.0) +
                        1.0 / worn_rate(c, *from, 0.0));
    struct worn zero = worn_beyond(c, from, 0.0, c[WEN_YIELDING] * from->z * way / 2.0);
    worn_look(c, &zero);
    return worn_step(c, &zero, fmax(h - way, 0.0));
}

// The same past the energy at which A reaches its least value, a kink too. The way there is a root
// of the energy, near `way`, by Newton's method. The step ends just beyond.
static struct worn worn_past_least(const double *c, const struct worn *from, double way, double h) {
    const double energy = (1.0 - LEAST_A) / c[WEN_WEAR + WEN_DELTA_A];
    struct worn kink = worn_step(c, from, way);
    way += (energy - kink.e) / (c[WEN_YIELDING] * kink.z);
    way = fmin(fmax(way, 0.0) * (1.0 + 1e-6), h);
    kink = worn_step(c, from, way);
    worn_look(c, &kink);
    return worn_step(c, &kink, h - way);
}

static struct worn worn_advance(const double *c, const struct worn *from, double h) {
    const struct worn end = worn_step(c, from, h);
    const double loss = c[WEN_WEAR + WEN_DELTA_A], before = 1.0 - LEAST_A - loss * from->e;
    const double after = 1.0 - LEAST_A - loss * end.e;
    if (from->z < 0.0 && end.z > 0.0) {
        return worn_through_zero(c, from, h);
    }
    return before * after < 0.0 ? worn_past_least(c, from, h * before / (before - after), h) : end;
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
    struct worn at = {sign * h[WEN_Z], h[WEN_ENERGY], h[WEN_LOST], h[WEN_RATE], h[WEN_BEND]};
    if (h[WEN_DIRECTION] != sign) {
        worn_look(c, &at);
    }
    const int n = size <= most ? 1 : (int)fmin(ceil(size / most), 1e6);
    for (int i = 0; i < n; i++) {
        at = worn_advance(c, &at, size / n);
    }
    if (after) {
        after[WEN_DRIFT] = drift;
        after[WEN_Z] = sign * at.z;
        after[WEN_ENERGY] = at.e;
        after[WEN_LOST] = at.lost;
        after[WEN_RATE] = at.rate;
        after[WEN_BEND] = at.bend;
        after[WEN_DIRECTION] = sign;
    }
    return (struct storey_response){
        .shear = c[WEN_BACK] * drift + c[WEN_STRENGTH] * (sign * at.z),
        .tangent = c[WEN_BACK] + c[WEN_SLOPE] * at.rate,
    };
}

// Energy of the elastic spring, and what unloading to z = 0 would give back with the coefficients
// of now: the integral of z / slope, by Simpson's rule.
double wen_worn_stored(const double *c, const double *h, double drift) {
    enum { PARTS = 64 };
    double after[WEN_HISTORY];
    wen_worn_respond(c, h, drift, after);
    const struct worn at = {.z = after[WEN_Z], .e = after[WEN_ENERGY], .lost = after[WEN_LOST]};
    const double size = fabs(at.z);
    double sum = 0.0;
    for (int i = 1; i <= PARTS; i++) {
        const double z = size * i / PARTS;
        sum += (i == PARTS ? 1.0 : i % 2 ? 4.0 : 2.0) * z / worn_rate(c, at, -z);
    }
    return c[WEN_BACK] * drift * drift / 2.0 +
           c[WEN_STRENGTH] / c[WEN_PER_DRIFT] * sum * size / (3.0 * PARTS);
}
