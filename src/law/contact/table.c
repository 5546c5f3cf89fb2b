// SPDX-License-Identifier: GPL-3.0-or-later
// A measured curve with a loading branch L(d) and an unloading branch U(d). D is the largest
// penetration of the contact so far, and d_n the last penetration of the curve:
//
//     F = L(d)                                                d >= D
//     F = L(d) s(d d_n / D),   s = U(d) / L(d) of the curve   d < D.
//
// If L is a power of d, the unloading branch is the measured one scaled to (D, L(D)). With D = d_n
// it is the measured branch U. L and s are linear between the points. Beyond the last point L
// continues with its last slope. A renewed approach within one contact follows the unloading branch
// back up to D.
//
// No cycle creates energy: s <= 1, and s does not decrease with d, so the branch falls as D grows.
// The force does not depend on v. The slope jumps at the points and where the branch changes.
#include <math.h>
#include <stddef.h>

#include "law/lists.h"

enum { FILE_ROW, UNITS, N_ROW };
enum { N_POINT, N_CONSTANT };  // the points follow: d, L and s
enum { DEEPEST, N_HISTORY };
enum { SHARE = CURVE_UNLOADING };

static const struct row rows[N_ROW] = {
    [FILE_ROW] = {"file", ROW_FILE, ROW_REQUIRED, OF_NONE, NULL, NAN,
                  "rows of penetration, loading force and, if it differs, unloading force"},
    [UNITS] = {"units", ROW_TEXTS, 0, OF_NONE, NULL, NAN,
               "units of penetration and force; default: those in the file, or those of the deck"},
};

static int table_prepare(const double *value, double m_eff, double *constant, struct error *e) {
    (void)m_eff, (void)e;
    int n = (int)value[FILE_ROW];
    const double *from = value + N_ROW;
    double *to = constant + N_CONSTANT;
    constant[N_POINT] = n;
    double share = 1.0;
    for (int i = n - 1; i >= 0; i--) {
        const double *p = from + (ptrdiff_t)i * CURVE_COLUMNS;
        double *q = to + (ptrdiff_t)i * CURVE_COLUMNS;
        if (p[CURVE_LOADING] > 0.0) {
            share = fmin(share, p[CURVE_UNLOADING] / p[CURVE_LOADING]);
        }
        q[CURVE_PENETRATION] = p[CURVE_PENETRATION];
        q[CURVE_LOADING] = p[CURVE_LOADING];
        q[SHARE] = share;
    }
    return STATUS_OK;
}

static void table_close(const double *c, double v0, double *history) {
    (void)c, (void)v0;
    history[DEEPEST] = 0.0;
}

// The point at the start of the interval that contains d. The last interval has no end.
static const double *interval(const double *c, double d) {
    const double *point = c + N_CONSTANT;
    int low = 0;
    int high = (int)c[N_POINT] - 1;
    while (high - low > 1) {
        int middle = low + (high - low) / 2;
        if (point[(ptrdiff_t)middle * CURVE_COLUMNS + CURVE_PENETRATION] <= d) {
            low = middle;
        } else {
            high = middle;
        }
    }
    return point + (ptrdiff_t)low * CURVE_COLUMNS;
}

// The value of a column of the curve at d, and its slope.
static double column_at(const double *c, int column, double d, double *slope) {
    const double *p = interval(c, d);
    const double *q = p + CURVE_COLUMNS;
    *slope = (q[column] - p[column]) / (q[CURVE_PENETRATION] - p[CURVE_PENETRATION]);
    return p[column] + *slope * (d - p[CURVE_PENETRATION]);
}

static double last_penetration(const double *c) {
    return c[N_CONSTANT + ((ptrdiff_t)c[N_POINT] - 1) * CURVE_COLUMNS + CURVE_PENETRATION];
}

static struct contact_response table_force(const double *c, const double *h, double d, double v) {
    (void)v;
    struct contact_response r = {0};
    r.force = column_at(c, CURVE_LOADING, d, &r.dfdd);
    if (d >= h[DEEPEST]) {
        return r;
    }
    double last = last_penetration(c);
    double slope;
    double share = column_at(c, SHARE, d / h[DEEPEST] * last, &slope);
    r.dfdd = r.dfdd * share + r.force / h[DEEPEST] * slope * last;
    r.force *= share;
    return r;
}

// The next point of the curve in the direction of `way`: upwards as far as the last but one,
// downwards as far as the second. INFINITY: there is no such point.
static double point_beyond(const double *c, double d, double way) {
    const double *p = interval(c, d);
    const double *first = c + N_CONSTANT;
    const double *last = first + ((ptrdiff_t)c[N_POINT] - 1) * CURVE_COLUMNS;
    if (way > 0.0) {
        p += CURVE_COLUMNS;
        return p < last ? p[CURVE_PENETRATION] : INFINITY;
    }
    p -= p > first && p[CURVE_PENETRATION] == d ? CURVE_COLUMNS : 0;
    return p > first ? p[CURVE_PENETRATION] : -INFINITY;
}

// Kinks: the points of L; below D also the points of s, and D.
static double table_kink(const double *c, const double *h, const struct contact_way *way) {
    double rise = way->d - way->d0;
    double kink = point_beyond(c, way->d0, rise);
    if (way->d0 < h[DEEPEST] || (way->d0 == h[DEEPEST] && rise < 0.0)) {
        double scale = last_penetration(c) / h[DEEPEST];
        double of_share = point_beyond(c, way->d0 * scale, rise) / scale;
        kink = rise > 0.0 ? fmin(fmin(kink, of_share), h[DEEPEST]) : fmax(kink, of_share);
    }
    return rise > 0.0 ? kink - way->d : way->d - kink;
}

static void table_commit(const double *c, double *history, double d, double v) {
    (void)c, (void)v;
    history[DEEPEST] = fmax(history[DEEPEST], d);
}

const struct contact_law contact_table = {
    .name = "table",
    .traits = CONTACT_BUMPER,
    .summary = "measured force against penetration, with unloading branch",
    .formula = "F = L(d) for d >= D, L(d) s(d d_n / D) below, D the largest penetration so far, "
               "s = U / L of the file, d_n its last penetration",
    .source = "interpolation of a file",
    .remarks =
        "Use it for pads and bumpers with a measured curve. The force does not depend on the "
        "velocity. Beyond the end of the file the last slope continues, which is a guess.",
    .example = "-file input/pad.txt",
    .row = rows,
    .n_row = N_ROW,
    .n_constant = N_CONSTANT,
    .n_history = N_HISTORY,
    .prepare = table_prepare,
    .close = table_close,
    .force = table_force,
    .kink = table_kink,
    .commit = table_commit,
};
