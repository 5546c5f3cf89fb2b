// SPDX-License-Identifier: GPL-3.0-or-later
// Linear spring: F = k d.
//
// An isolated impact with approach velocity v0 and effective mass m is half a period of an
// oscillator: d_max = v0 sqrt(m/k), F_max = v0 sqrt(k m), duration pi sqrt(m/k).
#include "law/in_lanes.h"
#include "law/lists.h"

enum { K, N_ROW };

static const struct row rows[N_ROW] = {
    [K] = {"k", ROW_NUMBER, ROW_REQUIRED, OF_STIFFNESS, &range_positive, NAN, "impact stiffness"},
};

static int linear_prepare(const double *value, double m_eff, double *constant, struct error *e) {
    (void)m_eff, (void)e;
    constant[K] = value[K];
    return STATUS_OK;
}

LANES_INLINE struct contact_response linear_force(const double *c, const double *h, double d,
                                                  double v) {
    (void)h, (void)v;
    return (struct contact_response){.force = c[K] * d, .dfdd = c[K]};
}

LANES static void linear_lanes(const double *constant, const double *d, const double *v,
                               struct contact_lanes *r) {
    in_lanes(linear_force, N_ROW, constant, d, v, r);
}

const struct contact_law contact_linear = {
    .name = "linear",
    .summary = "linear spring",
    .formula = "F = k d",
    .source = "Maison & Kasai (1992), Earthquake Eng. Struct. Dyn. 21, 771-786",
    .remarks = "Use it for comparison and for stiff stops. It loses no energy.",
    .example = "-k 93.5MN/m",
    .row = rows,
    .n_row = N_ROW,
    .n_constant = N_ROW,
    .traits = CONTACT_SMOOTH,
    .prepare = linear_prepare,
    .force = linear_force,
    .force_lanes = linear_lanes,
};
