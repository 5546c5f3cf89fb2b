// SPDX-License-Identifier: GPL-3.0-or-later
// Bilinear spring with hysteresis. The force rises with k1 up to d = dy, then with k2. It unloads
// with k1 down to the line k2 d, then along this line to zero.
//
//     F = k2 d + S,   S = (k1 - k2) (d - offset),   0 <= S <= (k1 - k2) dy.
//
// The offset follows by limiting S, exactly if d does not reverse within the step. While S > 0, the
// offset is the largest penetration minus dy. A renewed approach within one contact rises with k1
// to the line of loading. An impact that reaches d_max > dy loses (k1 - k2) dy (d_max - dy). The
// tangent is k1 or k2 and jumps between both.
//
// Muthukumar & DesRoches derive k1, k2 and dy from a Hertz spring kh d^(3/2), from e, and from the
// velocity v0 of an impact. The Hertz spring reaches dm with dm^(5/2) = 5 m v0^2 / (4 kh). The
// impact should lose E = (1 - e^2) m v0^2 / 2:
//
//     dy = a dm,   k1 = K + E / (a dm^2),   k2 = K - E / ((1 - a) dm^2),   K = kh sqrt(dm).
//
// This bilinear spring needs more than m v0^2 / 2 up to dm, so the impact does not reach dm. An e
// of 0.65 gives 0.758. With K = kh sqrt(dm) (1 + e^2) / (5/2) (-calibrate) the impact reaches dm
// and loses E. k2 > 0 needs a < (3 + 2 e^2) / 5 as published, and a < 2 e^2 / (1 + e^2) with
// -calibrate.
#include <math.h>
#include <string.h>

#include "law/lists.h"
#include "law/restitution.h"

enum { K1, K2, DY, KH, E, V0, A, N_ROW };
enum { BASE, EXTRA, YIELD, N_CONSTANT };  // k2, k1 - k2, dy
enum { OFFSET, N_HISTORY };               // [L]

static const double USUAL_A = 0.1;

static const struct range yield_range = {
    .min = 0.0, .max = 1.0, .min_open = true, .max_open = true, .text = "> 0 and < 1"};

static const struct row rows[N_ROW] = {
    [K1] = {"k1", ROW_NUMBER, 0, OF_STIFFNESS, &range_positive, NAN,
            "stiffness up to dy and of unloading"},
    [K2] = {"k2", ROW_NUMBER, 0, OF_STIFFNESS, &range_positive, NAN, "stiffness beyond dy"},
    [DY] = {"dy", ROW_NUMBER, 0, OF_LENGTH, &range_positive, NAN, "yield penetration"},
    [KH] = {"kh", ROW_NUMBER, 0, OF_HERTZ_STIFFNESS, &range_positive, NAN,
            "Hertz stiffness, which gives k1, k2 and dy with -e and -v0"},
    [E] = {"e", ROW_NUMBER, 0, OF_NONE, &restitution_range, NAN,
           "coefficient of restitution, with -kh"},
    [V0] = {"v0", ROW_NUMBER, 0, OF_VELOCITY, &range_positive, NAN,
            "velocity of the impact that delivers e, with -kh"},
    [A] = {"a", ROW_NUMBER, 0, OF_NONE, &yield_range, NAN,
           "dy/dm, with -kh; default: 0.1, or less if -calibrate needs less"},
};

// True if the three values a, b and c are given.
static bool given(const double *value, int a, int b, int c) {
    return !isnan(value[a]) && !isnan(value[b]) && !isnan(value[c]);
}

static bool none(const double *value, int first, int last) {
    for (int i = first; i <= last; i++) {
        if (!isnan(value[i])) {
            return false;
        }
    }
    return true;
}

static int check_given(const double *value, struct error *e) {
    bool direct = given(value, K1, K2, DY) && none(value, KH, A);
    bool recipe = given(value, KH, E, V0) && none(value, K1, DY);
    if (!direct && !recipe) {
        return error_set(e, STATUS_INPUT,
                         "bilinear needs -k1, -k2 and -dy, or -kh, -e and -v0, and no mixture");
    }
    return STATUS_OK;
}

// k2 > 0 limits a.
static int check_a(const double *value, double limit, const char *formula, struct error *e) {
    if (value[A] < limit) {
        return STATUS_OK;
    }
    return error_set(e, STATUS_INPUT, "a is %.6g; with e = %.6g it must be < %s, which is %.6g",
                     value[A], value[E], formula, limit);
}

