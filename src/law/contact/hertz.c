// SPDX-License-Identifier: GPL-3.0-or-later
// Hertz: F = k d^n, n = 3/2 for two spheres.
//
// Closed forms of an isolated impact with n = 3/2: d_max = (5 m v0^2 / (4 k))^(2/5),
// F_max = k^(2/5) (5 m v0^2 / 4)^(3/5), duration 2.943275 d_max / v0. The slope vanishes at d = 0.
#include "law/lists.h"
#include "law/power.h"

enum { K, N, N_ROW };

static const struct row rows[N_ROW] = {
    [K] = POWER_STIFFNESS_ROW("impact stiffness"),
    [N] = {"n", ROW_NUMBER, ROW_POWER, OF_NONE, &power_range, 1.5, "exponent"},
};

static int hertz_prepare(const double *value, double m_eff, double *constant, struct error *e) {
    (void)m_eff, (void)e;
    constant[K] = value[K];
    constant[N] = value[N];
    return STATUS_OK;
}

static struct contact_response hertz_force(const double *c, const double *h, double d, double v) {
    (void)h, (void)v;
    return power_spring(c[K], c[N], d);
}

const struct contact_law contact_hertz = {
    .name = "hertz",
    .summary = "elastic contact of curved bodies",
    .formula = "F = k d^n, n = 3/2",
    .source = "Hertz (1882), J. reine angew. Math. 92, 156-171; for pounding Jing & Young (1991), "
              "Earthquake Eng. Struct. Dyn. 20, 667-681",
    .remarks = "Use it for curved faces. It loses no energy. The stiffness is 0 at closure.",
    .example = "-k 2.75e9N/m^1.5",
    .row = rows,
    .n_row = N_ROW,
    .n_constant = N_ROW,
    .traits = CONTACT_SMOOTH,
    .prepare = hertz_prepare,
    .force = hertz_force,
};
