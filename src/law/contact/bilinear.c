// SPDX-License-Identifier: GPL-3.0-or-later
// Bilinear spring with hysteresis: k1 up to d = dy, then k2; it unloads with k1 down to the line k2
// d, then along it to zero.
//
//     F = k2 d + S,   S = (k1 - k2) (d - offset),   0 <= S <= (k1 - k2) dy.
//
// An approach renewed within one contact rises with k1 from where it is to the line of loading. The
// offset follows by projecting S onto its limits, exactly for a path that does not turn within
// the step; it is the largest penetration less dy while S > 0. An impact that reaches d_max > dy
// loses (k1 - k2) dy (d_max - dy). The tangent is k1 or k2 and jumps between them.
#include <math.h>

#include "law/contact_list.h"

enum { K1, K2, DY, N_ROW };
enum { BASE, EXTRA, YIELD, N_CONSTANT };  // k2, k1 - k2, dy
enum { OFFSET, N_HISTORY };               // [L]

static const struct row rows[N_ROW] = {
    [K1] = {"k1",
            ROW_NUMBER,
            ROW_REQUIRED,
            {1, -1, 0},
            &range_positive,
            NAN,
            "stiffness up to dy, and of unloading"},
    [K2] = {"k2", ROW_NUMBER, ROW_REQUIRED, {1, -1, 0}, &range_positive, NAN, "stiffness beyond"},
    [DY] = {"dy", ROW_NUMBER, ROW_REQUIRED, {0, 1, 0}, &range_positive, NAN, "yield penetration"},
};

static int bilinear_prepare(const double *value, double m_eff, double *constant, struct error *e) {
    (void)m_eff;
    if (value[K2] > value[K1]) {
        return error_set(e, STATUS_INPUT, "k2 is %.6g; it must be <= k1, which is %.6g", value[K2],
                         value[K1]);
    }
    constant[BASE] = value[K2];
    constant[EXTRA] = value[K1] - value[K2];
    constant[YIELD] = value[DY];
    return STATUS_OK;
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

static void bilinear_commit(const double *c, double *history, double d, double v) {
    (void)v;
    history[OFFSET] = fmin(fmax(history[OFFSET], d - c[YIELD]), d);
}

const struct contact_law contact_bilinear = {
    .name = "bilinear",
    .summary = "bilinear spring with hysteresis",
    .formula =
        "F = k1 d to d = dy, then k1 dy + k2 (d - dy); unloads with k1 to k2 d, then along it",
    .source = "Muthukumar & DesRoches (2006), Earthquake Eng. Struct. Dyn. 35, 811-828; two "
              "stiffnesses as in Valles & Reinhorn (1997), NCEER-97-0001",
    .remarks = "never pulls; no dashpot: what is lost, (k1 - k2) dy (d_max - dy), depends on the "
               "velocity",
    .example = "-k1 560MN/m -k2 60MN/m -dy 0.5mm",
    .row = rows,
    .n_row = N_ROW,
    .n_constant = N_CONSTANT,
    .n_history = N_HISTORY,
    .prepare = bilinear_prepare,
    .close = bilinear_close,
    .force = bilinear_force,
    .commit = bilinear_commit,
};