// Replaces kh, e, v0 and a by k1, k2 and dy. `fit` is K / (kh sqrt(dm)).
static void apply_recipe(double *value, double m_eff, double fit) {
    double energy = 0.5 * m_eff * value[V0] * value[V0];
    double loss = energy * (1.0 - value[E]) * (1.0 + value[E]);
    double deepest = pow(2.5 * energy / value[KH], 0.4);
    double stiffness = fit * value[KH] * sqrt(deepest);
    double square = deepest * deepest;
    double a = value[A];
    value[K1] = stiffness + loss / (a * square);
    value[K2] = stiffness - loss / ((1.0 - a) * square);
    value[DY] = a * deepest;
    value[KH] = value[E] = value[V0] = value[A] = NAN;
}

static int bilinear_prepare(const double *value, double m_eff, double *constant, struct error *e) {
    double v[N_ROW];
    memcpy(v, value, sizeof v);
    int status = check_given(v, e);
    if (status) {
        return status;
    }
    if (!isnan(v[KH])) {
        v[A] = isnan(v[A]) ? USUAL_A : v[A];
        status = check_a(v, (3.0 + 2.0 * v[E] * v[E]) / 5.0, "(3 + 2 e^2) / 5", e);
        if (status) {
            return status;
        }
        apply_recipe(v, m_eff, 1.0);
    }
    if (v[K2] > v[K1]) {
        return error_set(e, STATUS_INPUT, "k2 is %.6g; it must be <= k1, which is %.6g", v[K2],
                         v[K1]);
    }
    constant[BASE] = v[K2];
    constant[EXTRA] = v[K1] - v[K2];
    constant[YIELD] = v[DY];
    return STATUS_OK;
}

static int bilinear_calibrate(double *value, double m_eff, struct error *e) {
    int status = check_given(value, e);
    if (status) {
        return status;
    }
    double square = value[E] * value[E];
    double limit = 2.0 * square / (1.0 + square);
    if (isnan(value[A])) {
        value[A] = fmin(USUAL_A, limit / 2.0);
    }
    status = check_a(value, limit, "2 e^2 / (1 + e^2)", e);
    if (status == STATUS_OK) {
        apply_recipe(value, m_eff, (1.0 + square) / 2.5);
    }
    return status;
}

static void bilinear_close(const double *c, double v0, double *history) {
    (void)c, (void)v0;
    history[OFFSET] = 0.0;
}

static struct contact_response bilinear_force(const double *c, const double *h, double d,
                                              double v) {
    (void)v;
    double stretch = d - h[OFFSET];
    double limited = fmin(fmax(stretch, 0.0), c[YIELD]);
    return (struct contact_response){
        .force = c[BASE] * d + c[EXTRA] * limited,
        .dfdd = c[BASE] + (stretch == limited ? c[EXTRA] : 0.0),
    };
}

// Where S reaches its limits.
static double bilinear_kink(const double *c, const double *h, const struct contact_way *way) {
    double top = h[OFFSET] + c[YIELD];
    if (way->d > way->d0) {
        return way->d0 < top ? top - way->d : INFINITY;
    }
    return h[OFFSET] > 0.0 && way->d0 > h[OFFSET] ? way->d - h[OFFSET] : INFINITY;
}

static void bilinear_commit(const double *c, double *history, double d, double v) {
    (void)v;
    history[OFFSET] = fmin(fmax(history[OFFSET], d - c[YIELD]), d);
}

const struct contact_law contact_bilinear = {
    .name = "bilinear",
    .summary = "bilinear spring with hysteresis",
    .formula =
        "F = k1 d up to d = dy, then k1 dy + k2 (d - dy); unloading with k1 down to k2 d, then "
        "along k2 d. From kh, e, v0: dy = a dm, k1 = K + E / (a dm^2), k2 = K - E / ((1 - a) "
        "dm^2), dm = (5 m* v0^2 / (4 kh))^(2/5), E = (1 - e^2) m* v0^2 / 2, K = kh sqrt(dm)",
    .source = "Muthukumar (2003), thesis, Georgia Institute of Technology, and Muthukumar & "
              "DesRoches (2006), Earthquake Eng. Struct. Dyn. 35, 811-828; two stiffnesses as in "
              "Valles & Reinhorn (1997), NCEER-97-0001",
    .remarks = "Use it for faces that yield. Give -k1, -k2 and -dy, or give -kh, -e and the "
               "expected velocity -v0. An impact loses (k1 - k2) dy (d_max - dy), so the "
               "restitution depends on the velocity; below dy nothing is lost. With -kh, the "
               "published relation delivers 0.758 for an e of 0.65 at v0; -calibrate delivers e.",
    .example = "-k1 560MN/m -k2 60MN/m -dy 0.5mm",
    .row = rows,
    .n_row = N_ROW,
    .n_constant = N_CONSTANT,
    .n_history = N_HISTORY,
    .traits = CONTACT_NEEDS_MASS,
    .prepare = bilinear_prepare,
    .close = bilinear_close,
    .force = bilinear_force,
    .kink = bilinear_kink,
    .commit = bilinear_commit,
    .calibrate = bilinear_calibrate,
};
