// SPDX-License-Identifier: GPL-3.0-or-later
// Storey with a backbone through points.
//
//     kinematic  elastoplastic springs side by side, one for each point (Iwan 1966, J. Appl. Mech.
//                33, 893-900): the spring of point i yields at its drift d_i and has the stiffness
//                by which the slope falls there. Loops follow Masing's rule. An elastic spring has
//                the slope beyond the last point.
//     peak       unloading to zero shear, then towards the largest drift: law/points.h.
//
// Kinematic storeys return to the elastic range of bilinear ones: the plastic drift of each spring
// is mapped back as in bilinear.c. All steps without a turn are exact.
#include <math.h>
#include <stdio.h>

#include "law/lists.h"
#include "law/points.h"
#include "law/yield.h"

enum { N_MORE = POINTS_MAX - 1 };  // points beyond the first
enum {
    YIELD,
    DRIFT,  // of points 2, 3, ...
    SHEAR = DRIFT + N_MORE,
    HARDENING = SHEAR + N_MORE,
    CYCLE,
    EXPONENT,
    YIELD_NEGATIVE,
    N_ROW
};
enum { KINEMATIC, PEAK };
enum { CYCLE_OF = POINTS_CONSTANTS, LAST_SLOPE, N_CONSTANT };

static const char *const cycle_word[] = {"kinematic", "peak", NULL};
static const struct range cycle_range = {.text = "kinematic or peak", .word = cycle_word};

