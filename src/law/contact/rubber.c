// SPDX-License-Identifier: GPL-3.0-or-later
// A rubber bumper. Its force hardens as a power of the compression, is linear beyond the ultimate
// compression du, and returns less energy than it took:
//
//     F = f(d)             while v >= 0,
//     F = f(d) (1 + c v)   while v < 0, but not below 0,
//     f = k d^n to d = du, then k du^n + ky (d - du).
//
// This form is that of Polycarpou, Komodromos & Polycarpou (2013): a power of the indentation with
// n > 1, damping on release only, and a stiffness ky beyond the ultimate compression of a bumper of
// limited thickness. Only the abstract was available. The authors' values of k, n and c for rubber
// were not checked, so none is a default.
//
// Our choices: F is not below 0. Without ky the slope continues at du. With -e, c = q / v0, where q
// follows from the energies of the release, for any f:
//
//     ln(1 - e q) + e q + q^2 / 2 = 0.
//
// With -c the restitution decreases with the velocity. The force starts and ends at 0 and does not
// jump. Its slopes jump at v = 0 and d = du. A renewed approach within one contact follows f again.
// Every release dissipates the power f c v^2.
//
// A bumper of thickness t in a clear distance g is a contact with the gap g - t.
#include <math.h>

#include "law/lists.h"
#include "law/power.h"
#include "law/restitution.h"

enum { K, E, ZETA, C, DU, KY, VMIN, N, N_ROW };
enum { STIFFNESS, EXPONENT, ULTIMATE, BEYOND, FIXED, Q, LEAST_V0, N_CONSTANT };
enum { DAMPING, N_HISTORY };  // c [T/L]

static const struct row rows[N_ROW] = {
    [K] = POWER_STIFFNESS_ROW("stiffness of the bumper"),
    [E] = RESTITUTION_ROW,
    [ZETA] = {"zeta", ROW_NUMBER, ROW_ONE_OF, OF_NONE, &range_non_negative, NAN,
              "dimensionless damping q = c v0"},
    [C] = {"c", ROW_NUMBER, ROW_ONE_OF, OF_PER_VELOCITY, &range_non_negative, NAN,
           "damping of the release"},
    [DU] = {"du", ROW_NUMBER, 0, OF_LENGTH, &range_positive, NAN,
            "ultimate compression, beyond which the force is linear; default: no limit"},
    [KY] = {"ky", ROW_NUMBER, 0, OF_STIFFNESS, &range_positive, NAN,
            "stiffness beyond du; default: the slope at du"},
    [VMIN] = LEAST_V0_ROW,
    [N] = {"n", ROW_NUMBER, ROW_REQUIRED | ROW_POWER, OF_NONE, &power_range, NAN, "exponent"},
};

static int rubber_prepare(const double *value, double m_eff, double *constant, struct error *e) {
    (void)m_eff;
    if (isnan(value[DU]) && !isnan(value[KY])) {
        return error_set(e, STATUS_INPUT, "-ky needs -du");
    }
    double q = restitution_ratio(value[E], value[ZETA], restitution_release_q);
    bool fixed = !isnan(value[C]);
    if (isnan(q) && !fixed) {
        return error_no_memory(e);
    }
    bool endless = isnan(value[DU]);
    double slope = endless ? 0.0 : power_spring(value[K], value[N], value[DU]).dfdd;
    constant[STIFFNESS] = value[K];
    constant[EXPONENT] = value[N];
    constant[ULTIMATE] = endless ? INFINITY : value[DU];
    constant[BEYOND] = isnan(value[KY]) ? slope : value[KY];
    constant[FIXED] = fixed ? value[C] : 0.0;
    constant[Q] = fixed ? 0.0 : q;
    constant[LEAST_V0] = value[VMIN];
    return STATUS_OK;
}

static void rubber_close(const double *c, double v0, double *history) {
    history[DAMPING] = c[FIXED] + c[Q] / fmax(v0, c[LEAST_V0]);
}

static double share_of(const double *h, double v) {
    return 1.0 + h[DAMPING] * fmin(v, 0.0);
}

static struct contact_response rubber_force(const double *c, const double *h, double d, double v) {
    // The loading force f and its slope.
    struct contact_response r = power_spring(c[STIFFNESS], c[EXPONENT], fmin(d, c[ULTIMATE]));
    if (d > c[ULTIMATE]) {
        r.force += c[BEYOND] * (d - c[ULTIMATE]);
        r.dfdd = c[BEYOND];
    }
    if (v >= 0.0) {
        return r;
    }
    double factor = share_of(h, v);
    if (factor <= 0.0) {
        return (struct contact_response){0};
    }
    return (struct contact_response){
        .force = r.force * factor,
        .dfdd = r.dfdd * factor,
        .dfdv = r.force * h[DAMPING],
    };
}

// Kinks: at du, and where the force of separating bodies becomes 0.
static double rubber_kink(const double *c, const double *h, const struct contact_way *way) {
    double share = share_of(h, way->v);
    double kink = share_of(h, way->v0) > 0.0 ? share : -share;
    if (way->d0 < c[ULTIMATE] && way->d > way->d0) {
        return fmin(kink, c[ULTIMATE] - way->d);
    }
    bool leaves = way->d0 > c[ULTIMATE] && way->d < way->d0;
    return leaves ? fmin(kink, way->d - c[ULTIMATE]) : kink;
}

const struct contact_law contact_rubber = {
    .name = "rubber",
    .summary = "rubber bumper, or a shock absorber in the gap",
    .formula = "F = f while v >= 0, max(0, f (1 + c v)) after; f = k d^n to d = du, then k du^n + "
               "ky (d - du); c = q / v0, ln(1 - e q) + e q + q^2 / 2 = 0",
    .source =
        "form of the force: Polycarpou, Komodromos & Polycarpou (2013), Earthquake Eng. Struct. "
        "Dyn. 42, 81-100 (numbers not checked); the relation with e is derived in docs/theory.md",
    .remarks = "Use it for bumpers of limited thickness. It delivers e exactly. Faster loading "
               "does not make it stiffer.",
    .example = "-k 2e9N/m^2 -n 2 -e 0.5",
    .row = rows,
    .n_row = N_ROW,
    .n_constant = N_CONSTANT,
    .n_history = N_HISTORY,
    .traits = CONTACT_NEEDS_V0 | CONTACT_BUMPER,
    .prepare = rubber_prepare,
    .close = rubber_close,
    .force = rubber_force,
    .kink = rubber_kink,
    .exact = restitution_release_q,
};