#define DRIFT_ROW(n)                                                                               \
    [DRIFT + (n)-2] = {"drift-" #n,         ROW_LIST, 0, OF_LENGTH, &range_positive, NAN,          \
                       "drift of point " #n}
#define SHEAR_ROW(n)                                                                               \
    [SHEAR + (n)-2] = {                                                                            \
        "shear-" #n, ROW_LIST, 0, OF_FORCE, &range_non_negative, NAN, "storey shear at point " #n}

static const struct row rows[N_ROW] = {
    [YIELD] = {"yield", ROW_LIST, ROW_REQUIRED, OF_FORCE, &range_positive, NAN,
               "storey shear at point 1, the first yield"},
    DRIFT_ROW(2),
    DRIFT_ROW(3),
    DRIFT_ROW(4),
    DRIFT_ROW(5),
    DRIFT_ROW(6),
    SHEAR_ROW(2),
    SHEAR_ROW(3),
    SHEAR_ROW(4),
    SHEAR_ROW(5),
    SHEAR_ROW(6),
    [HARDENING] = {"hardening", ROW_NUMBER, 0, OF_NONE, &yield_falling_range, 0.0,
                   "stiffness beyond the last point over initial stiffness"},
    [CYCLE] = {"cycle", ROW_CHOICE, 0, OF_NONE, &cycle_range, KINEMATIC,
               "how the storey unloads and reloads"},
    [EXPONENT] = {"b", ROW_NUMBER, 0, OF_NONE, &yield_hardening_range, 0.0,
                  "peak: exponent of the unloading stiffness"},
    [YIELD_NEGATIVE] = YIELD_NEGATIVE_ROW,
};

// Slopes of lines `i` and `i` + 1 over the initial stiffness.
static int multilinear_check_slope(int i, double before, double slope, bool peak, struct error *e) {
    // A storey that has lost strength may keep the rest.
    const double most = peak ? fmax(before, 0.0) : before;
    if (slope > most || (i == 0 && slope >= 1.0)) {
        return error_set(e, STATUS_INPUT,
                         "the slope beyond point %d is %.6g k; it must be %s %.6g k: slopes fall%s",
                         i + 1, slope, i == 0 ? "<" : "<=", most,
                         peak ? ", but behind a falling line 0 is allowed" : " from line to line");
    }
    return STATUS_OK;
}

static int multilinear_points(const double *value, double stiffness, double *drift, double *shear,
                              int *n, struct error *e) {
    drift[0] = value[YIELD] / stiffness;
    shear[0] = value[YIELD];
    *n = 1;
    for (int i = 0; i < N_MORE; i++) {
        const double d = value[DRIFT + i], v = value[SHEAR + i];
        if (isnan(d) != isnan(v)) {
            return error_set(e, STATUS_INPUT, "drift-%d and shear-%d must be given together", i + 2,
                             i + 2);
        }
        if (isnan(d)) {
            continue;
        }
        if (*n != i + 1) {
            return error_set(e, STATUS_INPUT, "drift-%d needs drift-%d", i + 2, *n + 1);
        }
        if (d <= drift[i]) {
            return error_set(e, STATUS_INPUT,
                             i == 0 ? "drift-2 must be > yield / stiffness"
                                    : "drift-%d must be > drift-%d",
                             i + 2, i + 1);
        }
        drift[*n] = d;
        shear[(*n)++] = v;
    }
    return STATUS_OK;
}

static int multilinear_prepare(const double *value, double stiffness, double *constant,
                               struct error *e) {
    double drift[POINTS_MAX], shear[POINTS_MAX];
    int n = 0;
    int status = multilinear_points(value, stiffness, drift, shear, &n, e);
    if (status == STATUS_OK) {
        points_prepare(stiffness, drift, shear, n, value[HARDENING] * stiffness, constant);
    }
    double before = 1.0;
    for (int i = 0; status == STATUS_OK && i < n; i++) {
        const double slope = constant[POINTS_SLOPE + i] / stiffness;
        status = multilinear_check_slope(i, before, slope, value[CYCLE] == PEAK, e);
        before = slope;
    }
    constant[POINTS_EXPONENT] = value[EXPONENT];
    constant[CYCLE_OF] = value[CYCLE];
    constant[LAST_SLOPE] = value[HARDENING] * stiffness;
    points_resize(constant, value[YIELD_NEGATIVE] / value[YIELD]);
    return status;
}

// The stiffness of spring i.
static inline double multilinear_spring(const double *c, int i) {
    const double before = i > 0 ? c[POINTS_SLOPE + i - 1] : c[LOADING_STIFFNESS];
    return before - c[POINTS_SLOPE + i];
}

// The history has the plastic drift of each spring.
static struct storey_response multilinear_kinematic(const double *c, const double *h, double drift,
                                                    double *after) {
    const int n = (int)c[POINTS_N];
    struct storey_response r = {c[LAST_SLOPE] * drift, c[LAST_SLOPE]};
    bool elastic = true;
    for (int i = 0; i < n; i++) {
        const double spring = multilinear_spring(c, i), trial = drift - h[i];
        const double most = points_size(c, trial < 0.0) * c[POINTS_DRIFT + i];
        const bool yields = fabs(trial) > most;
        const double stretch = yields ? copysign(most, trial) : trial;
        r.shear += spring * stretch;
        r.tangent += yields ? 0.0 : spring;
        elastic = elastic && !yields;
        if (after) {
            after[i] = yields ? drift - stretch : h[i];
        }
    }
    // The sum of the springs, without rounding.
    r.tangent = elastic ? c[LOADING_STIFFNESS] : r.tangent;
    return r;
}

static double multilinear_kinematic_stored(const double *c, const double *h, double drift) {
    double after[POINTS_MAX] = {0};
    multilinear_kinematic(c, h, drift, after);
    double twice = c[LAST_SLOPE] * drift * drift;
    for (int i = 0; i < (int)c[POINTS_N]; i++) {
        const double stretch = drift - after[i];
        twice += multilinear_spring(c, i) * stretch * stretch;
    }
    return twice / 2.0;
}

static struct storey_response multilinear_respond(const double *c, const double *h, double drift,
                                                  double *after) {
    return c[CYCLE_OF] == KINEMATIC ? multilinear_kinematic(c, h, drift, after)
                                    : loading_respond(&points_rule, c, h, drift, after);
}

static double multilinear_stored(const double *c, const double *h, double drift) {
    return c[CYCLE_OF] == KINEMATIC ? multilinear_kinematic_stored(c, h, drift)
                                    : loading_stored(&points_rule, c, h, drift);
}

static void multilinear_describe(const double *c, struct storey_figures *out) {
    points_describe(c, 0, out);
}

const struct storey_law storey_multilinear = {
    .name = "multilinear",
    .summary = "backbone through 2 to 6 points; kinematic or peak-oriented",
    .formula = "lines from the origin with k to V_y, then through the points, then hardening k. "
               "kinematic: springs side by side that yield at d_i, |S_i| <= (k_i - k_i+1) d_i. "
               "peak: unloading with k (dm / d_1)^-b to V = 0, then towards the largest drift dm",
    .source = "kinematic: Iwan (1966), J. Appl. Mech. 33, 893-900; peak: Clough & Johnston (1966), "
              "Proc. Japan Earthquake Eng. Symposium, 227-232",
    .remarks = "For pushover curves. Slopes must fall from line to line. peak may lose strength: "
               "behind a falling line the next may be flatter, so that the storey keeps a residual "
               "strength. A kinematic storey may have a falling last line, which has no end: it "
               "pushes the storey over. With yield-negative the backbone of negative drifts has "
               "drifts and shears multiplied by yield-negative / yield",
    .example = "-yield 400kN -drift-2 20mm -shear-2 700kN -drift-3 50mm -shear-3 800kN",
    .row = rows,
    .n_row = N_ROW,
    .n_constant = N_CONSTANT,
    .n_history = POINTS_HISTORY,
    .traits = STOREY_STRAIGHT,
    .prepare = multilinear_prepare,
    .respond = multilinear_respond,
    .stored = multilinear_stored,
    .describe = multilinear_describe,
};
